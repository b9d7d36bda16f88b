// The eighth view: a log of a drive beside what is predicted for it, over time, and what a part of it
// points to.

import { Asking } from "./api.js";
import { drawOver } from "./chart.js";
import { element, four, svg } from "./dom.js";
import { about as aboutScenario } from "./heading.js";
import { StudyAnswer } from "./study.js";

/** @typedef {import("./session.js").Session} Session */
/** @typedef {import("./api.js").Line} Line */
/** @typedef {import("./api.js").Row} Row */

/** Samples behind the bands. */
const SAMPLES = 50;
/** What the column of a quantity has before it where it is measured, and measured less predicted. */
const [MEASURED, RESIDUAL] = ["measured_", "residual_"];
/** What it has behind it, for the ends of a band. */
const ENDS = ["_p2_5", "_p97_5"];
/** What the differences say of a cause, in words. */
const FOUND = /** @type {Record<string, string>} */ ({
  "points-to": "pointed to", underdetermined: "not told apart from others", nothing: "not beyond doubt", "cannot-tell": "nothing learnt of it",
});
/** Parts of a log that stand in a list. */
const PARTS = 8;

/**
 * A channel of a log: what its columns begin with, which is its wheel, and its quantity.
 * @typedef {{wheel: string, quantity: string, title: string}} Channel
 */

/** The answer about a log. */
export class LogAnswer extends StudyAnswer {
  /**
   * @param {(error: Error | undefined) => void} ended
   * @param {() => void} started
   */
  constructor(ended, started) {
    super({
      start: "Replay the log",
      hint: "A log of the folder is replayed when you ask for it: what its instruments read beside what is predicted at the wheel speeds and the attitude that they read, and what the differences point to.",
      none: "no log is replayed yet",
      failed: "no replay",
    }, ended, started);
    /** @type {Row[]} the stretches of the log */
    this.rows = [];
    /** @type {Channel[]} */
    this.channels = [];
    /** @type {ReturnType<typeof drawOver>[]} */
    this.charts = [];
    this.parts = new Asking();
    const field = (/** @type {string} */ id) => element("input", { type: "number", id, step: "any" });
    this.from = field("from");
    this.to = field("to");
    this.list = element("select", { id: "part-of", onchange: () => {
      const [from, to] = String(/** @type {any} */ (this.list).value).split(" ");
      if (to) this.choose(from ? Number(from) : undefined, Number(to));
    } });
    this.why = element("div", { id: "why-part", "aria-live": "polite" });
    this.time = element("input", { type: "range", id: "stretch", min: 0, max: 0, step: 1, value: 0, "aria-label": "Time, in stretches of the log", oninput: () => this.show(Number(/** @type {any} */ (this.time).value)) });
    this.clock = element("output", { id: "stretch-clock" });
    this.now = element("div", { class: "card", id: "at-time" });
  }

  /**
   * @override
   * @param {Session} session
   * @returns {[string, object]}
   */
  question(session) {
    const samples = session.belief === "nominal" ? {} : { samples: SAMPLES };
    return ["replay", { ...aboutScenario(session), log: session.log, ...samples, shown: true, figures: true, slide: true }];
  }

  /**
   * @override
   * @param {Line} line
   */
  answer(line) {
    this.rows = /** @type {any} */ (line)["stretches"];
  }

