// A dial for a course: to the right is along the contour, up is uphill.

import { element, svg } from "./dom.js";

/** How far keys turn it [°]. */
const STEPS = /** @type {Record<string, number>} */ ({
  ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1, PageUp: 15, PageDown: -15, Home: -180, End: 180,
});

/** A dial from straight down to straight up. */
export class Dial {
  /**
   * @param {string} label
   * @param {number} value [°]
   * @param {(value: number) => void} moved
   */
  constructor(label, value, moved) {
    this.moved = moved;
    this.needle = svg("g", {}, [
      svg("line", { class: "needle", x1: 0, y1: 0, x2: 40, y2: 0 }),
      svg("path", { class: "tip", d: "M48 0L36 -6V6Z" }),
    ]);
    this.words = element("output", {});
    const dial = svg("svg", {
      class: "dial", viewBox: "-44 -58 106 116", role: "slider", tabindex: 0,
      "aria-label": label, "aria-valuemin": -90, "aria-valuemax": 90,
    }, [
      svg("path", { class: "axis", d: "M0 -50A50 50 0 0 1 0 50" }),
      ...[-90, -60, -30, 0, 30, 60, 90].map((at) => svg("line", { class: "tick", x1: 45, x2: 50, transform: `rotate(${-at})` })),
      svg("text", { x: -8, y: -42, "text-anchor": "end" }, ["up"]),
      svg("text", { x: -8, y: 50, "text-anchor": "end" }, ["down"]),
      svg("circle", { class: "hub", r: 4 }), this.needle,
    ]);
    dial.addEventListener("keydown", (event) => {
      const step = STEPS[/** @type {KeyboardEvent} */ (event).key];
      if (step === undefined) return;
      event.preventDefault();
      this.turn(this.value + step);
    });
    /** @param {any} event */
    const point = (event) => {
      const box = dial.getBoundingClientRect();
      const [x, y] = [(event.clientX - box.left) / box.width * 106 - 44, (event.clientY - box.top) / box.height * 116 - 58];
      this.turn(Math.round(Math.atan2(-y, Math.max(x, 0)) / Math.PI * 180));
    };
    dial.addEventListener("pointerdown", (/** @type {any} */ event) => {
      dial.setPointerCapture(event.pointerId);
      point(event);
    });
    dial.addEventListener("pointermove", (/** @type {any} */ event) => {
      if (dial.hasPointerCapture(event.pointerId)) point(event);
    });
    this.dial = dial;
    this.value = value;
    this.element = element("div", { class: "slider" }, [
      element("p", { class: "label" }, [label]), element("div", { class: "dial-row" }, [dial, this.words]),
    ]);
    this.show();
  }

  /** @param {number} value */
  turn(value) {
    const turned = Math.min(90, Math.max(-90, value));
    if (turned === this.value) return;
    this.value = turned;
    this.show();
    this.moved(turned);
  }

  show() {
    const words = this.value === 0 ? "0°, along the contour" : `${Math.abs(this.value)}° ${this.value > 0 ? "uphill" : "downhill"}`;
    this.needle.setAttribute("transform", `rotate(${-this.value})`);
    this.dial.setAttribute("aria-valuenow", String(this.value));
    this.dial.setAttribute("aria-valuetext", words);
    this.words.textContent = words;
  }
}
