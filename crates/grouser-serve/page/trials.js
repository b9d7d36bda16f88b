// The measured trials of a fit, any of which may be left out by a click or by keys.

import { Asking } from "./api.js";
import { SIZE, scaleOf } from "./chart.js";
import { element, four, svg } from "./dom.js";

/** @typedef {import("./session.js").Session} Session */
/** @typedef {import("./api.js").Row} Row */

/** What may be shown over the slip ratio: column, title with its unit; the first that was read is. */
const READ = /** @type {[string, string][]} */ ([
  ["drawbar_pull_n", "Drawbar pull [N]"], ["torque_nm", "Torque [N·m]"], ["sinkage_mm", "Sinkage [mm]"], ["side_force_n", "Side force [N]"],
]);

/** How near to a trial a click is one on it, in units of the chart. */
const NEAR = 14;

/**
 * Conditions on rows as they stand in a field.
 * @param {string} text
 */
export function conditionsOf(text) {
  return text.split(";").map((it) => it.trim()).filter(Boolean);
}

/** The trials over the slip ratio. */
export class Trials {
  /** @param {() => void} changed */
  constructor(changed) {
    this.changed = changed;
    this.asking = new Asking();
    /** @type {Row[]} */
    this.rows = [];
    /** @type {Set<string>} the lines of those that are left out */
    this.without = new Set();
    this.place = 0;
    /** What was asked last, as text. */
    this.asked = "";
    /** @type {Row[]} those that are drawn */
    this.shown = [];
    /** @type {number[][]} where they are drawn */
    this.places = [];
    this.words = element("output", { id: "trial-words", "aria-live": "polite" });
    this.count = element("p", { class: "sentence", id: "trial-count" });
    this.points = svg("svg", {
      class: "chart picked", id: "trials", role: "application", tabindex: 0, viewBox: "0 0 420 250",
      "aria-label": "Measured trials", "aria-describedby": "trials-help",
    });
    this.points.addEventListener("keydown", (event) => this.press(/** @type {KeyboardEvent} */ (event)));
    this.points.addEventListener("click", (event) => this.point(/** @type {MouseEvent} */ (event)));
    this.all = element("button", { type: "button", id: "all-trials", onclick: () => this.set([]) }, ["Take all again"]);
    this.element = element("figure", { class: "trials" }, [
      this.points, this.count,
      element("p", { class: "setup", id: "trials-help" }, [
        "A click leaves a trial out of the fit, another takes it back; arrow keys go from trial to trial, Enter or the space bar does what a click does. A fit without trials that do not suit is no better a fit: say why they are left out.",
      ]),
      element("div", { class: "choice" }, [this.all, this.words]),
    ]);
  }

  /** @param {Session} session */
  ask(session) {
    this.session = session;
    this.without = new Set(session.without.split(",").filter(Boolean));
    const { wheel, rover, data } = session;
    const question = { data, ...(wheel ? { wheel } : { rover }), where: conditionsOf(session.where) };
    const asked = JSON.stringify(question);
    if (asked === this.asked) {
      this.draw();
      return;
    }
    this.asked = asked;
    this.asking.ask("fit-task", question, (line) => {
      this.rows = (line.rows ?? []).sort((one, other) => one["slip_ratio"] - other["slip_ratio"]);
      this.place = 0;
      this.draw();
    }, (error) => {
      if (!error) return;
      this.rows = [];
      this.draw();
      this.count.textContent = error.message;
    });
  }

  /** The trials in a table of numbers; their points. */
  draw() {
    const [column, title] = READ.find(([name]) => this.rows.some((row) => typeof row[name] === "number")) ?? ["", ""];
    const shown = this.rows.filter((row) => typeof row[column] === "number");
    this.shown = shown;
    this.points.replaceChildren();
    this.points.classList.toggle("empty", shown.length === 0);
    const out = this.rows.filter((row) => this.without.has(String(row["line"]))).length;
    this.count.textContent = out ? `The fit goes without ${out} of ${this.rows.length} trials.` : `${this.rows.length} trials, all of which are fitted.`;
    this.all.toggleAttribute("disabled", out === 0);
    if (!shown.length) return;
    const { frame, x, y } = scaleOf({ title, x: "slip ratio", points: shown.map((row) => [row["slip_ratio"], row[column]]) });
    this.points.append(...frame, ...shown.map((row, place) => {
      const isOut = this.without.has(String(row["line"]));
      const [left, top] = [x(row["slip_ratio"]), y(row[column])];
      const about = [svg("title", {}, [this.said(row, column, title)])];
      const sign = isOut
        ? svg("path", { class: "trial out", "data-line": row["line"], d: `M${left - 4} ${top - 4}l8 8m0 -8l-8 8` }, about)
        : svg("circle", { class: "trial", "data-line": row["line"], cx: left, cy: top, r: 4 }, about);
      const ring = place === this.place ? [svg("circle", { class: "here", cx: left, cy: top, r: 8 })] : [];
      return svg("g", {}, [...ring, sign]);
    }));
    this.places = shown.map((row) => [x(row["slip_ratio"]), y(row[column])]);
    const here = shown[this.place];
    this.words.textContent = here ? this.said(here, column, title) : "";
  }

  /**
   * A trial in words.
   * @param {Row} row
   * @param {string} column
   * @param {string} title
   */
  said(row, column, title) {
    const is = this.without.has(String(row["line"])) ? "left out" : "fitted";
    return `Line ${row["line"]}: slip ratio ${four(row["slip_ratio"])}, load ${four(row["load_n"])} N, ${title.toLowerCase().replace(/ \[.*/, "")} ${four(row[column])}${title.replace(/.*\[(.*)\]/, " $1")}: ${is}`;
  }

  /**
   * Turns the trial that is the nearest to a click, if one is near.
   * @param {MouseEvent} event
   */
  point(event) {
    const box = this.points.getBoundingClientRect();
    const scale = SIZE[0] / box.width;
    const [left, top] = [(event.clientX - box.left) * scale, (event.clientY - box.top) * scale];
    const apart = this.places.map(([x = 0, y = 0]) => Math.hypot(x - left, y - top));
    const nearest = Math.min(...apart);
    const row = this.shown[apart.indexOf(nearest)];
    if (!row || nearest > NEAR) return;
    this.place = apart.indexOf(nearest);
    this.turn(row);
  }

  /** @param {KeyboardEvent} event */
  press(event) {
    const count = this.shown.length;
    const step = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1 }[event.key];
    const row = this.shown[this.place];
    if (step && count) {
      this.place = (this.place + step + count) % count;
      this.draw();
    } else if ((event.key === "Enter" || event.key === " ") && row) this.turn(row);
    else return;
    event.preventDefault();
  }

  /**
   * Leaves a trial out, or takes it back.
   * @param {Row} row
   */
  turn(row) {
    const line = String(row["line"]);
    const others = [...this.without].filter((it) => it !== line);
    this.set(this.without.has(line) ? others : [...others, line]);
  }

  /** @param {string[]} without */
  set(without) {
    if (!this.session) return;
    this.session.without = [...without].sort((one, other) => Number(one) - Number(other)).join(",");
    this.without = new Set(without);
    this.draw();
    this.changed();
  }

  stop() {
    this.asking.stop();
  }
}
