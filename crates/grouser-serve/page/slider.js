// A number to move: a slider for the hand, a field for the digits, and the engine's error beside it.

import { element } from "./dom.js";

let count = 0;

/**
 * @typedef {object} Setting
 * @property {string} key of the question, by which errors find their slider
 * @property {string} label
 * @property {string} unit
 * @property {number} value
 * @property {number} low end of the slider
 * @property {number} high
 * @property {string} [remark]
 * @property {number} [usual] what the document says
 */

/** A slider. */
export class Slider {
  /**
   * @param {Setting} setting
   * @param {(value: number) => void} moved
   */
  constructor(setting, moved) {
    const { key, label, unit, value, low, high, remark, usual } = setting;
    const id = `slider-${(count += 1)}`;
    this.key = key;
    const step = 10 ** Math.floor(Math.log10((high - low) / 99));
    const shared = { value, "aria-describedby": `${id}-error` };
    const range = /** @type {HTMLInputElement} */ (element("input", {
      type: "range", min: low, max: high, step, ...shared, "aria-label": `${label}${unit ? `, in ${unit}` : ""}`,
    }));
    const field = /** @type {HTMLInputElement} */ (element("input", {
      type: "number", step: "any", id, ...shared,
    }));
    this.error = element("p", { class: "error", id: `${id}-error`, role: "alert" });
    this.field = field;
    // A step that does not meet the number would move it.
    range.value = String(value);
    field.value = String(Number(value.toPrecision(6)));
    let last = value;
    /** @type {string | undefined} what stood there before a field was empty */
    let before;
    /** @param {number} number */
    const move = (number) => {
      if (!Number.isFinite(number)) return;
      last = number;
      moved(number);
    };
    range.addEventListener("input", () => {
      field.value = range.value;
      move(Number(range.value));
    });
    field.addEventListener("input", () => {
      // A field with a text that is no number has an empty value.
      if (field.value === "") {
        before ??= this.error.textContent ?? "";
        this.complain(`it must be a number; the last one was ${last}`);
        return;
      }
      before = undefined;
      range.value = field.value;
      move(Number(field.value));
    });
    field.addEventListener("change", () => {
      if (field.value !== "") return;
      field.value = String(last);
      this.complain(before ?? "");
      before = undefined;
    });
    const back = usual === undefined ? null : element("button", {
      type: "button", class: "back", title: `Back to ${usual}, as the document has it`,
      "aria-label": `${label}: back to ${usual}`, hidden: value === usual,
      onclick: () => {
        field.value = range.value = String(usual);
        move(usual);
        field.focus();
      },
    }, ["↺ ", String(Number(usual.toPrecision(4)))]);
    this.back = back;
    this.usual = usual;
    this.element = element("div", { class: "slider" }, [
      element("label", { for: id }, [label.charAt(0).toUpperCase() + label.slice(1), remark ? element("span", { class: "mark" }, [` ${remark}`]) : null]),
      element("div", { class: "row" }, [range, field, element("span", { class: "unit" }, [unit, " ", back])]),
      this.error,
    ]);
  }

  /** @param {number} value the one that is set */
  mark(value) {
    if (this.back) this.back.hidden = value === this.usual;
  }

  /** @param {string} message nothing where all is well */
  complain(message) {
    if (this.error.textContent !== message) this.error.textContent = message;
    if (message) this.field.setAttribute("aria-invalid", "true");
    else this.field.removeAttribute("aria-invalid");
  }
}

/**
 * Where a slider of a document's number begins and ends: around the number, within what it may be.
 * @param {import("./api.js").Key} key
 */
export function endsOf({ value, minimum: least, maximum: most, unit }) {
  const [minimum, maximum] = [least ?? Math.min(0, 4 * value), most ?? Math.max(1, 4 * value)];
  if (unit === "°" && maximum - minimum <= 120) return { low: minimum, high: maximum };
  if (maximum - minimum <= 5) return { low: minimum, high: maximum };
  if (value > 0) return { low: Math.max(minimum, value / 4), high: Math.min(maximum, value * 4) };
  const reach = unit === "kPa" ? 5 : unit === "m" ? 0.1 : value < 0 ? 4 * -value : 1;
  return { low: Math.max(minimum, value < 0 ? -reach : minimum < 0 ? -reach : 0), high: Math.min(maximum, reach) };
}
