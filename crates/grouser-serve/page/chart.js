// Charts: curves, a band and the point where one is, in their own units.

import { svg as made } from "./dom.js";

/**
 * @param {string} name
 * @param {Record<string, string | number>} attributes
 * @param {string} [text]
 */
function svg(name, attributes, text) {
  return made(name, attributes, text === undefined ? [] : [text]);
}

/**
 * @typedef {object} Curve
 * @property {[number, number][]} points
 * @property {string} [name]
 */

/**
 * @typedef {object} Chart
 * @property {string} title
 * @property {string} x quantity and unit
 * @property {string} y
 * @property {Curve[]} curves
 * @property {[number, number, number][]} [band] place, low and high end, which may be infinite
 * @property {[number, number]} [point]
 * @property {boolean} [isNamed] whether each curve has a pattern of its own
 */

/**
 * Round numbers between two others, with as many digits as they need.
 * @param {number} low
 * @param {number} high
 * @param {number} most
 */
function round(low, high, most) {
  const rough = (high - low) / most;
  const ten = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((it) => it * ten).find((it) => it >= rough) ?? rough;
  const digits = Math.max(0, -Math.floor(Math.log10(step)));
  const places = [];
  for (let place = Math.ceil(low / step - 1e-9); place * step <= high + 1e-9 * step; place += 1) {
    places.push(place * step);
  }
  return places.map((at) => ({ at, text: at.toFixed(digits).replace("-", "−") }));
}

/** How many patterns of lines there are. */
export const PATTERNS = 6;

/** What the mouse moves less while it is down is a click [pixels]. */
const DRAWN = 6;

/** Width and height of a chart, and where its curves are. */
export const SIZE = /** @type {const} */ ([420, 250]);
const BOX = { left: 52, right: SIZE[0] - 18, top: 26, bottom: SIZE[1] - 38 };

/**
 * The axes around some points, with what places a number on the chart.
 * @param {{title: string, x: string, points: [number, number][]}} chart
 */
export function scaleOf({ title, x: across, points }) {
  const box = BOX;
  const frame = [svg("text", { class: "title", x: box.left, y: 15 }, title)];
  const spread = (/** @type {number[]} */ numbers) => {
    let [low, high] = [Math.min(...numbers), Math.max(...numbers)];
    if (high - low < 1e-9) [low, high] = [low - 0.5, high + 0.5];
    const margin = 0.05 * (high - low);
    return [low - margin, high + margin];
  };
  const xs = points.map(([x]) => x);
  const [left, right] = [Math.min(...xs), Math.max(Math.max(...xs), Math.min(...xs) + 1e-9)];
  const [low = 0, high = 1] = spread(points.map(([, y]) => y));
  const x = (/** @type {number} */ at) => box.left + ((at - left) / (right - left)) * (box.right - box.left);
  const y = (/** @type {number} */ at) => box.bottom - ((at - low) / (high - low)) * (box.bottom - box.top);
  for (const { at, text } of round(low, high, 5)) {
    frame.push(svg("line", { class: "grid", x1: box.left, x2: box.right, y1: y(at), y2: y(at) }));
    frame.push(svg("text", { x: box.left - 6, y: y(at) + 4, "text-anchor": "end" }, text));
  }
  for (const { at, text } of round(left, right, 7)) {
    frame.push(svg("line", { class: "tick", x1: x(at), x2: x(at), y1: box.bottom, y2: box.bottom + 4 }));
    frame.push(svg("text", { x: x(at), y: box.bottom + 17, "text-anchor": "middle" }, text));
  }
  frame.push(svg("path", { class: "axis", d: `M${box.left} ${box.top}V${box.bottom}H${box.right}` }));
  frame.push(svg("text", { x: (box.left + box.right) / 2, y: SIZE[1] - 5, "text-anchor": "middle" }, across));
  return { frame, x, y, ends: /** @type {[number, number]} */ ([left, right]), box };
}

/**
 * Draws a chart.
 * @param {Chart} chart
 */
export function draw(chart) {
  return drawOver(chart).drawn;
}

