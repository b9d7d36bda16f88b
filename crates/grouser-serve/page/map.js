// The fourth view: where a rover can go on a map of heights, what a place of it has and why, and
// the cheapest way from one place to another.

import { Asking, ask } from "./api.js";
import { byId, element, four, save, svg } from "./dom.js";
import { VERDICTS, about as aboutRover, announce, exportOf, ruleOf } from "./heading.js";

/** @typedef {import("./session.js").Session} Session */
/** @typedef {import("./api.js").Line} Line */
/** @typedef {[number, number]} Place */
/** @typedef {"at" | "from" | "to"} Mark */

/** Samples of a first map, and of the program's. */
const STAGES = [20, 200];

/** The places that may be set: what each is called, its sign on the map, and its key. */
const MARKS = /** @type {Record<Mark, [string, string, string]>} */ ({
  at: ["Look at", "+", "l"], from: ["Start", "S", "s"], to: ["Goal", "G", "g"],
});

/** What a way takes: column, label. */
const TAKES = /** @type {[string, string][]} */ ([
  ["time_s", "time [s]"], ["energy_j", "work of the wheels [J]"], ["battery_energy_j", "drawn from the battery [J]"],
  ["length_m", "length over the ground [m]"], ["probability_no_go", "probability of a no-go"],
  ["probability_completed", "probability that it is completed"],
  ["most_slip_ratio", "largest slip ratio"], ["most_slope_deg", "steepest slope [°]"],
]);

/** The heading of a map is a direction on it; that of a card is an offset from the contour. */
const LABELS = /** @type {Record<string, string>} */ ({ heading_deg: "nose on the map, from x to the left [°]" });

/**
 * What a number of a map is called.
 * @param {{name: string, label: string}} layer
 */
const labelOf = ({ name, label }) => LABELS[name] ?? label;

/**
 * A place of the session.
 * @param {string} text
 * @returns {Place | undefined}
 */
function placeOf(text) {
  const [x, y] = text.split(",").map(Number);
  return text && Number.isFinite(x) && Number.isFinite(y) ? [x ?? 0, y ?? 0] : undefined;
}

/**
 * What is asked of a map, whatever the question.
 * @param {Session} session
 */
function about(session) {
  return { ...aboutRover(session), dem: session.dem, rim_speed_m_s: session.speed };
}

/**
 * A verdict with its sign and its word.
 * @param {string} name
 */
function badge(name) {
  const verdict = VERDICTS[name];
  if (!verdict) return null;
  return element("p", { class: `verdict ${name}` }, [element("span", { "aria-hidden": "true" }, [verdict[0]]), verdict[1]]);
}

/** The answer about a map. */
export class MapAnswer {
  /**
   * @param {(error: Error | undefined) => void} ended
   * @param {() => void} keep the session in the address
   * @param {string[]} areas files of areas to keep out of
   */
  constructor(ended, keep, areas) {
    this.ended = ended;
    this.keep = keep;
    this.asking = new Asking();
    this.askingPlace = new Asking();
    this.askingWay = new Asking();
    /** Whether a way is computed. */
    this.isSeeking = false;
    /** @type {any} */
    this.map = undefined;
    /** @type {Line | undefined} */
    this.shown = undefined;
    /** @type {any} */
    this.frame = undefined;
    /** @type {Place[]} */
    this.way = [];
    /** @type {Mark} */
    this.sets = "at";
    /** @type {string | undefined} */
    this.picture = undefined;
    this.image = element("img", { alt: "" });
    this.marks = svg("svg", {
      class: "marks", role: "application", tabindex: 0, "aria-label": "Places of the map", "aria-describedby": "marks-help",
    });
    this.marks.addEventListener("click", (event) => this.point(/** @type {MouseEvent} */ (event)));
    this.marks.addEventListener("keydown", (event) => this.press(/** @type {KeyboardEvent} */ (event)));
    this.layers = element("div", { class: "choice", role: "group", "aria-label": "What the map shows" });
    this.setting = element("div", { class: "choice", role: "group", "aria-label": "What a click sets" });
    this.words = element("p", { class: "sentence", id: "map-words" });
    this.fields = element("div", { class: "places" });
    this.place = element("div", { class: "card", "aria-live": "polite", id: "place" });
    this.wayCard = element("div", { class: "card", "aria-live": "polite", id: "way" });
    this.wayChoices = this.choicesOfWay(areas);
    this.profile = element("div", { class: "figures" });
    this.out = element("div");
    this.body = element("div", { class: "map" }, [
      element("div", {}, [
        this.layers,
        element("div", { class: "picture" }, [this.image, this.marks]),
        this.setting,
        element("p", { class: "setup", id: "marks-help" }, [
          "Click the map, or focus it: arrow keys move the cross by a cell, with Shift by ten; l, s and g look there, start there and go there.",
        ]),
        this.words,
        element("div", { class: "asked" }, [this.fields, this.wayChoices]),
      ]),
      element("div", { class: "beside" }, [this.place, this.wayCard]),
    ]);
    this.element = element("div", {}, [this.body, this.profile, this.out]);
  }

