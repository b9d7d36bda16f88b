// The page: the session, its sliders, and the view that is asked for.

import { Asking, ask, list } from "./api.js";
import { REMARK, VIEWS as ANSWERED } from "./engine.js";
import { byId, element, save } from "./dom.js";
import { CampaignAnswer, about as aboutCampaign } from "./campaigns.js";
import { DesignAnswer, about as aboutDesign, nameOfEnd, namedKeys, wordsOf } from "./design.js";
import { Dial } from "./dial.js";
import { BLANK, DriveAnswer, aboutMission } from "./drive.js";
import { BY_HAND, HandDrive } from "./hand.js";
import { FitAnswer, choicesOfFit, optionsOf, partsOf, takePart } from "./fit.js";
import { Fits } from "./fits.js";
import { LogAnswer } from "./log.js";
import { Card, announce, cardOf, chartOf, exportOf } from "./heading.js";
import { MapAnswer, offer, saidOf } from "./map.js";
import { addLeg, addLimit, legsTable, removeLimit } from "./legs.js";
import { fromAddress, toAddress } from "./session.js";
import { Slider, endsOf } from "./slider.js";
import { WheelAnswer, labelOf } from "./wheel.js";

/** @typedef {import("./session.js").Session} Session */

// The token was in the first address: a cookie stands for it from here on.
if (location.search) history.replaceState(null, "", location.pathname + location.hash);

let { own: session, pinned } = fromAddress();
/** @type {Slider[]} */
let sliders = [];
/** @type {Card[]} */
let cards = [];
/** @type {WheelAnswer | undefined} */
let wheel;
/** @type {MapAnswer | undefined} */
let map;
/** @type {DriveAnswer | undefined} */
let drive;
/** @type {DesignAnswer | undefined} */
let design;
/** @type {CampaignAnswer | undefined} */
let campaigns;
/** @type {FitAnswer | undefined} */
let fit;
/** Fits that were made; one that is taken up makes the session what it was. */
const fits = new Fits((made) => {
  session = { ...structuredClone(made.session), view: "fit" };
  reflect();
  begin();
});
/** @type {LogAnswer | undefined} */
let log;
/** @type {string[]} */
let missions = [];
/** @type {string[]} */
let maps = [];
/** @type {string[]} */
let areas = [];
/** @type {import("./fit.js").DataSet[]} */
let dataSets = [];
/** Questions that the engine answers. @type {Set<string>} */
let answered = new Set();
/** Keys that the sliders do not have: what of a scenario makes no difference to a heading. */
const GRAVITY = "scenario.gravity_m_s2";
const MOST_PINNED = 2;
/** Which parts of the session each view has. */
const VIEWS = /** @type {Record<string, Part[]>} */ ({
  heading: ["rover", "soil", "belief", "model"], wheel: ["wheel", "soil", "belief", "model"], drive: ["rover", "soil", "model"],
  map: ["dem", "rover", "soil", "model"], design: ["design", "belief"], campaigns: ["campaign"],
  fit: ["data", "wheel", "soil", "model", "belief"], log: ["log", "rover", "soil", "model", "belief"],
});
/** @typedef {"log" | "data" | "campaign" | "design" | "dem" | "rover" | "soil" | "wheel" | "model" | "belief"} Part */
const PARTS = /** @type {Part[]} */ (["log", "data", "campaign", "design", "dem", "rover", "soil", "wheel", "model", "belief"]);

const asking = new Asking();
const [answer, place] = [byId("answer"), byId("sliders")];

/** @param {Error | undefined} error */
function complain(error) {
  const key = /** @type {any} */ (error)?.key;
  let isPlaced = false;
  for (const slider of sliders) {
    const isIts = key !== undefined && slider.key === key;
    slider.complain(isIts ? error?.message ?? "" : "");
    isPlaced ||= isIts;
  }
  const field = key && byId(key);
  byId("session-error").textContent = error && !isPlaced ? error.message : "";
  for (const name of PARTS) byId(name).removeAttribute("aria-invalid");
  if (error && field instanceof HTMLSelectElement) field.setAttribute("aria-invalid", "true");
}

