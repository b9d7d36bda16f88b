// The seventh view: a soil that is fitted to wheel tests.

import { element } from "./dom.js";
import { StudyAnswer } from "./study.js";
import { Trials, conditionsOf } from "./trials.js";
import { about as aboutWheel, labelOf } from "./wheel.js";

/** @typedef {import("./session.js").Session} Session */
/** @typedef {import("./api.js").Key} Key */
/** @typedef {import("./api.js").Line} Line */
/** @typedef {import("./fits.js").Fits} Fits */
/** @typedef {import("./fits.js").Made} Made */

/** The fit of a soil. */
export class FitAnswer extends StudyAnswer {
  /**
   * @param {(error: Error | undefined) => void} ended
   * @param {() => void} started
   * @param {() => void} changed when trials are left out or taken back
   * @param {Fits} fits that were made before
   */
  constructor(ended, started, changed, fits) {
    super({
      start: "Fit the soil",
      hint: "The fit starts when you ask for it: least squares alone take seconds, a posterior takes minutes.",
      none: "no soil is fitted yet",
      failed: "no fit",
    }, (error) => {
      // One that failed is shown in place of every other.
      if (error) fits.mark(undefined);
      ended(error);
    }, started);
    this.trials = new Trials(changed);
    this.fits = fits;
    fits.show = (made) => {
      this.show(made);
      ended(undefined);
    };
    /** The fit that is under way. @type {Omit<Made, "number" | "answer" | "shown"> | undefined} */
    this.begun = undefined;
    /** @type {Line | undefined} its object */
    this.found = undefined;
    fits.mark(undefined);
    this.element.prepend(this.trials.element);
    this.body.before(fits.element);
  }

  /**
   * @override
   * @param {Session} session
   */
  ask(session) {
    this.trials.ask(session);
    super.ask(session);
    // What was fitted before needs no search.
    const made = this.fits.of(JSON.stringify(this.question(session)));
    if (!made) return;
    this.show(made);
    this.ended(undefined);
  }

  /** @override */
  start() {
    if (!this.session) return;
    this.begun = { question: JSON.stringify(this.question(this.session)), session: structuredClone(this.session) };
    super.start();
  }

  /**
   * @override
   * @param {Line} line
   */
  answer(line) {
    this.found = line;
  }

  /**
   * @override
   * @param {Line} line
   */
  take(line) {
    super.take(line);
    if (this.begun && this.found) this.fits.keep({ ...this.begun, answer: this.found, shown: line });
    this.begun = this.found = undefined;
  }

  /** @param {Made} made */
  show(made) {
    super.take(made.shown);
    this.fits.mark(made.number);
  }

  /** @override */
  stop() {
    this.begun = undefined;
    this.trials.stop();
    super.stop();
  }

  /**
   * @override
   * @param {Session} session
   * @returns {[string, object]}
   */
  question(session) {
    const where = [...conditionsOf(session.where), ...(session.without ? [`line!=${session.without}`] : [])];
    return ["fit", { ...aboutWheel(session), data: session.data, fit: list(session.fit), where, point_fit: session.belief === "nominal" }];
  }
}

/**
 * A data set of the list: its parts, each of a wheel, and what a fit lacks in it.
 * @typedef {{name: string, parts: {name: string, wheel: string, soils: string[], where: string[]}[], lacks: string | null}} DataSet
 */

/**
 * Data sets as options of a choice; those that cannot be fitted say why.
 * @param {DataSet[]} all
 */
export function optionsOf(all) {
  return all.map(({ name, lacks }) => element("option", { value: name, disabled: Boolean(lacks), title: lacks ?? "" }, [lacks ? `${name} (${lacks.split(":")[0]})` : name]));
}

/**
 * Takes the wheel, the soil and the rows that a part of a data set names.
 * @param {Session} session
 * @param {DataSet | undefined} set
 * @param {number} place of the part
 */
export function takePart(session, set, place) {
  session.without = "";
  const part = set?.parts[place];
  session.where = part ? part.where.join("; ") : "";
  if (!part) return;
  session.wheel = part.wheel;
  session.soil = part.soils[0] ?? session.soil;
}

/**
 * The choice of a part, where a data set has several.
 * @param {Session} session
 * @param {DataSet | undefined} set
 * @param {(place: number) => void} chosen
 */
export function partsOf(session, set, chosen) {
  if (!set || set.parts.length < 2) return [];
  const select = element("select", { id: "part", onchange: (/** @type {any} */ event) => chosen(Number(event.target.value)) }, set.parts.map((part, place) => element("option", {
    value: place, selected: part.wheel === session.wheel && part.where.join("; ") === session.where,
  }, [part.name])));
  return [element("div", { class: "slider" }, [element("label", {}, ["Part of the data set ", select])])];
}

/** @param {string} text */
function list(text) {
  return text.split(",").filter(Boolean);
}

/**
 * Which keys of the soil are fitted, and to which rows.
 * @param {Session} session
 * @param {Key[]} keys
 * @param {() => void} moved
 */
export function choicesOfFit(session, keys, moved) {
  const chosen = new Set(list(session.fit));
  const boxes = keys.filter((key) => key.key.startsWith("soil.")).map((key) => element("label", { class: "box" }, [
    element("input", { type: "checkbox", value: key.key, checked: chosen.has(key.key), onchange: (/** @type {any} */ event) => {
      if (event.target.checked) chosen.add(key.key);
      else chosen.delete(key.key);
      session.fit = [...chosen].join(",");
      moved();
    } }), ` ${labelOf(key)}`,
  ]));
  const where = element("input", { type: "text", id: "where", value: session.where, placeholder: "slip_angle_deg=0", onchange: (/** @type {any} */ event) => {
    session.where = event.target.value;
    moved();
  } });
  return [
    element("div", { class: "slider" }, [element("label", {}, ["Only rows with ", where])]),
    element("fieldset", { id: "fit" }, [element("legend", {}, ["What is fitted"]), ...boxes]),
  ];
}