  /** @param {string[]} areas */
  choicesOfWay(areas) {
    const choice = (/** @type {string} */ id, /** @type {string} */ label, /** @type {[string, string][]} */ options) =>
      element("label", {}, [`${label} `, element("select", { id, onchange: (/** @type {any} */ event) => {
        if (!this.session) return;
        /** @type {any} */ (this.session)[id] = event.target.value;
        this.keep();
        this.askWay();
      } }, options.map(([value, text]) => element("option", { value }, [text])))]);
    return element("div", { class: "choice", role: "group", "aria-label": "Which way" }, [
      choice("least", "Least", [["time", "time"], ["energy", "energy"], ["risk", "time in the worst tenth"]]),
      choice("keepout", "Keep out of", [["", "nothing more"], .../** @type {[string, string][]} */ (areas.map((it) => [it, it]))]),
    ]);
  }

  /** @param {Session} session */
  ask(session) {
    this.session = session;
    for (const id of /** @type {const} */ (["least", "keepout"])) {
      const select = this.wayChoices.querySelector(`#${id}`);
      if (select instanceof HTMLSelectElement) select.value = session[id];
    }
    this.askMap(STAGES);
  }

  /** @param {number[]} stages */
  askMap(stages) {
    const { session } = this;
    if (!session) return;
    if (!session.dem) {
      this.stop();
      this.element.replaceChildren(element("div", { class: "card" }, [
        element("h2", {}, ["There is no map of heights"]),
        element("p", {}, ["Start the console with a folder that has one: a GeoTIFF, or text with x, y and z in each line."]),
        element("pre", { tabindex: 0 }, ["grouser terrain moon --out moon.tif\ngrouser serve ."]),
      ]));
      this.ended(undefined);
      return;
    }
    if (!this.body.isConnected) this.element.replaceChildren(this.body, this.profile, this.out);
    this.body.classList.add("stale");
    const question = { ...this.ofMap(), layers: [session.layer], shown: true, stages };
    this.asking.ask("map", question, (line) => {
      if (line.schema === "grouser.map.v1") this.map = line;
      else this.draw(line);
    }, (error) => {
      this.body.classList.remove("stale");
      if (error) {
        this.ended(error);
        return;
      }
      this.askPlace();
      this.askWay();
      this.ended(undefined);
    });
  }

  ofMap() {
    const session = /** @type {Session} */ (this.session);
    const course = session.which === "fixed" ? session.course : session.which;
    return { ...about(session), course_deg: course };
  }

  stop() {
    for (const asking of [this.asking, this.askingPlace, this.askingWay]) asking.stop();
  }

