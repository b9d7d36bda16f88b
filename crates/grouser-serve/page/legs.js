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

/**
 * A number at which a mission may stop.
 * @typedef {object} Limit
 * @property {string} key
 * @property {string} label
 * @property {string} meaning
 * @property {number | null} minimum
 * @property {number | null} maximum
 * @property {string} unit
 */

/**
 * The button that takes away a limit.
 * @param {string} label
 * @param {() => void} act
 */
export function removeLimit(label, act) {
  return element("button", { type: "button", "aria-label": `Remove the limit: ${label}`, title: "Remove", onclick: act }, ["✕"]);
}

/**
 * The choice of a limit that is not there, with its number.
 * @param {Limit[]} limits
 * @param {(key: string, value: number) => void} add
 */
export function addLimit(limits, add) {
  const find = () => limits.find((it) => it.key === kind.value);
  const kind = /** @type {HTMLSelectElement} */ (element("select", { id: "limit-kind", onchange: () => shown() }, limits.map(({ key, label, meaning }) => element("option", { value: key, title: meaning }, [label]))));
  const number = /** @type {HTMLInputElement} */ (element("input", { type: "number", id: "limit-above", step: "any", required: true }));
  const about = element("p", { class: "setup" });
  const shown = () => {
    const limit = find();
    number.setAttribute("min", String(limit?.minimum ?? 0));
    if (limit?.maximum != null) number.setAttribute("max", String(limit.maximum));
    about.textContent = limit?.meaning ?? "";
  };
  shown();
  const button = element("button", { type: "button", id: "add-limit", onclick: () => {
    const limit = find();
    if (limit && number.reportValidity()) add(limit.key, number.valueAsNumber);
  } }, ["Add the limit"]);
  return element("div", { class: "add-limit" }, [
    element("label", {}, ["Stop where the ", kind]), " ", element("label", {}, [" is above ", number]), " ", button, about,
  ]);
}