/** The answer of the view. */
function current() {
  return /** @type {Record<string, typeof wheel | typeof map | typeof drive | typeof design | typeof campaigns | typeof fit | typeof log>} */ ({ wheel, map, drive, design, campaigns, fit, log })[session.view] ?? cards[0];
}

let waiting = 0;
/** Asks anew, once for all that moved since the last picture. */
function moved() {
  toAddress(session, pinned);
  announce("computing …");
  if (waiting) return;
  waiting = requestAnimationFrame(() => {
    waiting = 0;
    // The command is of the numbers before, until the answer is there.
    out.classList.add("old");
    current()?.ask(session);
  });
}

/**
 * A slider of a number of the session.
 * @param {"slope" | "course" | "speed" | "load" | "slip" | "angle" | "yaw" | "duration"} name
 * @param {string} key
 * @param {string} label
 * @param {string} unit
 * @param {[number, number]} ends
 */
function ofSession(name, key, label, unit, [low, high]) {
  const slider = new Slider({ key, label, unit, value: session[name], low, high }, (value) => {
    session[name] = value;
    moved();
  });
  sliders.push(slider);
  return slider.element;
}

/** @param {import("./api.js").Key} key */
function ofKey(key) {
  const value = session.set[key.key] ?? key.value;
  const remarks = [key.is_uncertain ? "uncertain" : "", key.is_assumed ? "from priors" : ""].filter(Boolean);
  /** @type {Slider} */
  const slider = new Slider({
    key: key.key, label: labelOf(key), unit: key.unit ?? "", value, usual: key.value, ...endsOf(key),
    ...(remarks.length ? { remark: `(${remarks.join(", ")})` } : {}),
  }, (number) => {
    if (number === key.value) delete session.set[key.key];
    else session.set[key.key] = number;
    slider.mark(number);
    moved();
  });
  sliders.push(slider);
  return slider.element;
}

/**
 * @param {string} title
 * @param {Node[]} inside
 * @param {boolean} isOpen
 */
function group(title, inside, isOpen) {
  return element("details", isOpen ? { open: true } : {}, [element("summary", {}, [title]), ...inside]);
}

/** @param {string} view */
function isThere(view) {
  return Object.hasOwn(VIEWS, view) && (ANSWERED?.includes(view) ?? true);
}