  /**
   * The picture of a layer, and what else there is to choose from.
   * @param {Line} line
   */
  draw(line) {
    this.shown = line;
    this.frame = line.frame;
    const [drawing] = line.drawings ?? [];
    if (drawing) {
      const old = this.picture;
      this.picture = URL.createObjectURL(new Blob([drawing.svg], { type: "image/svg+xml" }));
      this.image.setAttribute("src", this.picture);
      this.image.setAttribute("alt", `${drawing.caption}. ${line.sentences?.[0] ?? ""}`);
      if (old) URL.revokeObjectURL(old);
    }
    const [width, height] = this.frame.picture_mm;
    this.marks.setAttribute("viewBox", `0 0 ${width} ${height}`);
    const layer = (/** @type {any} */ { name, label, about: doc }) => element("button", {
      type: "button", title: doc, "aria-pressed": String(name === this.session?.layer), "data-layer": name, onclick: () => {
        if (!this.session) return;
        this.session.layer = name;
        this.keep();
        this.askMap([STAGES[STAGES.length - 1] ?? 200]);
      },
    }, [labelOf({ name, label })]);
    const focused = document.activeElement?.getAttribute("data-layer");
    const order = [...(line.layers ?? [])].sort((one, other) => Number(other.name === "verdict") - Number(one.name === "verdict"));
    this.layers.replaceChildren(...order.map(layer));
    if (focused) /** @type {any} */ (this.layers.querySelector(`[data-layer="${focused}"]`))?.focus();
    this.words.textContent = [...(line.sentences ?? []), ...(line.notes ?? [])].join(" ");
    this.showMarks();
    this.showFields();
    const areas = this.map?.keep_out ? element("button", { type: "button", onclick: () => this.saveAreas() }, ["Save keep-out.geojson"]) : null;
    this.out.replaceChildren(exportOf(line, undefined), ...(areas ? [areas] : []));
    this.setting.replaceChildren("A click sets: ", ...Object.entries(MARKS).map(([mark, [name]]) => element("button", {
      type: "button", "aria-pressed": String(mark === this.sets), onclick: (/** @type {any} */ event) => {
        this.sets = /** @type {Mark} */ (mark);
        for (const other of this.setting.querySelectorAll("button")) other.setAttribute("aria-pressed", String(other === event.currentTarget));
      },
    }, [name.toLowerCase()])));
  }

  async saveAreas() {
    await ask("map", { ...this.ofMap(), areas: true, shown: true }, new AbortController().signal, (line) => {
      for (const [name, content] of Object.entries(line.files ?? {})) save(name, content);
    }).catch((error) => this.ended(error));
  }

  /**
   * Where a place of the map is on the picture.
   * @param {Place} place
   */
  onPicture([x, y]) {
    const { corner_mm: corner, size_mm: size, south_west_m: low, north_east_m: high } = this.frame;
    return [
      corner[0] + (x - low[0]) / (high[0] - low[0]) * size[0],
      corner[1] + (high[1] - y) / (high[1] - low[1]) * size[1],
    ];
  }

  /** @param {MouseEvent} event */
  point(event) {
    if (!this.frame) return;
    const box = this.marks.getBoundingClientRect();
    const { picture_mm: all, corner_mm: corner, size_mm: size, south_west_m: low, north_east_m: high } = this.frame;
    const share = (/** @type {number} */ at, /** @type {0 | 1} */ of, /** @type {number} */ length) => (at / length * all[of] - corner[of]) / size[of];
    const [east, south] = [share(event.clientX - box.left, 0, box.width), share(event.clientY - box.top, 1, box.height)];
    if (Math.min(east, south) < 0 || Math.max(east, south) > 1) return;
    this.set(this.sets, [low[0] + east * (high[0] - low[0]), high[1] - south * (high[1] - low[1])]);
  }

