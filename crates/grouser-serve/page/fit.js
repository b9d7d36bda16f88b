// The seventh view: a soil that is fitted to wheel tests.

import { element, picturesOf, tableOf } from "./dom.js";
import { exportOf } from "./heading.js";
import { Study } from "./study.js";
import { about as aboutWheel, labelOf } from "./wheel.js";

/** @typedef {import("./session.js").Session} Session */
/** @typedef {import("./api.js").Line} Line */
/** @typedef {import("./api.js").Key} Key */

/** The fit of a soil. */
export class FitAnswer {
  /**
   * @param {(error: Error | undefined) => void} ended
   * @param {() => void} started
   */
  constructor(ended, started) {
    this.ended = ended;
    /** @type {string | undefined} the picture for a slide */
    this.slide = undefined;
    this.words = "no soil is fitted yet";
    this.study = new Study("Fit the soil", () => {
      started();
      this.start();
    }, () => this.ended(undefined));
    this.asking = this.study.asking;
    this.body = element("div", {}, [element("p", { class: "sentence" }, ["The fit starts when you ask for it: least squares alone take seconds, a posterior takes minutes."])]);
    this.element = element("div", {}, [this.study.element, this.body]);
  }

  /** @param {Session} session */
  ask(session) {
    if (this.session) this.body.classList.add("old");
    this.session = session;
    this.ended(undefined);
  }

  start() {
    const { session } = this;
    if (!session) return;
    const [point, fit, where] = [session.belief === "nominal", list(session.fit), session.where.split(";").map((it) => it.trim()).filter(Boolean)];
    this.study.run("fit", { ...aboutWheel(session), data: session.data, fit, where, point_fit: point }, (line) => {
      if (line.schema === "grouser.shown.v1") this.take(line);
    }, (error) => {
      if (error) this.body.replaceChildren(element("p", { class: "error" }, [error.message]));
      this.ended(error);
    });
  }

  /** @param {Line} line */
  take(line) {
    this.slide = line.slide;
    const [first = "", ...others] = line.sentences ?? [];
    this.words = first;
    this.body.classList.remove("old");
    this.body.replaceChildren(
      element("div", { class: "card" }, [
        element("p", { class: "found", id: "found" }, [first]), element("ul", {}, others.map((it) => element("li", {}, [it]))),
      ]),
      ...(line.tables ?? []).map(({ caption, columns, rows }) => tableOf(caption, columns, rows)),
      element("div", { class: "figures" }, picturesOf(line.figures ?? [])),
      exportOf(line, undefined),
    );
  }

  stop() {
    this.study.stop();
  }

  said() {
    return this.words;
  }
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
