// The second view: a wheel cut open, its forces over the slip ratio, and what they depend on.

import { Asking } from "./api.js";
import { draw } from "./chart.js";
import { element, four, picturesOf } from "./dom.js";
import { advance, exportOf, stagesOf } from "./heading.js";
import { setOf } from "./session.js";

/** @typedef {import("./session.js").Session} Session */
/** @typedef {import("./api.js").Row} Row */
/** @typedef {import("./api.js").Line} Line */
/** @typedef {import("./api.js").Key} Key */

/** Slip ratios of the charts. */
const SLIPS = Array.from({ length: 25 }, (_, place) => Number((-0.3 + 0.05 * place).toFixed(2)));
const STAGES = [0, 40];
const GRAVITY = "scenario.gravity_m_s2";

/** The charts: column, title, quantity with its unit. */
const CHARTS = /** @type {[string, string, string][]} */ ([
  ["drawbar_pull_n", "Drawbar pull", "pull [N]"],
  ["side_force_n", "Side force", "side force [N]"],
  ["torque_nm", "Torque", "torque [N·m]"],
  ["sinkage_mm", "Sinkage", "sinkage [mm]"],
]);

/**
 * What is asked of a wheel, whatever the question.
 * @param {Session} session
 */
export function about(session) {
  const { soil, wheel, rover, model } = session;
  const gravity = session.set[GRAVITY];
  return {
    soil, ...(wheel ? { wheel } : { rover }), ...(model ? { model } : {}), ...(gravity === undefined ? {} : { gravity_m_s2: gravity }),
    set: setOf(session, ["soil", "wheel"]),
  };
}

/** The answer about a wheel. */
export class WheelAnswer {
  /** @param {(error: Error | undefined) => void} ended */
  constructor(ended) {
    this.ended = ended;
    this.asking = new Asking();
    this.asking.watch = advance;
    this.askingDrawing = new Asking();
    this.askingWorth = new Asking();
    /** @type {Row[]} */
    this.rows = [];
    /** @type {Row | undefined} */
    this.written = undefined;
    /** @type {Line | undefined} */
    this.shown = undefined;
    /** @type {Key[]} */
    this.keys = [];
    this.numbers = element("div", { class: "card" });
    this.figures = element("div", { class: "figures" });
    /** @type {Node[]} */
    this.drawings = [];
    /** @type {Node[]} */
    this.charts = [];
    this.worth = element("div", { class: "card" });
    this.export = element("div");
    this.element = element("div", {}, [
      this.figures, this.export,
    ]);
  }

  /** @param {Session} session */
  ask(session) {
    this.session = session;
    const slips = [...new Set([...SLIPS, session.slip])].sort((one, other) => one - other);
    const at = { load_n: session.load, slip_angle_deg: session.angle };
    const question = { ...about(session), ...at, slip_ratio: slips, stages: stagesOf(session, STAGES), shown: true };
    let stage = 0;
    this.numbers.classList.add("stale");
    this.asking.ask("wheel-test", question, (line) => {
      if (line.rows) {
        this.rows = line.rows;
        if (stage === 0) this.written = this.here();
        stage += 1;
      } else {
        this.shown = line;
        this.render();
      }
    }, (error) => {
      this.numbers.classList.remove("stale");
      this.ended(error);
    });
    this.askingDrawing.ask("wheel-drawing", { ...about(session), ...at, slip_ratio: session.slip }, (line) => this.picture(line), (error) => {
      if (error) this.drawings = [element("p", { class: "error" }, [error.message])];
      this.arrange();
    });
    const worth = { ...about(session), ...at, slip_ratio: session.slip, gradients: ["all"], nominal: true };
    this.askingWorth.ask("wheel-test", worth, (line) => this.weigh(line.rows?.[0]), () => {});
  }

  stop() {
    for (const asking of [this.asking, this.askingDrawing, this.askingWorth]) asking.stop();
  }

  /** The row where the wheel is. */
  here() {
    return this.rows.find((row) => row.slip_ratio === this.session?.slip);
  }

