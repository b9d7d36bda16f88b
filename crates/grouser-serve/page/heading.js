// The first view: the heading that holds the contour on a slope, its verdict, and set-ups beside
// each other.

import { Asking } from "./api.js";
import { draw } from "./chart.js";
import { byId, element, four, save } from "./dom.js";
import { LOST } from "./engine.js";
import { setOf } from "./session.js";

/** @typedef {import("./session.js").Session} Session */
/** @typedef {import("./api.js").Row} Row */
/** @typedef {import("./api.js").Line} Line */

/** Samples of the answers: the soil as written, a draft, and the card's. */
const STAGES = [0, 20, 200];
/** Samples of the first chart, and of answers on other courses than the contour. */
const FEW = [0, 40];
/** Slopes of the chart [°]. */
const SLOPES = Array.from({ length: 16 }, (_, place) => 2 * place);

/** Each verdict with a sign of its own: colours alone say nothing to some. */
export const VERDICTS = /** @type {Record<string, [string, string]>} */ ({
  go: ["✓", "go"], caution: ["!", "caution"], cannot_tell: ["?", "cannot tell"], no_go: ["✕", "no-go"],
});

/**
 * What is asked of a set-up, whatever the question.
 * @param {Session} session
 */
export function about(session) {
  const { rover, soil, model } = session;
  return { rover, soil, ...(model ? { model } : {}), set: setOf(session, ["soil", "rover", "scenario"]) };
}

/**
 * The thresholds of a verdict, as the question had them.
 * @param {Record<string, any> | undefined} rule the inputs of its answer
 */
export function ruleOf(rule) {
  if (typeof rule?.["go_slip_ratio"] !== "number") return null;
  const percent = (/** @type {string} */ key) => `${four(100 * rule[key])} %`;
  return element("p", { class: "rule", "data-column": "rule" }, [
    `Go: a heading holds with a slip ratio up to ${four(rule["go_slip_ratio"])} in at least ${percent("go_probability")} of the samples, and the drift stays below ${four(rule["go_drift_m_per_m"])} m/m. `,
    `No-go: in at least ${percent("no_go_probability")} none holds with one up to ${four(rule["no_go_slip_ratio"])}. Between them: caution.`,
  ]);
}

/**
 * @param {Session} session
 * @param {number[]} stages
 */
export function stagesOf(session, stages) {
  return session.belief === "nominal" ? [0] : stages;
}

/** The answer of one set-up. */
export class Card {
  /**
   * @param {Session} session
   * @param {boolean} isPinned
   * @param {Node[]} actions
   * @param {(error: Error | undefined) => void} ended
   * @param {() => void} drawn
   */
  constructor(session, isPinned, actions, ended, drawn) {
    this.session = session;
    this.asking = new Asking();
    if (!isPinned) this.asking.watch = advance;
    this.askingPower = new Asking();
    this.askingChart = new Asking();
    this.ended = ended;
    this.drawn = drawn;
    /** The thresholds of its verdict. @type {Record<string, any> | undefined} */
    this.rule = undefined;
    /** @type {Row | undefined} */
    this.row = undefined;
    /** @type {Row | undefined} */
    this.written = undefined;
    /** @type {Row | undefined} */
    this.power = undefined;
    /** @type {Row[]} */
    this.curve = [];
    /** @type {Line | undefined} */
    this.shown = undefined;
    this.body = element("div");
    this.element = element("article", { class: isPinned ? "card pinned" : "card", "aria-label": isPinned ? "Pinned set-up" : "This set-up" }, [
      this.body,
      element("div", { class: "actions" }, actions),
    ]);
  }

  ask() {
    const { session } = this;
    this.element.classList.add("stale");
    const isContour = session.course === 0;
    const question = {
      ...about(session), slope_deg: session.slope, shown: true,
      ...(isContour ? {} : { course_deg: session.course, rim_speed_m_s: session.speed }),
      stages: stagesOf(session, isContour ? STAGES : FEW),
    };
    let stage = 0;
    this.asking.ask(isContour ? "heading" : "heading-map", question, (line) => {
      if (line.rows) {
        this.rule = /** @type {any} */ (line).inputs;
        this.row = line.rows[0];
        if (stage === 0) this.written = this.row;
        stage += 1;
      } else {
        this.shown = line;
        this.element.classList.remove("stale");
        this.render();
      }
    }, (error) => {
      this.element.classList.remove("stale");
      if (error) this.fail();
      // The chart's curve is then of as many samples as its point, and keeps nobody waiting.
      else if (isContour && session.belief !== "nominal") this.askChart(STAGES.slice(-1));
      this.ended(error);
    });
    const map = { ...about(session), slope_deg: session.slope, course_deg: session.course, rim_speed_m_s: session.speed, nominal: true };
    this.askingPower.ask("heading-map", map, (line) => {
      this.power = line.rows?.[0];
      this.render();
    }, () => {});
    this.askChart(stagesOf(session, FEW));
  }