  /** @param {KeyboardEvent} event */
  press(event) {
    if (!this.frame || !this.session || event.ctrlKey || event.metaKey || event.altKey) return;
    const { south_west_m: low, north_east_m: high, spacing_m: spacing } = this.frame;
    const middle = /** @type {Place} */ ([(low[0] + high[0]) / 2, (low[1] + high[1]) / 2]);
    const [x, y] = placeOf(this.session.at) ?? middle;
    const reach = event.shiftKey ? 10 : 1;
    const steps = /** @type {Record<string, Place>} */ ({ ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] });
    const step = steps[event.key];
    const mark = Object.entries(MARKS).find(([, [, , key]]) => key === event.key.toLowerCase());
    if (step) {
      const to = /** @type {Place} */ ([x + step[0] * reach * spacing[0], y + step[1] * reach * spacing[1]]);
      const within = (/** @type {0 | 1} */ of) => Math.min(high[of], Math.max(low[of], to[of]));
      this.set("at", [within(0), within(1)]);
    } else if (mark) this.set(/** @type {Mark} */ (mark[0]), [x, y]);
    else return;
    event.preventDefault();
  }

  /**
   * Sets a place, and asks about it.
   * @param {Mark} mark
   * @param {Place} place
   */
  set(mark, place) {
    if (!this.session) return;
    const round = (/** @type {number} */ at) => String(Number(at.toFixed(2)));
    this.session[mark] = place.map(round).join(",");
    this.keep();
    this.showMarks();
    this.showFields();
    if (mark === "at") this.askPlace();
    else {
      this.way = [];
      this.askWay();
    }
  }

  /** The places in digits. */
  showFields() {
    const { session } = this;
    if (!session || this.fields.contains(document.activeElement)) return;
    const row = (/** @type {Mark} */ mark) => {
      const [name] = MARKS[mark];
      const inputs = [0, 1].map((of) => element("input", {
        type: "number", step: "any", "aria-label": `${name}, ${of ? "y" : "x"} in m`, value: placeOf(session[mark])?.[of] ?? "",
        "data-place": `${mark}-${of ? "y" : "x"}`,
      }));
      const changed = () => {
        const numbers = inputs.map((it) => /** @type {HTMLInputElement} */ (it).valueAsNumber);
        if (numbers.every(Number.isFinite)) this.set(mark, /** @type {Place} */ (numbers));
      };
      inputs.forEach((it) => it.addEventListener("change", changed));
      return element("div", { role: "group", "aria-label": name, class: "row" }, [element("span", {}, [`${name} [m]`]), ...inputs]);
    };
    this.fields.replaceChildren(...Object.keys(MARKS).map((mark) => row(/** @type {Mark} */ (mark))));
  }

  /** The places and the way, over the picture. */
  showMarks() {
    const { session } = this;
    if (!session || !this.frame) return;
    const points = this.way.map((place) => this.onPicture(place).join(",")).join(" ");
    const lines = points ? [svg("polyline", { class: "halo", points }), svg("polyline", { class: "way", points })] : [];
    const marks = Object.entries(MARKS).flatMap(([mark, [name, sign]]) => {
      const place = placeOf(session[/** @type {Mark} */ (mark)]);
      if (!place) return [];
      const [x, y] = this.onPicture(place);
      if (mark === "at") return [svg("path", { class: "halo", d: `M${x} ${y}m-4 0h8m-4 -4v8` }), svg("path", { class: "cross", d: `M${x} ${y}m-4 0h8m-4 -4v8` })];
      return [svg("g", { class: "end", transform: `translate(${x} ${y})` }, [
        svg("title", {}, [name]), svg("circle", { r: 2.8 }), svg("text", { y: 1.25, "text-anchor": "middle" }, [sign]),
      ])];
    });
    this.marks.replaceChildren(...lines, ...marks);
  }

  askPlace() {
    const { session } = this;
    const at = session && placeOf(session.at);
    if (!at) {
      this.place.replaceChildren(element("h2", {}, ["A place"]), element("p", {}, ["Click the map: its slope, heading and slip are shown here, and the verdict with its reason."]));
      return;
    }
    this.place.classList.add("stale");
    /** @type {any} */
    let found;
    this.askingPlace.ask("map-place", { ...this.ofMap(), at_m: at, shown: true }, (line) => {
      if (line.schema === "grouser.map-place.v1") found = line;
      else this.showPlace(found, line.sentences?.[0] ?? "");
    }, (error) => {
      this.place.classList.remove("stale");
      if (error) this.place.replaceChildren(element("h2", {}, ["A place"]), element("p", { class: "error" }, [error.message]));
    });
  }

  /**
   * @param {any} found
   * @param {string} sentence
   */
  showPlace(found, sentence) {
    const row = (/** @type {string} */ label, /** @type {string} */ column, /** @type {any} */ value) => element("tr", {}, [
      element("th", { scope: "row" }, [label]), element("td", { "data-column": column }, [four(value)]),
    ]);
    const rows = (this.shown?.layers ?? []).filter(({ name }) => name !== "verdict" && name in found);
    this.place.replaceChildren(
      element("h2", {}, ["This place"]),
      ...[found.advice ? badge(found.advice.verdict) : null].filter((it) => it !== null),
      element("p", { class: "sentence", "data-column": "sentence" }, [sentence]),
      ...(found.advice ? [ruleOf(this.map?.inputs)].filter((it) => it !== null) : []),
      element("table", {}, [
        element("caption", {}, [`x ${four(found.x_m)} m, y ${four(found.y_m)} m`]),
        element("tbody", {}, [row("height [m]", "z_m", found.z_m), ...rows.map((layer) => row(labelOf(layer), layer.name, found[layer.name])),
          ...(found.advice ? [row("heading offset from the contour, uphill [°]", "yaw_deg", found.advice.yaw_deg)] : []),
        ]),
      ]),
    );
  }

  askWay() {
    const { session } = this;
    const [from, to] = [placeOf(session?.from ?? ""), placeOf(session?.to ?? "")];
    if (!session || !from || !to) {
      this.askingWay.stop();
      this.isSeeking = false;
      this.wayCard.replaceChildren(element("h2", {}, ["A way"]), element("p", {}, ["Set a start and a goal: the cheapest way, and what it takes."]));
      this.profile.replaceChildren();
      return;
    }
    this.wayCard.classList.add("stale");
    this.isSeeking = true;
    announce(saidOf(this));
    const question = {
      ...about(session), from_m: from, to_m: to, minimise: session.least,
      ...(session.keepout ? { keep_out: session.keepout } : {}), shown: true, figures: true,
    };
    /** @type {any} */
    let found;
    this.askingWay.ask("route", question, (line) => {
      if (line.schema === "grouser.route.v1") found = line;
      else this.showWay(found, line);
    }, (error) => {
      this.wayCard.classList.remove("stale");
      this.isSeeking = false;
      announce(saidOf(this));
      if (!error) return;
      this.way = [];
      this.showMarks();
      this.wayCard.replaceChildren(element("h2", {}, ["A way"]), element("p", { class: "error", role: "alert" }, [error.message]));
      this.profile.replaceChildren();
    });
  }

  /**
   * @param {any} found
   * @param {Line} shown
   */
  showWay(found, shown) {
    this.way = found.waypoints ?? [];
    this.showMarks();
    const rows = TAKES.filter(([column]) => typeof found[column] === "number").map(([column, label]) => element("tr", {}, [
      element("th", { scope: "row" }, [label]), element("td", { "data-column": column }, [four(found[column])]),
    ]));
    const files = Object.entries(shown.files ?? {}).map(([name, content]) =>
      element("button", { type: "button", onclick: () => save(name, content) }, [`Save ${name}`]));
    this.wayCard.replaceChildren(
      element("h2", {}, ["The way"]),
      ...(found.verdict ? [badge(found.verdict), ruleOf(found.inputs)] : []).filter((it) => it !== null),
      ...(shown.sentences ?? []).map((it) => element("p", { class: "sentence" }, [it])),
      element("table", {}, [element("caption", {}, ["By the tables of the steady motion"]), element("tbody", {}, rows)]),
      element("pre", { id: "way-command", tabindex: 0 }, [shown.command ?? ""]),
      element("div", { class: "actions" }, files),
    );
    this.profile.replaceChildren(...(shown.figures ?? []).map(({ caption, svg: drawn }) => element("figure", {}, [
      element("img", { src: `data:image/svg+xml,${encodeURIComponent(drawn)}`, alt: `${caption}, along the way` }),
    ])));
  }
}

/** What there is, in a few words, for who does not see it. */
export function saidOf(/** @type {MapAnswer} */ answer) {
  if (answer.isSeeking) return "computing the way …";
  return answer.map ? "the map is up to date" : "there is no map";
}

/** Files of the folder as options of a choice. */
export function offer(/** @type {string} */ id, /** @type {string[]} */ paths) {
  byId(id).replaceChildren(...paths.map((path) => element("option", { value: path }, [path])));
}