/**
 * The same, and what sets its cursor to a place.
 * @param {Chart} chart
 * @param {(at: number) => void} [picked] takes the place of a click; a slider does the same by the keyboard
 * @param {(from: number, to: number) => void} [ranged] takes what the mouse is drawn over; fields do the same
 */
export function drawOver(chart, picked, ranged) {
  const [width, height] = SIZE;
  const { curves, band = [], point } = chart;
  const all = [
    ...curves.flatMap((curve) => curve.points),
    ...band.flatMap(([x, low, high]) => /** @type {[number, number][]} */ ([[x, low], [x, high]])).filter(([, at]) => Number.isFinite(at)),
    ...(point ? [point] : []),
  ];
  const said = point ? `; at ${num(point[0])} it is ${num(point[1])}` : "";
  const drawn = svg("svg", {
    class: "chart", viewBox: `0 0 ${width} ${height}`, role: "img",
    "aria-label": `${chart.title}: ${chart.y} over ${chart.x}${said}`,
  });
  if (all.length === 0) {
    drawn.append(svg("text", { class: "title", x: BOX.left, y: 15 }, chart.title));
    drawn.append(svg("text", { x: BOX.left, y: height / 2 }, "There is nothing to draw."));
    return { drawn, cursor: () => {}, mark: () => {} };
  }
  const { frame, x, y, ends: [left, right], box } = scaleOf({ title: chart.title, x: chart.x, points: all });
  drawn.append(...frame);
  if (band.length > 1) {
    const there = band.map(([at, lower]) => `${x(at)},${y(lower)}`);
    const back = [...band].reverse().map(([at, , upper]) => `${x(at)},${Number.isFinite(upper) ? y(upper) : box.top}`);
    drawn.append(svg("polygon", { class: "band", points: [...there, ...back].join(" ") }));
  }
  for (const [place, { points }] of curves.entries()) {
    const path = points.map(([atX, atY]) => `${x(atX)},${y(atY)}`).join(" ");
    const name = chart.isNamed ? `curve of-${place % PATTERNS}` : place ? "curve second" : "curve";
    drawn.append(svg("polyline", { class: name, points: path }));
  }
  if (point) drawn.append(svg("circle", { class: "point", cx: x(point[0]), cy: y(point[1]), r: 5.5 }));
  const range = svg("rect", { class: "range", y: box.top, height: box.bottom - box.top, width: 0 });
  drawn.append(range);
  const mark = (/** @type {number} */ from, /** @type {number} */ to) => {
    const [start, end] = [from, to].map((it) => x(Math.min(right, Math.max(left, it))));
    range.setAttribute("x", String(start));
    range.setAttribute("width", String(Math.max(0, (end ?? 0) - (start ?? 0))));
  };
  if (picked) {
    drawn.classList.add("picked");
    /** Where the mouse went down. */
    let down = 0;
    const at = (/** @type {number} */ place) => {
      const frame = drawn.getBoundingClientRect();
      const share = ((place - frame.left) / frame.width * width - box.left) / (box.right - box.left);
      return left + Math.min(1, Math.max(0, share)) * (right - left);
    };
    drawn.addEventListener("pointerdown", (event) => {
      down = /** @type {PointerEvent} */ (event).clientX;
    });
    drawn.addEventListener("click", (event) => {
      const { clientX: up } = /** @type {MouseEvent} */ (event);
      if (ranged && Math.abs(up - down) > DRAWN) ranged(at(Math.min(down, up)), at(Math.max(down, up)));
      else picked(at(up));
    });
  }
  const line = svg("line", { class: "cursor", y1: box.top, y2: box.bottom, visibility: "hidden" });
  drawn.append(line);
  const cursor = (/** @type {number} */ at) => {
    if (at > right) return;
    for (const end of ["x1", "x2"]) line.setAttribute(end, String(x(at)));
    line.setAttribute("visibility", "visible");
  };
  return { drawn, cursor, mark };
}

/** @param {number} value */
function num(value) {
  return String(Number(value.toPrecision(4)));
}