  render() {
    const { session } = this;
    const row = this.here();
    if (!row || !session) return;
    this.numbers.classList.remove("stale");
    const pull = row.drawbar_pull_n;
    const written = this.written ?? row;
    const rows = CHARTS.map(([key, , label]) => element("tr", {}, [
      element("th", { scope: "row" }, [label]),
      element("td", { "data-column": key }, [four(written[key])]),
      element("td", {}, [`${key}_p2_5` in row ? four(row[`${key}_p2_5`]) : ""]),
      element("td", {}, [`${key}_p97_5` in row ? four(row[`${key}_p97_5`]) : ""]),
    ]));
    const head = ["", "as written", "2.5 %", "97.5 %"].map((text) => text ? element("th", { scope: "col" }, [text]) : element("td"));
    this.numbers.replaceChildren(
      element("p", { class: "number" }, [
        typeof pull === "number" ? `${four(written.drawbar_pull_n)} N` : "none",
        element("small", {}, [row.status === "ok" ? " drawbar pull" : ` ${row.status}`]),
      ]),
      element("table", {}, [
        element("caption", {}, [`At a slip ratio of ${session.slip}, ${session.load} N, ${session.angle}°`]),
        element("thead", {}, [element("tr", {}, head)]), element("tbody", {}, rows),
      ]),
      ...(row.flags?.length ? [element("p", { class: "sentence" }, [`Outside of what was measured: ${row.flags.join(", ")}.`])] : []),
    );
    this.charts = CHARTS.map(([key, title, label]) => {
      const known = this.rows.filter((it) => typeof it[key] === "number");
      const banded = this.rows.filter((it) => typeof it[`${key}_p2_5`] === "number" && typeof it[`${key}_p97_5`] === "number");
      return element("figure", {}, [draw({
        title: `${title} ${label.slice(label.indexOf("["))}`, x: "slip ratio", y: label,
        curves: [{ points: known.map((it) => [it.slip_ratio, it[key]]) }],
        band: banded.map((it) => [it.slip_ratio, it[`${key}_p2_5`], it[`${key}_p97_5`]]),
        ...(typeof row[key] === "number" ? { point: [session.slip, row[key]] } : {}),
      })]);
    });
    this.arrange();
    this.export.replaceChildren(exportOf(this.shown, undefined));
  }

  /** The numbers and the cut wheel first, then the charts, then the other drawings. */
  arrange() {
    const [wheel, ...others] = this.drawings;
    this.figures.replaceChildren(this.numbers, ...(wheel ? [wheel] : []), ...this.charts, this.worth, ...others);
  }

  /**
   * The engine's drawings.
   * @param {Line} line
   */
  picture(line) {
    this.drawings = picturesOf(line.drawings ?? []);
    this.arrange();
  }

  /**
   * What a change of each number is worth.
   * @param {Row | undefined} row
   */
  weigh(row) {
    if (!row) return;
    const known = this.keys.map((key) => ({ key, by: row[`d_drawbar_pull_n_d_${key.key}`] }));
    const effect = (/** @type {{key: Key, by: number}} */ { key, by }) => Math.abs(by * (key.value === 0 ? 1 : 0.1 * key.value));
    const strongest = known.filter(({ by }) => typeof by === "number" && by !== 0).sort((one, other) => effect(other) - effect(one)).slice(0, 8);
    const line = (/** @type {{key: Key, by: number}} */ { key, by }) => {
      const small = key.unit === "m";
      const [unit, factor] = small ? ["1 mm", 1e-3] : key.unit ? [key.unit === "°" ? "1°" : `1 ${key.unit}`, 1] : ["0.1", 0.1];
      const sign = by * factor < 0 ? "−" : "+";
      return element("tr", {}, [
        element("th", { scope: "row" }, [`${unit} of ${labelOf(key)}`]),
        element("td", {}, [`${sign}${four(Math.abs(by * factor))} N`]),
      ]);
    };
    this.worth.replaceChildren(
      element("h2", {}, ["What the pull depends on"]),
      element("table", {}, [element("caption", {}, ["Of the soil as written and one model, strongest first"]), element("tbody", {}, strongest.map(line))]),
    );
  }
}

/**
 * A number in words: its meaning without the symbol and the unit.
 * @param {Key} key
 */
export function labelOf(key) {
  const stop = key.key.match(/\.stop\.(.+)$/);
  if (stop) return `Stop: ${stop[1]?.replace(".", " ")}`;
  const meaning = (key.meaning ?? key.key).split(/[,;[]/)[0]?.trim() ?? key.key;
  if (meaning.startsWith("Its ")) return `${key.key.split(".").slice(1).join(" ").replace(/_per_rad_m$/, "").replace(/_/g, " ")}: ${meaning.slice(4)}`;
  return meaning.charAt(0).toLowerCase() + meaning.slice(1);
}