  /** @param {number[]} stages */
  askChart(stages) {
    const { session } = this;
    const slopes = [...new Set([...SLOPES, session.slope])].sort((one, other) => one - other);
    const chart = { ...about(session), slope_deg: slopes, stages };
    this.askingChart.ask("heading", chart, (line) => {
      this.curve = line.rows ?? [];
      this.drawn();
    }, () => {});
  }

  stop() {
    for (const asking of [this.asking, this.askingPower, this.askingChart]) asking.stop();
  }

  fail() {
    this.row = this.written = this.power = this.shown = undefined;
    this.body.replaceChildren(element("p", { class: "number" }, ["–"]), element("p", {}, ["There is no answer: the message stands beside its cause."]));
  }

  /** The heading to set [°]. */
  yaw() {
    const { row } = this;
    if (!row) return undefined;
    return this.session.course === 0 ? row.yaw_deg : "yaw_deg_p50" in row ? row.yaw_deg_p50 : row.yaw_deg;
  }

  /** What the engine says of this slope, in its words. */
  sentence() {
    const { shown, session, row } = this;
    const all = shown?.sentences ?? [];
    if (session.course !== 0) {
      return "Verdicts are of the contour, course 0°: another course has a heading and its band.";
    }
    return all.find((it) => it.startsWith(`${session.slope}°: `)) ?? (row && row.status !== "ok" ? row.status : all[0]) ?? "";
  }

  render() {
    const { row, session } = this;
    if (!row) return;
    const yaw = this.yaw();
    const has = typeof yaw === "number";
    const uphill = has && yaw < 0 ? "downhill" : "uphill";
    const number = element("p", { class: "number" }, [
      has ? `${Math.abs(yaw).toFixed(1)}°` : "none",
      element("small", {}, [has ? ` nose ${uphill}${row.draws ? `, the median of ${row.draws} samples` : ""}` : " no heading holds it"]),
    ]);
    const verdict = VERDICTS[row.verdict];
    const badge = verdict
      ? element("p", { class: `verdict ${row.verdict}` }, [element("span", { "aria-hidden": "true" }, [verdict[0]]), verdict[1]])
      : null;
    const written = this.written ?? row;
    /** @type {[string, string, number][]} */
    const quantities = [
      ["Heading offset [°]", "yaw_deg", 1], ["Slip ratio", "slip_ratio", 1], ["Sinkage [mm]", "sinkage_mm", 1],
      ["Energy [J/m]", "energy_j_per_m", 1],
    ];
    const rows = quantities.map(([label, key]) => element("tr", {}, [
      element("th", { scope: "row" }, [label]),
      element("td", { "data-column": key }, [four(written[key])]),
      element("td", { "data-column": `${key}_p2_5` }, [`${key}_p2_5` in row ? four(row[`${key}_p2_5`]) : ""]),
      element("td", { "data-column": `${key}_p97_5` }, [`${key}_p97_5` in row ? four(row[`${key}_p97_5`]) : ""]),
    ]));
    rows.push(element("tr", {}, [
      element("th", { scope: "row" }, [`Power at ${session.speed} m/s [W]`]),
      element("td", { "data-column": "power_w" }, [four(this.power?.power_w)]), element("td"), element("td"),
    ]));
    const head = ["", "as written", "2.5 %", "97.5 %"].map((text) => text ? element("th", { scope: "col" }, [text]) : element("td"));
    const count = row.draws ? `${row.draws} samples` : "the soil as written";
    const changed = Object.entries(about(session).set).map(([key, value]) => `${key} = ${value}`);
    this.body.replaceChildren(
      number, ...(badge ? [badge] : []), element("p", { class: "sentence" }, [this.sentence()]),
      ...(badge ? [ruleOf(this.rule)].filter((it) => it !== null) : []),
      element("table", {}, [
        element("caption", {}, [`Slope ${session.slope}°, course ${session.course}°, ${count}`]),
        element("thead", {}, [element("tr", {}, head)]), element("tbody", {}, rows),
      ]),
      element("p", { class: "setup" }, [[`${session.rover} on ${session.soil}`, session.model, ...changed].filter(Boolean).join(" · ")]),
    );
  }
}

/**
 * The chart of set-ups: the first with its band and its point, and the next one.
 * @param {Card[]} cards
 */
export function chartOf(cards) {
  const points = (/** @type {Card} */ card) => {
    const rows = card.curve.filter((row) => typeof row.yaw_deg === "number");
    return /** @type {[number, number][]} */ (rows.map((row) => [row.slope_deg, row.yaw_deg]));
  };
  const [own, other] = cards;
  if (!own) return element("p");
  // Where no heading holds the contour in some of the samples, the band has no upper end.
  const bounded = own.curve.filter((row) => typeof row.yaw_deg_p2_5 === "number");
  const yaw = own.session.course === 0 ? own.yaw() : undefined;
  return draw({
    title: "Heading offset that holds the contour, uphill [°]",
    x: "slope [°]", y: "heading offset, uphill [°]",
    curves: [own, ...(other ? [other] : [])].map((card) => ({ points: points(card) })),
    band: bounded.map((row) => [row.slope_deg, row.yaw_deg_p2_5, row.yaw_deg_p97_5 ?? Infinity]),
    ...(typeof yaw === "number" ? { point: [own.session.slope, yaw] } : {}),
  });
}