/** Makes the sliders of the documents that the session names, then asks. */
function begin() {
  if (!isThere(session.view)) session.view = "heading";
  const [isMap, isDrive, isFit, isLog] = ["map", "drive", "fit", "log"].map((view) => view === session.view);
  const isWheel = isFit || session.view === "wheel";
  for (const view of Object.keys(VIEWS)) {
    const id = `view-${view}`;
    if (view === session.view) byId(id).setAttribute("aria-current", "page");
    else byId(id).removeAttribute("aria-current");
  }
  for (const part of PARTS) byId(part).closest("label").hidden = !VIEWS[session.view]?.includes(part);
  cards.forEach((card) => card.stop());
  wheel?.stop();
  map?.stop();
  drive?.stop();
  design?.stop();
  campaigns?.stop();
  fit?.stop();
  log?.stop();
  const begun = () => announce("computing …");
  if (isFit && !session.data) {
    const set = dataSets.find((it) => !it.lacks);
    if (set) {
      session.data = set.name;
      takeData(0);
      return;
    }
  }
  if (session.view === "campaigns") {
    asking.ask("campaign-task", aboutCampaign({ ...session, runs: 0, set: {} }), (line) => {
      sliders = [];
      campaigns = new CampaignAnswer(ended, begun);
      place.replaceChildren(element("h2", {}, ["Start one"]), ...intoFolder(line.runs ?? 0), ...(line.keys ?? []).map(ofKey));
      answer.replaceChildren(campaigns.element);
      moved();
    }, (error) => {
      if (error) complain(error);
    });
    return;
  }
  if (session.view === "design") {
    // Its fields are those of its document: numbers that are refused have theirs, too.
    asking.ask("design-task", aboutDesign({ ...session, set: {} }), (line) => {
      sliders = [];
      place.replaceChildren(element("h2", {}, ["Move"]), ...namedKeys(line.keys ?? [], line.measures ?? []).map(ofKey), bounds(line.free ?? []), ...trades(line.measures ?? []));
      design = new DesignAnswer(ended, begun);
      answer.replaceChildren(design.element);
      moved();
    }, (error) => {
      if (error) complain(error);
    });
    return;
  }
  const isByHand = session.mission === BY_HAND;
  if (isDrive && session.mission && !isByHand) {
    beginMission();
    return;
  }
  const { rover, soil, wheel: named } = session;
  const question = isWheel ? { soil, ...(named ? { wheel: named } : { rover }) } : { rover, soil };
  asking.ask(isWheel ? "stand" : "scenario", question, (line) => {
    const keys = line.keys ?? [];
    const of = (/** @type {string} */ kind) => keys.filter((key) => key.key.startsWith(`${kind}.`)).map(ofKey);
    const names = line.names ?? {};
    sliders = [];
    if (isFit) {
      const focused = document.activeElement?.id;
      fit = new FitAnswer(ended, begun, moved, fits);
      place.replaceChildren(
        element("h2", {}, ["Fit"]), ...partsOf(session, dataSets.find(({ name }) => name === session.data), takeData), ...choicesOfFit(session, keys, moved), group(`Start: ${names["soil"]}`, of("soil"), false),
      );
      answer.replaceChildren(fit.element);
      // A button of a fit that was taken up is in another place now.
      if (focused) byId(focused)?.focus();
    } else if (isWheel) {
      place.replaceChildren(
        element("h2", {}, ["Move"]),
        ofSession("slip", "slip_ratio", "Slip ratio", "", [-0.3, 0.9]),
        ofSession("load", "load_n", "Load on the wheel", "N", [1, Math.max(100, 2 * session.load)]),
        ofSession("angle", "slip_angle_deg", "Slip angle", "°", [-45, 45]),
        group(`Wheel: ${names["wheel"]}`, of("wheel"), true), group(`Soil: ${names["soil"]}`, of("soil"), false),
      );
      wheel = new WheelAnswer(ended);
      wheel.keys = keys;
      answer.replaceChildren(wheel.element);
    } else if (isLog) {
      log = new LogAnswer(ended, begun);
      place.replaceChildren(
        element("h2", {}, ["Move"]), ...ofGravity(keys),
        group(`Soil: ${names["soil"]}`, of("soil"), true), group(`Rover: ${names["rover"]}`, of("rover"), false),
      );
      answer.replaceChildren(log.element);
    } else {
      const slope = isMap ? courses() : isDrive ? run() : [
        ofSession("slope", "slope_deg", "Slope", "°", [0, 40]),
        ofSession("course", "course_deg", "Course, from the contour, uphill", "°", [-90, 90]),
      ];
      place.replaceChildren(
        element("h2", {}, ["Move"]), ...slope,
        ofSession("speed", "rim_speed_m_s", isDrive ? "Speed of the rims" : "Speed of the rims, for the power", "m/s", [0.005, 0.5]),
        ...ofGravity(keys),
        group(`Soil: ${names["soil"]}`, of("soil"), true), group(`Rover: ${names["rover"]}`, of("rover"), false),
      );
      if (isDrive) {
        drive = isByHand ? new HandDrive(ended, looked) : new DriveAnswer(ended, looked);
        answer.replaceChildren(drive.element);
      } else if (isMap) {
        map = new MapAnswer(ended, () => toAddress(session, pinned), areas);
        answer.replaceChildren(map.element);
      } else showCards();
    }
    moved();
  }, (error) => {
    if (error) complain(error);
  });
}

