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
 * Adds a leg; one that goes on with the last is made one with it.
 * @param {Leg[]} legs
 * @param {Leg} leg of one number
 */
export function addLeg(legs, leg) {
  const [[key, value] = ["", 0]] = Object.entries(leg);
  const last = legs[legs.length - 1];
  if (!last || !(key in last)) legs.push(leg);
  else if (Math.abs(last[key] + value) < 1e-9 && legs.length > 1) legs.pop();
  else last[key] = Number((last[key] + value).toFixed(6)) || value;
}

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
      type: "number", step: "any", required: true, value, "aria-label": `${name} ${key}`, onchange: (/** @type {any} */ event) => {
        if (!event.target.reportValidity()) return;
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
    element("p", { class: "setup" }, ["On the track the arrow keys drive: up and down by 0.2 m, left and right turn by 15°."]),
    element("div", { class: "choice" }, ["Add ", ...NEW.map(([text, leg]) => button(text, `Add: ${text.toLowerCase()}`, () => legs.push(structuredClone(leg)), false))]),
  ]);
}
