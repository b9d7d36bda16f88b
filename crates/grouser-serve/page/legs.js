// The legs of a mission: a row for each, its numbers in fields.

import { element } from "./dom.js";

/** @typedef {Record<string, any>} Leg */

/**
 * What a leg may be, as documents have it.
 * @type {[string, Leg][]}
 */
const NEW = [
  ["Drive", { drive_m: 1 }], ["Turn", { turn_deg: 45 }], ["Go to", { goto: { x_m: 1, y_m: 0 } }],
];

/**
 * Fields of the numbers of a leg, those of its parts too.
 * @param {Leg} leg
 * @param {string} name
 * @param {() => void} changed
 * @returns {Node[]}
 */
function fields(leg, name, changed) {
  return Object.entries(leg).flatMap(([key, value]) => {
    if (value !== null && typeof value === "object") return fields(value, `${name} ${key}`, changed);
    if (typeof value !== "number") return [element("span", {}, [`${key} ${value}`])];
    return [element("label", {}, [`${key} `, element("input", {
      type: "number", step: "any", value, "aria-label": `${name} ${key}`, onchange: (/** @type {any} */ event) => {
        if (!Number.isFinite(event.target.valueAsNumber)) return;
        leg[key] = event.target.valueAsNumber;
        changed();
      },
    })])];
  });
}

/**
 * A table of legs that are changed in place.
 * @param {Leg[]} legs
 * @param {() => void} changed numbers
 * @param {() => void} reordered so that the table is made anew
 */
export function legsTable(legs, changed, reordered) {
  const button = (/** @type {string} */ text, /** @type {string} */ label, /** @type {() => void} */ act, /** @type {boolean} */ off) =>
    element("button", { type: "button", "aria-label": label, title: label, disabled: off, onclick: () => {
      act();
      reordered();
    } }, [text]);
  const rows = legs.map((leg, at) => element("li", { "data-leg": at + 1 }, [
    ...fields(leg, `Leg ${at + 1}`, changed),
    button("↑", `Leg ${at + 1} earlier`, () => legs.splice(at - 1, 2, leg, /** @type {Leg} */ (legs[at - 1])), at === 0),
    button("✕", `Remove leg ${at + 1}`, () => legs.splice(at, 1), legs.length === 1),
  ]));
  return element("fieldset", { id: "legs" }, [
    element("legend", {}, ["Legs"]), element("ol", {}, rows),
    element("div", { class: "choice" }, ["Add ", ...NEW.map(([text, leg]) => button(text, `Add: ${text.toLowerCase()}`, () => legs.push(structuredClone(leg)), false))]),
  ]);
}