/** @param {import("./api.js").Key[]} keys */
function ofGravity(keys) {
  return keys.filter((key) => key.key === GRAVITY).map((key) => ofKey({ ...key, minimum: 0.5, maximum: 25 }));
}

/** The course of a map: one, by a dial, or the best or the worst of each place. */
function courses() {
  const dial = new Dial("Course, from the contour, uphill", session.course, (value) => {
    session.course = value;
    moved();
  });
  const options = { fixed: "this one", best: "the best of each place", worst: "the worst of each place" };
  const which = element("select", { id: "which", onchange: (/** @type {any} */ event) => {
    session.which = event.target.value;
    dial.element.hidden = session.which !== "fixed";
    moved();
  } }, Object.entries(options).map(([value, text]) => element("option", { value, selected: value === session.which }, [text])));
  dial.element.hidden = session.which !== "fixed";
  return [element("div", { class: "slider" }, [element("label", {}, ["Course ", which])]), dial.element];
}

/**
 * The ends between which numbers of a design are free.
 * @param {import("./api.js").Key[]} free
 */
function bounds(free) {
  return element("fieldset", { id: "bounds" }, [element("legend", {}, ["What is free, and between which ends"]), ...free.map((key) => ofKey(nameOfEnd(key)))]);
}

/**
 * Two measures that a design trades for one another, or none.
 * @param {import("./design.js").Measure[]} measures
 */
function trades(measures) {
  const chosen = session.trade.split(",");
  const select = (/** @type {number} */ at) => element("select", { "aria-label": at ? "Trade for" : "Trade", onchange: () => {
    const [one, other] = selects.map((it) => /** @type {any} */ (it).value);
    session.trade = one && other && one !== other ? `${one},${other}` : "";
    moved();
  } }, [{ name: "", meaning: "nothing" }, ...measures].map((it) => element("option", { value: it.name, selected: it.name === (chosen[at] ?? "") }, [wordsOf(it)])));
  const selects = [select(0), select(1)];
  return [element("div", { class: "slider trade" }, ["Trade ", selects[0] ?? "", " for ", selects[1] ?? ""])];
}

/**
 * The drive is shown in another way from now on.
 * @param {string} seen
 * @param {boolean} isToAsk whether that needs an answer of its own
 */
function looked(seen, isToAsk) {
  session.seen = seen;
  if (isToAsk) moved();
  else toAddress(session, pinned);
}

/** What is driven: one heading, or the legs of a mission. */
function whatIsDriven() {
  const select = element("select", { id: "mission", onchange: (/** @type {any} */ event) => {
    session.mission = event.target.value;
    session.legs = session.added = "";
    session.set = Object.fromEntries(Object.entries(session.set).filter(([key]) => !key.startsWith("mission.")));
    begin();
    byId("mission")?.focus();
  } }, ["", BY_HAND, ...missions].map((name) => element("option", { value: name, selected: name === session.mission }, [name === BLANK ? "a blank mission" : name || "one heading"])));
  return element("div", { class: "slider" }, [element("label", {}, ["Drive ", select])]);
}