  /**
   * @override
   * @param {Line} line
   */
  take(line) {
    super.take(line);
    const words = Object.assign({}, ...(line.tables ?? []).map((table) => table.words ?? {}));
    this.channels = Object.keys(this.rows[0] ?? {}).flatMap((name) => {
      const [, wheel = "", quantity] = /^(.*\.)?measured_(.*)$/.exec(name) ?? [];
      const of = wheel && `, ${wheel.slice(0, -1)}`;
      return quantity ? [{ wheel, quantity, title: `${words[quantity] ?? quantity}${of}` }] : [];
    });
    this.parts.stop();
    this.why.replaceChildren();
    this.charts = [];
    const figures = this.channels.flatMap((channel) => this.chartsOf(channel));
    this.offerParts();
    this.time.setAttribute("max", String(this.rows.length - 1));
    this.body.querySelector(".figures")?.replaceWith(
      element("section", { "aria-label": "The log over time" }, [
        element("fieldset", { id: "part" }, [
          element("legend", {}, ["What a part of the log points to"]),
          element("div", { class: "choice" }, [
            element("label", {}, ["Part ", this.list]), element("label", {}, ["from ", this.from, " s"]), element("label", {}, ["to ", this.to, " s"]),
            element("button", { type: "button", id: "explain", onclick: () => this.explain() }, ["Explain this part"]),
          ]),
          element("p", { class: "setup" }, ["Draw over a chart, choose a part or write its ends: the differences of that part alone are explained. A click on a chart leads to its time."]),
          this.why,
        ]),
        element("div", { class: "timeline", role: "group", "aria-label": "Time line" }, [element("span", {}, ["Time"]), this.time, this.clock]),
        this.now,
        element("p", { class: "legend", "aria-label": "Curves" }, ["measured", "predicted"].map((name, place) => element("span", {}, [
          svg("svg", { viewBox: "0 0 30 8", class: "chart", "aria-hidden": "true" }, [svg("line", { class: place ? "curve second" : "curve", x1: 0, x2: 30, y1: 4, y2: 4 })]), ` ${name}`,
        ]))),
        element("div", { class: "figures" }, figures),
      ]),
    );
    this.show(0);
  }

  /**
   * Two charts of a channel: both sides, and measured less predicted.
   * @param {Channel} channel
   */
  chartsOf({ wheel, quantity, title }) {
    const over = (/** @type {string} */ column) => ({ points: /** @type {[number, number][]} */ (this.numbers([column])) });
    const [measured, predicted, residual] = [MEASURED, "", RESIDUAL].map((before) => `${wheel}${before}${quantity}`);
    const band = /** @type {[number, number, number][]} */ (this.numbers(ENDS.map((end) => `${wheel}${quantity}${end}`)));
    const both = { title, x: "time [s]", y: title, curves: [over(measured ?? ""), over(predicted ?? "")], band };
    const apart = { title: `${title}: measured less predicted`, x: "time [s]", y: "measured less predicted", curves: [over(residual ?? "")] };
    return [both, apart].map((chart) => {
      const made = drawOver(chart, (time) => this.goTo(time), (from, to) => this.choose(from, to));
      this.charts.push(made);
      return element("figure", {}, [made.drawn]);
    });
  }

  /**
   * The times of the stretches that have some columns, with these.
   * @param {string[]} columns
   */
  numbers(columns) {
    const all = this.rows.map((row) => [row["time_s"], ...columns.map((column) => row[column])]);
    return all.filter((numbers) => numbers.every((it) => typeof it === "number"));
  }

  /** Parts of the log with as many stretches each. The first begins where the log does, which no stretch says. */
  offerParts() {
    const times = this.rows.map((row) => row["time_s"]);
    const ends = Array.from({ length: PARTS }, (_, place) => times[Math.ceil((place + 1) * times.length / PARTS) - 1]);
    const parts = ends.map((to, place) => [ends[place - 1], to]).filter(([from = -Infinity, to]) => to > from);
    this.list.replaceChildren(element("option", { value: "" }, ["choose …"]), ...parts.map(([from, to]) => element("option", { value: `${from ?? ""} ${to}` }, [`${from === undefined ? "start" : four(from)} to ${four(to)} s`])));
  }

  /**
   * Takes a part of the log, and asks what it points to.
   * @param {number | undefined} from [s], where it is not the log's own beginning
   * @param {number} to [s]
   */
  choose(from, to) {
    for (const [field, time] of /** @type {[any, number | undefined][]} */ ([[this.from, from], [this.to, to]])) field.value = time === undefined ? "" : String(Number(time.toFixed(3)));
    this.explain();
  }

