// The fits that were made on this page: a list, and their numbers beside each other.

import { conditionsOf } from "./trials.js";
import { element, four, tableOf } from "./dom.js";

/** @typedef {import("./session.js").Session} Session */
/** @typedef {import("./api.js").Line} Line */
/** @typedef {import("./api.js").Row} Row */

/**
 * A fit that was made.
 * @typedef {object} Made
 * @property {number} number
 * @property {string} question as text: the same question is the same fit
 * @property {Session} session its settings
 * @property {Line} answer the object of its answer
 * @property {Line} shown what is shown of it
 */

/** Fits that are kept at the most: each has its figures and samples. */
const MOST = 8;
/** What quantities have errors in an answer, after the count of cells. */
const ERRORS = "overall";

/** The fits of a page, as long as it is open. */
export class Fits {
  /** @param {(made: Made) => void} takenUp */
  constructor(takenUp) {
    /** @type {Made[]} */
    this.all = [];
    this.count = 0;
    /** @type {number | undefined} the one that is shown */
    this.current = undefined;
    this.takenUp = takenUp;
    /** @type {(made: Made) => void} */
    this.show = () => {};
    this.title = element("summary");
    this.tables = element("div");
    this.element = element("details", { id: "fits", open: true, hidden: true }, [this.title, this.tables]);
  }

  /**
   * Keeps a fit in the place of one of the same question, or as the last.
   * @param {Omit<Made, "number">} fit
   */
  keep(fit) {
    const before = this.all.find(({ question }) => question === fit.question);
    const made = { ...fit, number: before?.number ?? (this.count += 1) };
    this.all = before ? this.all.map((it) => it === before ? made : it) : [...this.all, made].slice(-MOST);
    this.mark(made.number);
  }

  /** @param {string} question */
  of(question) {
    return this.all.find((it) => it.question === question);
  }

  /** @param {number | undefined} number of the fit that is shown */
  mark(number) {
    this.current = number;
    this.draw();
  }

  draw() {
    if (!this.all.length) return;
    const focused = document.activeElement?.id;
    const heads = ["Fit", "", "Data", "Start", "Fitted", "Left out", "Found"];
    const beside = this.all.length === 1 ? [] : [tableOf(besides(this.all))];
    this.element.hidden = false;
    this.title.textContent = `Fits of this page (${this.all.length})`;
    this.tables.replaceChildren(
      element("div", { class: "wide", tabindex: 0, role: "group", "aria-label": "Fits of this page" }, [element("table", { class: "fits" }, [
        element("thead", {}, [element("tr", {}, heads.map((text) => text ? element("th", { scope: "col", class: "text" }, [text]) : element("td")))]),
        element("tbody", {}, this.all.map((made) => this.row(made))),
      ])]),
      ...beside,
    );
    document.getElementById(focused ?? "")?.focus();
  }

  /** @param {Made} made */
  row(made) {
    const { number, session, shown } = made;
    const isShown = number === this.current;
    const out = session.without.split(",").filter(Boolean);
    const cells = [
      [session.data, ...conditionsOf(session.where)].join(", "), startOf(session),
      keysOf(made).map((key) => wordsOf(made, key).replace(/^soil /, "")).join(", "), out.length ? `${out.length}: line ${out.join(", ")}` : "none",
      shown.sentences?.[0] ?? "",
    ];
    const button = (/** @type {string} */ id, /** @type {string} */ text, /** @type {() => void} */ act) =>
      element("button", { type: "button", id: `${id}-${number}`, "aria-label": `${text} fit ${number}`, onclick: act }, [text]);
    return element("tr", isShown ? { "aria-current": "true" } : {}, [
      element("th", { scope: "row", class: "text" }, [`${number}${isShown ? " (shown)" : ""}`]),
      element("td", {}, [button("show", "Show", () => this.show(made)), " ", button("take-up", "Take up", () => this.takenUp(made))]),
      ...cells.map((text) => element("td", { class: "text" }, [text])),
    ]);
  }
}

/** @param {Made} made */
function keysOf({ answer }) {
  return (answer.rows ?? []).map((row) => String(row["key"]));
}

/**
 * A key or a column in words, as the tables of the fit have it.
 * @param {Made} made
 * @param {string} name
 */
function wordsOf({ shown }, name) {
  return shown.tables?.map(({ words }) => words?.[name]).find(Boolean) ?? name;
}

/**
 * What a fit starts from, and how it is searched.
 * @param {Session} session
 */
function startOf({ soil, wheel, rover, model, belief, set }) {
  const changed = Object.entries(set).filter(([key]) => /^(soil|wheel)\./.test(key)).map(([key, value]) => `${key} = ${value}`);
  return [soil, wheel || `the wheel of ${rover}`, model, belief === "nominal" ? "least squares" : "samples", ...changed].filter(Boolean).join(" · ");
}

/**
 * A fitted number with its interval; of one that was not fitted what the soil has.
 * @param {Made} made
 * @param {string} key
 */
function numberOf({ answer }, key) {
  const row = (answer.rows ?? []).find((it) => it["key"] === key);
  if (!row) {
    /** @type {any} */
    const soil = /** @type {any} */ (answer)["inputs"]?.soil;
    const held = key.split(".").slice(1).reduce((value, step) => value?.[step], soil);
    return typeof held === "number" ? `${four(held)}, as it was` : "–";
  }
  const { fit, fit_std: deviation, p2_5: low, p97_5: high } = row;
  if (typeof low === "number") return `${four(fit)} (${four(low)} to ${four(high)})`;
  return typeof deviation === "number" ? `${four(fit)} ± ${four(deviation)}` : `${four(fit)}, at its bound`;
}

/**
 * Fits beside each other: each number that one of them fits, and the errors.
 * @param {Made[]} all
 */
function besides(all) {
  const columns = ["number", ...all.map(({ number }) => `fit ${number}`)];
  const line = (/** @type {string} */ name, /** @type {(made: Made) => string} */ of) =>
    Object.fromEntries([["number", name], ...all.map((made) => [`fit ${made.number}`, of(made)])]);
  const unique = (/** @type {(made: Made) => string[]} */ of) => [...new Set(all.flatMap(of))];
  const errors = (/** @type {Made} */ { answer }) => /** @type {Row} */ (/** @type {any} */ (answer)[ERRORS] ?? {});
  const measured = unique((made) => Object.entries(errors(made)).filter(([, of]) => typeof of?.rmse === "number").map(([name]) => name));
  const named = (/** @type {string} */ name) => all.map((made) => wordsOf(made, name)).find((it) => it !== name) ?? name;
  return {
    caption: "Fits beside each other: least squares with the 95 % interval of the samples, or ± a standard deviation without; errors are of the trials that were fitted",
    columns, labels: ["", ...columns.slice(1)],
    rows: [
      ...unique(keysOf).map((key) => line(named(key), (made) => numberOf(made, key))),
      ...measured.map((name) => line(`error (RMSE): ${named(name)}`, (made) => four(errors(made)[name]?.rmse))),
    ],
  };
}