/** Makes the legs and limits of a mission, then drives it. */
function beginMission() {
  // A blank one has the rover and the ground of the session.
  const isHidden = (/** @type {Part} */ part) => session.mission !== BLANK || part === "model";
  for (const part of VIEWS["drive"] ?? []) byId(part).closest("label").hidden = isHidden(part);
  asking.ask("mission-task", aboutMission(session), (line) => {
    sliders = [];
    const legs = line.legs ?? [];
    const isLimit = (/** @type {import("./api.js").Key} */ { key }) => key === "mission.slope_deg" || key.startsWith("mission.stop.");
    const [limits, others] = [(line.keys ?? []).filter(isLimit), (line.keys ?? []).filter((key) => !isLimit(key))];
    const own = new DriveAnswer(ended, looked);
    drive = own;
    const table = element("div");
    const changed = () => {
      session.legs = JSON.stringify(legs);
      own.goals = legs.map((leg) => leg.goto).filter(Boolean);
      moved();
    };
    const shown = () => table.replaceChildren(legsTable(legs, changed, () => {
      shown();
      changed();
    }));
    shown();
    own.goals = legs.map((leg) => leg.goto).filter(Boolean);
    own.steer((leg) => {
      addLeg(legs, leg);
      shown();
      changed();
    });
    own.dragged = () => {
      shown();
      changed();
    };
    const { rover, soil } = line.names ?? {};
    const parts = element("p", { class: "setup" }, [`${rover} on ${soil}, as the mission has them`]);
    const all = /** @type {any} */ (line).limits ?? [];
    place.replaceChildren(element("h2", {}, ["Move"]), whatIsDriven(), parts, table, limitsOf(limits, all), group("Other numbers", others.map(ofKey), false));
    answer.replaceChildren(own.element);
    moved();
  }, (error) => {
    if (!error) return;
    complain(error);
    place.replaceChildren(whatIsDriven());
  });
}

/**
 * The limits at which a mission stops, and one more of those that there may be.
 * @param {import("./api.js").Key[]} keys
 * @param {import("./legs.js").Limit[]} all
 */
function limitsOf(keys, all) {
  const again = () => {
    toAddress(session, pinned);
    begin();
  };
  const own = keys.map((key) => {
    const limit = all.find((it) => it.key === key.key);
    const slider = ofKey(limit ? { ...key, meaning: `Stop: ${limit.label.replace(/ \[.*/, "")} above` } : key);
    const isAdded = session.added.split(",").includes(key.key);
    return isAdded ? element("div", { class: "added" }, [slider, removeLimit(limit?.label ?? key.key, () => {
      delete session.set[key.key];
      session.added = session.added.split(",").filter((it) => it !== key.key).join(",");
      again();
    })]) : slider;
  });
  const others = all.filter((it) => !keys.some((key) => key.key === it.key));
  return element("fieldset", { id: "limits" }, [element("legend", {}, ["Limits"]), ...own, addLimit(others, (key, value) => {
    session.set[key] = value;
    session.added = [...session.added.split(",").filter(Boolean), key].join(",");
    again();
  })]);
}

/**
 * How many runs a campaign has, and into which folder they go.
 * @param {number} usual
 */
function intoFolder(usual) {
  const runs = element("input", { type: "number", id: "campaign.runs", min: 1, step: 1, required: true, value: session.runs || usual, onchange: (/** @type {any} */ event) => {
    if (!event.target.reportValidity()) return;
    session.runs = event.target.valueAsNumber;
    toAddress(session, pinned);
  } });
  const out = element("input", { type: "text", id: "out", required: true, value: session.out, onchange: (/** @type {any} */ event) => {
    if (!event.target.reportValidity()) return;
    session.out = event.target.value;
    toAddress(session, pinned);
  } });
  return [element("div", { class: "slider" }, [element("label", {}, ["Runs ", runs])]), element("div", { class: "slider" }, [element("label", {}, ["Folder ", out])])];
}

/** What a run starts with. */
function run() {
  const slope = ofSession("slope", "slope_deg", "Slope", "°", [0, 40]);
  const options = [["", "a plane"], ...maps.map((path) => [path, path])];
  const ground = element("select", { id: "ground", onchange: (/** @type {any} */ event) => {
    session.ground = event.target.value;
    slope.hidden = session.ground !== "";
    moved();
  } }, options.map(([value, text]) => element("option", { value, selected: value === session.ground }, [text])));
  slope.hidden = session.ground !== "";
  return [
    whatIsDriven(), element("div", { class: "slider" }, [element("label", {}, ["On ", ground])]), slope,
    ofSession("yaw", "yaw_deg", "Yaw at the start, uphill, on a map from east to the left", "°", [-90, 90]),
    ...(session.mission === BY_HAND ? [] : [ofSession("duration", "duration_s", "Length of the run", "s", [5, 120])]),
  ];
}