  /** Asks what the part of the fields points to. */
  explain() {
    const fields = /** @type {HTMLInputElement[]} */ ([this.from, this.to]);
    // An end that is left empty is that of the log.
    const [from, to] = fields.map(({ value }) => value ? Number(value) : undefined);
    if (!this.session || (from ?? to) === undefined || fields.some((it) => it.validity.badInput)) {
      this.why.replaceChildren(element("p", { class: "error" }, ["Write both ends of the part, in seconds, or one of them."]));
      return;
    }
    for (const { mark } of this.charts) mark(from ?? -Infinity, to ?? Infinity);
    this.why.classList.add("stale");
    const [name, { samples: _, slide: __, figures: ___, ...question }] = /** @type {[string, any]} */ (this.question(this.session));
    /** @type {any} */
    let found;
    this.parts.ask(name, { ...question, from_s: from, to_s: to }, (line) => {
      if (line.schema === "grouser.shown.v1") this.because(found, line);
      else found = line;
    }, (error) => {
      this.why.classList.remove("stale");
      if (error) this.why.replaceChildren(element("p", { class: "error", id: "part-error" }, [error.message]));
    });
  }

  /**
   * Says what a part points to, and what its best causes explain.
   * @param {any} found
   * @param {Line} line
   */
  because(found, line) {
    const causes = found.best_causes.map((/** @type {string} */ cause) => found.findings.find((/** @type {Row} */ it) => it["cause"] === cause));
    this.why.replaceChildren(
      element("p", { class: "found", id: "part-found" }, [found.points_to.join("; ")]),
      element("p", { class: "sentence" }, [
        causes.length ? "What each cause explains of the differences of this part, if it is the only one:" : "No cause explains more of this part than chance does.",
      ]),
      element("ol", { id: "causes" }, causes.map((/** @type {Row} */ it) => element("li", { "data-cause": it["cause"] }, [
        `${it["cause"].replace(/-/g, " ")} (${it["meaning"]}): `, element("strong", {}, [`${Math.round(100 * it["share_alone"])} %`]), `, ${FOUND[it["finding"]] ?? it["finding"]}`,
      ]))),
      element("p", { class: "setup" }, [`Stretches: ${found.replayed.explained_stretches}, of ${found.replayed.records} records. `, element("code", { id: "part-command" }, [line.command ?? ""])]),
    );
  }

  /**
   * Shows the stretch that ends the nearest to a time.
   * @param {number} time [s]
   */
  goTo(time) {
    const apart = this.rows.map((row) => Math.abs(row["time_s"] - time));
    this.show(apart.indexOf(Math.min(...apart)));
  }

  /** @param {number} place of the stretch */
  show(place) {
    const row = this.rows[place];
    if (!row) return;
    const time = four(row["time_s"]);
    /** @type {any} */ (this.time).value = String(place);
    this.time.setAttribute("aria-valuetext", `${time} s`);
    this.clock.textContent = `${time} s`;
    for (const { cursor } of this.charts) cursor(row["time_s"]);
    const names = ["measured", "predicted", "measured less predicted"];
    this.now.replaceChildren(element("table", {}, [
      element("caption", {}, [`The stretch that ends at ${time} s`]),
      element("thead", {}, [element("tr", {}, [element("td"), ...names.map((name) => element("th", { scope: "col" }, [name]))])]),
      element("tbody", {}, this.channels.map(({ wheel, quantity, title }) => element("tr", {}, [
        element("th", { scope: "row" }, [title]),
        ...[MEASURED, "", RESIDUAL].map((before) => element("td", { "data-column": `${wheel}${before}${quantity}` }, [four(row[`${wheel}${before}${quantity}`])])),
      ]))),
    ]));
  }

  /** @override */
  stop() {
    this.parts.stop();
    super.stop();
  }
}
