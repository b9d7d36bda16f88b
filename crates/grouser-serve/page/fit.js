// The seventh view: a soil that is fitted to wheel tests.

import { element } from "./dom.js";
import { StudyAnswer } from "./study.js";
import { about as aboutWheel, labelOf } from "./wheel.js";

/** @typedef {import("./session.js").Session} Session */
/** @typedef {import("./api.js").Key} Key */

/** The fit of a soil. */
export class FitAnswer extends StudyAnswer {
  /**
   * @param {(error: Error | undefined) => void} ended
   * @param {() => void} started
   */
  constructor(ended, started) {
    super({
      start: "Fit the soil",
      hint: "The fit starts when you ask for it: least squares alone take seconds, a posterior takes minutes.",
      none: "no soil is fitted yet",
      failed: "no fit",
    }, ended, started);
  }

  /**
   * @override
   * @param {Session} session
   * @returns {[string, object]}
   */
  question(session) {
    const where = session.where.split(";").map((it) => it.trim()).filter(Boolean);
    return ["fit", { ...aboutWheel(session), data: session.data, fit: list(session.fit), where, point_fit: session.belief === "nominal" }];
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