/** @param {Error | undefined} error */
function ended(error) {
  out.classList.remove("old");
  complain(error);
  announce(error ? "no answer" : said());
}

/** The answer in a few words, for who does not see it. */
function said() {
  if (session.view === "wheel") return "the wheel is up to date";
  if (session.view === "drive") return drive?.said() ?? "";
  if (session.view === "design") return design?.said() ?? "";
  if (session.view === "campaigns") return campaigns?.said() ?? "";
  if (session.view === "fit") return fit?.said() ?? "";
  if (session.view === "log") return log?.said() ?? "";
  if (session.view === "map") return map ? saidOf(map) : "";
  const yaw = cards[0]?.yaw();
  const verdict = cards[0]?.row?.["verdict"]?.replace("_", " ") ?? "";
  return [typeof yaw === "number" ? `${yaw.toFixed(1)}° uphill` : "no heading", verdict].filter(Boolean).join(", ");
}

const figure = element("figure");
const out = element("div");

function showCards() {
  const drawn = () => figure.replaceChildren(chartOf(cards));
  const pin = element("button", { type: "button", id: "pin", disabled: pinned.length >= MOST_PINNED, onclick: () => {
    pinned = [...pinned, structuredClone(session)];
    showCards();
    moved();
  } }, ["Pin beside (p)"]);
  const own = new Card(session, false, [pin], (error) => {
    ended(error);
    drawn();
    out.replaceChildren(exportOf(own.shown, cardOf(own.session, own.shown?.command, answered.has("card"))));
  }, drawn);
  const others = pinned.map((other, index) => new Card(other, true, [
    element("button", { type: "button", onclick: () => {
      session = { ...structuredClone(other), view: session.view };
      begin();
    } }, ["Take up"]),
    element("button", { type: "button", onclick: () => {
      pinned = pinned.filter((_, at) => at !== index);
      showCards();
      moved();
    } }, ["Remove"]),
  ], () => {}, drawn));
  cards.forEach((card) => card.stop());
  cards = [own, ...others];
  answer.replaceChildren(
    element("div", { class: "cards" }, [...cards.map((card) => card.element), figure]), out,
  );
  others.forEach((card) => card.ask());
}

/** Saves the last answer as a picture for a slide. */
async function slide() {
  // Studies take long: theirs came with the answer.
  const study = /** @type {Record<string, typeof design | typeof campaigns | typeof fit | typeof log>} */ ({ design, campaigns, fit, log })[session.view];
  if (study) {
    if (study.slide) save(`${session.view}.svg`, study.slide);
    else announce("this answer has no picture for a slide");
    return;
  }
  const [name, question] = current()?.asking.asked ?? [];
  if (!name) return;
  announce("computing the slide …");
  const stages = question.stages?.slice(-1);
  const { scene: _, ...other } = question;
  const asked = { ...other, ...(stages ? { stages } : {}), slide: true };
  const error = await ask(name, asked, new AbortController().signal, (line) => {
    if (line.slide) save(`${name}.svg`, line.slide);
  }).catch((problem) => problem);
  ended(error);
}

/** @param {string} view */
function show(view) {
  session.view = view;
  begin();
}