/**
 * What leads out of the page: the command, the documents, the card, what is assumed.
 * @param {Line | undefined} shown
 * @param {{command: string, question: object | undefined} | undefined} card the command of the card,
 *   and what is asked for it where the engine draws cards
 */
export function exportOf(shown, card) {
  /** @type {(Node | string)[]} */
  const parts = [element("h2", {}, ["Take it along"])];
  const copy = (/** @type {string} */ text, /** @type {string} */ what) => element("button", {
    type: "button", onclick: async (/** @type {Event} */ event) => {
      const button = /** @type {HTMLElement} */ (event.currentTarget);
      await navigator.clipboard?.writeText(text).then(() => { button.textContent = "Copied"; }, () => {});
    },
  }, [what]);
  if (shown?.command) {
    parts.push(element("p", {}, ["The command that gives the same numbers:"]), element("pre", { id: "command", tabindex: 0 }, [shown.command]), copy(shown.command, "Copy the command"));
  }
  if (card) {
    const { command, question } = card;
    parts.push(element("p", {}, ["The operator's card of this set-up, as PDF:"]), element("pre", { tabindex: 0 }, [command]), copy(command, "Copy the card's command"));
    if (question) parts.push(" ", ...cardSaver(question));
    else parts.push(element("p", { id: "no-card" }, ["Cards are not drawn here: run the command."]));
  }
  for (const [name, content] of Object.entries(shown?.documents ?? {})) {
    parts.push(" ", element("button", { type: "button", onclick: () => save(name, content) }, [`Save ${name}`]));
  }
  if (shown) parts.push(" ", element("button", { type: "button", id: "slide", title: "A picture for a slide, 16 to 9, with one sentence" }, ["Save a slide (i)"]));
  const assumptions = shown?.assumptions ?? [];
  if (assumptions.length) {
    parts.push(element("details", {}, [
      element("summary", {}, [`What is assumed (${assumptions.length})`]),
      element("ul", {}, assumptions.map((it) => element("li", {}, [it]))),
    ]));
  }
  return element("div", { class: "export" }, parts);
}

/** The button of the card that is offered, what it asks for, and who asks. */
const saver = { asked: "", nodes: /** @type {Node[]} */ ([]), asking: new Asking() };

/**
 * A button that has the card drawn and saves it, and the place of what is wrong with it. It stays
 * while the same is asked for; another set-up stops the drawing.
 * @param {object} question
 */
function cardSaver(question) {
  const asked = JSON.stringify(question);
  if (asked === saver.asked) return saver.nodes;
  saver.asking.stop();
  const usual = "Save the card (PDF)";
  const wrong = element("span", { class: "error", role: "alert" });
  const button = element("button", { type: "button", id: "card-pdf", onclick: begin }, [usual]);
  let isDrawing = false;
  const end = (/** @type {string} */ problem) => {
    isDrawing = false;
    button.textContent = usual;
    button.removeAttribute("aria-busy");
    wrong.textContent = problem;
  };
  saver.asking.watch = ({ done = 0 }) => { button.textContent = `Drawing the card … ${done} samples`; };
  function begin() {
    if (isDrawing) return;
    isDrawing = true;
    wrong.textContent = "";
    button.textContent = "Drawing the card …";
    button.setAttribute("aria-busy", "true");
    let isSaved = false;
    saver.asking.ask("card", question, ({ pdf }) => {
      if (!pdf) return;
      save("card.pdf", Uint8Array.from(atob(pdf), (letter) => letter.charCodeAt(0)));
      isSaved = true;
    }, (error) => end(error?.message ?? (isSaved ? "" : LOST)));
  }
  saver.asked = asked;
  saver.nodes = [button, wrong];
  return saver.nodes;
}

/**
 * The card of a session: its command, from that of the heading, and what is asked for it.
 * @param {Session} session
 * @param {string | undefined} command
 * @param {boolean} isDrawn whether the engine draws cards
 */
export function cardOf(session, command, isDrawn) {
  const line = cardCommand(command);
  return line === undefined ? undefined : { command: line, question: isDrawn ? about(session) : undefined };
}

/** @param {string | undefined} command that of the heading */
function cardCommand(command) {
  if (!command?.startsWith("grouser heading ")) return undefined;
  const words = command.replace("grouser heading ", "grouser card ").replace(/ --(slope-deg|samples|seed) \S+/g, "").replace(/ --nominal/, "");
  return `${words} --out card.pdf`;
}

/** Says the answer to who does not see it. */
export function announce(/** @type {string} */ text) {
  byId("busy").textContent = text;
  byId("begun").hidden = true;
}

/**
 * Shows how far an answer is, to who sees it.
 * @param {Line} line
 */
export function advance({ what, done = 0, all }) {
  const [bar, words] = byId("begun").children;
  bar.setAttribute("max", String(all));
  bar.setAttribute("value", String(done));
  words.textContent = `${done} of ${all} ${what}`;
  byId("begun").hidden = false;
}