/** Fills what there is to choose from. */
async function choices() {
  const [presets, documents, files, sets, questions] = await Promise.all([list("presets"), list("documents"), list("files"), list("data-sets"), list("questions")]);
  answered = new Set(questions.map((row) => row["name"]));
  dataSets = /** @type {any} */ (sets);
  const paths = (/** @type {string} */ kind) => files.filter((row) => row["kind"] === kind).map((row) => row["path"]);
  maps = paths("map");
  offer("dem", maps);
  session.dem ||= maps[0] ?? "";
  areas = paths("areas");
  missions = [...documents.filter((row) => row["kind"] === "mission").map((row) => row["path"]), ...presets.filter((row) => row["kind"] === "mission").map((row) => row["name"])];
  byId("data").replaceChildren(...optionsOf(dataSets));
  offer("log", paths("measurements"));
  session.log ||= paths("measurements")[0] ?? "";
  for (const kind of ["rover", "soil", "wheel", "design", "campaign"]) {
    const select = byId(kind);
    const option = (/** @type {string} */ value, /** @type {string} */ title) =>
      element("option", { value, title }, [value]);
    const own = documents.filter((row) => row["kind"] === kind).map((row) => option(row["path"], row["path"]));
    const known = presets.filter((row) => row["kind"] === kind).map((row) => option(row["name"], row["title"]));
    select.replaceChildren(
      ...(kind === "wheel" ? [element("option", { value: "" }, ["of the rover"])] : []),
      ...(own.length ? [element("optgroup", { label: "Of the folder" }, own)] : []),
      element("optgroup", { label: "Presets" }, known),
    );
  }
  reflect();
}

/**
 * Begins a fit to a part of the data set that is chosen, with its wheel and its soil.
 * @param {number} part by its place
 */
function takeData(part) {
  takePart(session, dataSets.find(({ name }) => name === session.data), part);
  // Numbers of one soil are none of another.
  session.set = Object.fromEntries(Object.entries(session.set).filter(([key]) => !/^(soil|wheel)\./.test(key)));
  reflect();
  begin();
}

/** Shows in the session line what the session has. */
function reflect() {
  for (const name of PARTS) {
    const select = /** @type {HTMLSelectElement} */ (byId(name));
    const value = session[name];
    if (value && ![...select.options].some((option) => option.value === value)) {
      select.append(element("option", { value }, [value]));
    }
    select.value = value;
  }
}

for (const name of PARTS) {
  byId(name).addEventListener("change", (/** @type {any} */ event) => {
    session[name] = event.target.value;
    // Numbers of one document are none of another.
    const isOther = (/** @type {string} */ key) => !key.startsWith(`${name}.`);
    session.set = Object.fromEntries(Object.entries(session.set).filter(([key]) => isOther(key)));
    if (name === "rover") session.wheel = "";
    if (name === "campaign") session.runs = 0;
    if (name === "dem") session.at = session.from = session.to = "";
    if (name === "data") takeData(0);
    else if (["model", "belief", "dem", "log"].includes(name)) moved();
    else begin();
  });
}
byId("session").addEventListener("submit", (/** @type {Event} */ event) => event.preventDefault());
byId("skip").addEventListener("click", (/** @type {Event} */ event) => {
  // The fragment is the session's.
  event.preventDefault();
  answer.focus();
  answer.scrollIntoView();
});
for (const view of Object.keys(VIEWS)) {
  byId(`view-${view}`).addEventListener("click", () => show(view));
  byId(`view-${view}`).hidden = !isThere(view);
}
if (REMARK) {
  const guide = element("a", { href: REMARK.guide, target: "_top" }, ["Guide"]);
  byId("remark").replaceChildren(`${REMARK.text} `, element("code", {}, [REMARK.command]), " ", guide);
  byId("remark").hidden = false;
}
addEventListener("hashchange", () => {
  ({ own: session, pinned } = fromAddress());
  reflect();
  begin();
});
addEventListener("keydown", (event) => {
  const isTyping = event.target instanceof HTMLInputElement && event.target.type !== "range" || event.target instanceof HTMLSelectElement;
  const button = { p: "pin", i: "slide" }[event.key];
  if (button && !isTyping && !event.ctrlKey && !event.metaKey && !event.altKey) byId(button)?.click();
});
answer.addEventListener("click", (/** @type {any} */ event) => {
  if (event.target.closest("#slide")) slide();
});

byId("busy").setAttribute("aria-live", "polite");
choices().then(begin, complain);
