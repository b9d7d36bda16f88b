// The third view: a run over a slope or a map of heights, its track from above or the rover in three
// dimensions, and every wheel on one time line.

import { Asking } from "./api.js";
import { PATTERNS, drawOver } from "./chart.js";
import { element, four, svg, tableOf } from "./dom.js";
import { about as aboutRover, exportOf } from "./heading.js";
import { DriveScene, hasDepth } from "./scene.js";
import { setOf } from "./session.js";

/** @typedef {import("./session.js").Session} Session */
/** @typedef {import("./api.js").Line} Line */
/** @typedef {import("./api.js").Row} Row */

/** The charts of wheels: column, title with its unit. */
const OF_WHEELS = /** @type {[string, string][]} */ ([
  ["slip_ratio", "Slip ratio"], ["sinkage_mm", "Sinkage [mm]"], ["slip_angle_deg", "Slip angle [°]"],
  ["load_n", "Load [N]"], ["drawbar_pull_n", "Drawbar pull [N]"], ["torque_nm", "Torque [N·m]"],
]);

/** What the rover is doing: column, label. */
const OF_ROVER = /** @type {[string, string][]} */ ([
  ["time_s", "time [s]"], ["x_m", "x [m]"], ["y_m", "y [m]"], ["z_m", "z [m]"], ["yaw_deg", "yaw [°]"],
  ["forward_speed_m_s", "forward speed [m/s]"], ["lateral_speed_m_s", "lateral speed [m/s]"],
  ["roll_deg", "roll [°]"], ["pitch_deg", "pitch [°]"], ["power_w", "power [W]"], ["energy_j", "work of the wheels [J]"],
]);

/** The mission to begin with, which has the rover and the ground of the session. */
export const BLANK = "blank";

/**
 * What is asked of a mission, whatever the question.
 * @param {Session} session
 */
export function aboutMission({ mission, legs, set, rover, soil }) {
  const parts = mission === BLANK ? { "mission.rover": rover, "mission.soil": soil } : {};
  return { mission, set: { ...parts, ...setOf({ set }, ["mission"]), ...(legs ? { "mission.leg": JSON.parse(legs) } : {}) } };
}

/** What the arrow keys add to a mission on its track: a fifth of a metre, or 15° on the spot. */
const STEPS = /** @type {Record<string, Record<string, number>>} */ ({
  ArrowUp: { drive_m: 0.2 }, ArrowDown: { drive_m: -0.2 }, ArrowLeft: { turn_deg: 15 }, ArrowRight: { turn_deg: -15 },
});

/** How long a play of the whole run takes [s]. */
const PLAY = 10;

/** The answer about a run. */
export class DriveAnswer {
  /**
   * @param {(error: Error | undefined) => void} ended
   * @param {(seen: string, isToAsk: boolean) => void} looked takes the way in which the drive is shown
   */
  constructor(ended, looked) {
    this.ended = ended;
    this.asking = new Asking();
    /** @type {any} */
    this.run = undefined;
    /** The record that is shown. */
    this.place = 0;
    /** @type {((time: number) => void)[]} */
    this.cursors = [];
    /** @type {((record: Row) => void) | undefined} */
    this.pose = undefined;
    this.time = element("input", { type: "range", id: "time", min: 0, max: 0, step: 1, value: 0, "aria-label": "Time, in records", oninput: () => this.show(Number(/** @type {any} */ (this.time).value)) });
    this.button = element("button", { type: "button", id: "play", onclick: () => this.play() }, ["Play"]);
    this.clock = element("output", { id: "clock" });
    this.outcome = element("div", { class: "card" });
    this.now = element("div", { class: "card", id: "now" });
    this.plan = element("figure");
    this.plan.addEventListener("keydown", (event) => {
      const leg = STEPS[/** @type {KeyboardEvent} */ (event).key];
      if (!leg || !this.steered) return;
      event.preventDefault();
      this.steered({ ...leg });
    });
    const choice = (/** @type {string} */ seen, /** @type {string} */ text) => element("button", {
      type: "button", id: `seen-${seen}`, "aria-pressed": "false", onclick: () => {
        const isScene = this.look(seen);
        looked(isScene ? "scene" : "plan", isScene);
      },
    }, [text]);
    this.choices = { plan: choice("plan", "From above"), scene: choice("scene", "In three dimensions") };
    this.lacking = element("p", { class: "error", role: "alert" });
    this.scene = new DriveScene((problem) => {
      this.look("plan");
      this.lacking.textContent = problem;
    });
    this.figures = element("div", { class: "figures" });
    this.legs = element("div");
    /** @type {any[]} legs whose places are shown and may be dragged */
    this.goals = [];
    /** @type {() => void} */
    this.dragged = () => {};
    /** @type {((leg: Record<string, number>) => void) | undefined} takes what the keys of the track add */
    this.steered = undefined;
    this.names = element("p", { class: "legend", "aria-label": "Wheels" });
    this.out = element("div");
    this.element = element("div", {}, [
      element("div", { class: "timeline", role: "group", "aria-label": "Time line" }, [this.button, this.time, this.clock]),
      element("div", { class: "figures" }, [element("div", { class: "beside" }, [this.outcome, this.now]), element("div", {}, [
        element("div", { class: "choice", role: "group", "aria-label": "How the drive is shown" }, [this.choices.plan, this.choices.scene]),
        this.lacking, this.plan, this.scene.element,
      ])]),
      this.legs, this.names, this.figures, this.out,
    ]);
    this.timer = 0;
    this.isScene = false;
  }

  /**
   * Shows the drive from above, or in three dimensions where the browser can.
   * @param {string} seen
   */
  look(seen) {
    const lacks = seen === "scene" && !hasDepth();
    this.lacking.textContent = lacks ? "This browser shows nothing in three dimensions (WebGL 2 is missing or switched off): the drive is shown from above." : "";
    this.isScene = seen === "scene" && !lacks;
    this.plan.hidden = this.isScene;
    this.scene.element.hidden = !this.isScene;
    this.choices.plan.setAttribute("aria-pressed", String(!this.isScene));
    this.choices.scene.setAttribute("aria-pressed", String(this.isScene));
    if (this.isScene) this.scene.wait();
    else this.scene.close();
    return this.isScene;
  }

  /**
   * Takes the line that follows an answer.
   * @param {Line} line
   */
  takeShown(line) {
    this.out.replaceChildren(exportOf(line, undefined));
    if (this.isScene && line.scene) this.scene.take(line.scene);
  }

  /** @param {Session} session */
  ask(session) {
    this.pause();
    this.look(session.seen);
    this.outcome.classList.add("stale");
    if (session.mission) {
      this.askMission(session);
      return;
    }
    const isPlane = session.ground === "";
    const about = aboutRover(session);
    const question = {
      ...about, ...(isPlane ? { slope_deg: session.slope } : {}), yaw_deg: session.yaw, duration_s: session.duration,
      rim_speed_m_s: session.speed, shown: true, ...(this.isScene ? { scene: true } : {}),
      set: { ...about.set, ...(isPlane ? {} : { "scenario.terrain.file": session.ground }) },
    };
    this.asking.ask("traverse", question, (line) => {
      if (line.schema === "grouser.traverse.v1") this.take(line, isPlane);
      else this.takeShown(line);
    }, (error) => this.answered(error));
  }

  /**
   * The track takes the arrow keys from now on.
   * @param {(leg: Record<string, number>) => void} steered
   */
  steer(steered) {
    this.steered = steered;
    for (const [name, value] of Object.entries({ tabindex: "0", role: "application", id: "track", "aria-label": "Track, driven by the arrow keys" })) {
      this.plan.setAttribute(name, value);
    }
  }

  /** @param {Session} session */
  askMission(session) {
    /** @type {any} */
    let mission;
    this.asking.ask("mission", { ...aboutMission(session), shown: true, figures: true, ...(this.isScene ? { scene: true } : {}) }, (line) => {
      if (line.schema !== "grouser.shown.v1") {
        mission = line;
        return;
      }
      const first = mission.alternatives?.[0] ?? mission;
      this.take({ ...line.run, outcome: first.outcome, reason: line.verdict }, line.run.samples[0].z_m === undefined);
      this.legs.replaceChildren(...(line.tables ?? []).map(tableOf));
      this.takeShown(line);
    }, (error) => this.answered(error));
  }

  /** @param {Error | undefined} error */
  answered(error) {
    this.outcome.classList.remove("stale");
    if (error) {
      this.run = undefined;
      this.outcome.replaceChildren(element("p", { class: "number" }, ["–"]), element("p", { class: "error" }, [error.message]));
      this.scene.clear();
      for (const old of [this.now, this.plan, this.legs, this.figures, this.names, this.out]) old.replaceChildren();
    }
    this.ended(error);
  }

  stop() {
    this.pause();
    this.asking.stop();
    this.scene.close();
  }

  /**
   * @param {any} run
   * @param {boolean} isPlane
   */
  take(run, isPlane) {
    const { samples } = run;
    // A run that moved a little is looked at where the last one was.
    const before = this.run ? this.place / Math.max(1, this.run.samples.length - 1) : 1;
    this.run = run;
    const last = samples.length - 1;
    this.time.setAttribute("max", String(last));
    this.outcome.replaceChildren(...this.became(run));
    this.drawCharts(run);
    this.drawPlan(samples, isPlane);
    this.show(Math.round(before * last));
  }

  /**
   * What became of the rover.
   * @param {any} run
   * @returns {Node[]}
   */
  became(run) {
    const isCompleted = run.outcome === "completed";
    return [
      element("p", { class: `verdict ${isCompleted ? "go" : "no_go"}`, id: "outcome" }, [
        element("span", { "aria-hidden": "true" }, [isCompleted ? "✓" : "✕"]), run.outcome.replace(/_/g, " "),
      ]),
      element("p", { class: "sentence" }, [run.reason ?? `after ${four(run.final.time_s)} s, on the soil as written, simulated as ${run.simulation.replace(/-/g, " ")}`]),
      element("table", {}, [
        element("caption", {}, ["At the end"]),
        element("tbody", {}, OF_ROVER.filter(([column]) => typeof run.final[column] === "number").map(([column, label]) => element("tr", {}, [
          element("th", { scope: "row" }, [label]), element("td", { "data-column": `final-${column}` }, [four(run.final[column])]),
        ]))),
      ]),
      ...(run.flags.length ? [element("p", { class: "sentence" }, [`Outside of what was measured: ${run.flags.join(", ").replace(/_/g, " ")}.`])] : []),
    ];
  }

  /**
   * Every wheel over the time; a click leads there.
   * @param {any} run
   */
  drawCharts(run) {
    const { samples } = run;
    /** @type {string[]} */
    const wheels = run.final.wheels.map((/** @type {Row} */ wheel) => wheel["wheel"]);
    this.names.replaceChildren("Wheels: ", ...wheels.map((name, place) => element("span", {}, [
      svg("svg", { viewBox: "0 0 30 8", class: "chart", "aria-hidden": "true" }, [svg("line", { class: `curve of-${place % PATTERNS}`, x1: 0, x2: 30, y1: 4, y2: 4 })]), ` ${name}`,
    ])));
    this.cursors = [];
    this.figures.replaceChildren(...OF_WHEELS.map(([column, title]) => {
      const curves = wheels.map((name, place) => ({
        name, points: /** @type {[number, number][]} */ (samples.map((/** @type {any} */ it) => [it.time_s, it.wheels[place]?.[column]]).filter((/** @type {any} */ it) => typeof it[1] === "number")),
      }));
      const { drawn, cursor } = drawOver({ title, x: "time [s]", y: title, curves, isNamed: true }, (time) => this.goTo(time));
      this.cursors.push(cursor);
      return element("figure", {}, [drawn]);
    }));
  }

  /**
   * Shows the record that is the nearest to a time.
   * @param {number} time [s]
   */
  goTo(time) {
    this.pause();
    const apart = (this.run?.samples ?? []).map((/** @type {Row} */ it) => Math.abs(it["time_s"] - time));
    if (apart.length) this.show(apart.indexOf(Math.min(...apart)));
  }

  /**
   * The track from above, with the nose's direction now and then, in one scale for both ways.
   * @param {any[]} samples
   * @param {boolean} isPlane
   */
  drawPlan(samples, isPlane) {
    const [width, height, edge] = [420, 400, 44];
    const ends = (/** @type {string} */ of) => [Math.min(...samples.map((it) => it[of])), Math.max(...samples.map((it) => it[of]))];
    let [[west = 0, east = 0], [south = 0, north = 0]] = [ends("x_m"), ends("y_m")];
    for (const { x_m: atX, y_m: atY } of this.goals) {
      [west, east] = [Math.min(west, samples[0].x_m + atX), Math.max(east, samples[0].x_m + atX)];
      [south, north] = [Math.min(south, samples[0].y_m + atY), Math.max(north, samples[0].y_m + atY)];
    }
    const scale = Math.min((width - 2 * edge) / Math.max(east - west, 0.1), (height - 2 * edge) / Math.max(north - south, 0.1));
    const x = (/** @type {number} */ at) => width / 2 + (at - (west + east) / 2) * scale;
    const y = (/** @type {number} */ at) => height / 2 - (at - (south + north) / 2) * scale;
    const nose = (/** @type {any} */ it, /** @type {string} */ name) => svg("path", {
      class: name, d: "M12 0L-6 -6L-3 0L-6 6Z", transform: `translate(${x(it.x_m)} ${y(it.y_m)}) rotate(${-it.yaw_deg})`,
    });
    const some = samples.filter((_, place) => place % Math.max(1, Math.ceil(samples.length / 9)) === 0);
    const rover = nose(samples[0], "nose now");
    const first = samples[0], last = samples[samples.length - 1];
    const up = isPlane ? "y, uphill" : "y, north";
    this.plan.replaceChildren(svg("svg", {
      class: "chart", viewBox: `0 0 ${width} ${height}`, role: "img",
      "aria-label": `The track from above: from x ${four(first.x_m)} m, y ${four(first.y_m)} m to x ${four(last.x_m)} m, y ${four(last.y_m)} m`,
    }, [
      svg("text", { class: "title", x: 10, y: 16 }, ["Track from above, with where the nose points"]),
      svg("polyline", { class: "curve", points: samples.map((it) => `${x(it.x_m)},${y(it.y_m)}`).join(" ") }),
      ...some.map((it) => nose(it, "nose")), rover,
      svg("path", { class: "axis", d: `M20 ${height - 50}V${height - 16}H54` }),
      svg("text", { x: 16, y: height - 56 }, [up]),
      svg("text", { x: 58, y: height - 12 }, [isPlane ? "x, along the contour" : "x, east"]),
      ...this.bar(scale, width, height),
      ...this.goals.map((goal) => this.handle(goal, first, [x, y], scale, [width, height])),
    ]));
    this.pose = (it) => rover.setAttribute("transform", `translate(${x(it["x_m"])} ${y(it["y_m"])}) rotate(${-it["yaw_deg"]})`);
  }

  /**
   * A place that a leg leads to, which may be dragged; its fields are among the legs.
   * @param {{x_m: number, y_m: number}} goal seen from the start
   * @param {any} first
   * @param {((at: number) => number)[]} places on the drawing
   * @param {number} scale
   * @param {number[]} size
   */
  handle(goal, first, [x, y], scale, [width = 1, height = 1]) {
    const made = svg("circle", { class: "goal", r: 8, cx: x?.(first.x_m + goal.x_m) ?? 0, cy: y?.(first.y_m + goal.y_m) ?? 0 });
    let last = [0, 0];
    made.addEventListener("pointerdown", (/** @type {any} */ event) => {
      made.setPointerCapture(event.pointerId);
      last = [event.clientX, event.clientY];
    });
    made.addEventListener("pointermove", (/** @type {any} */ event) => {
      if (!made.hasPointerCapture(event.pointerId)) return;
      const box = /** @type {any} */ (made).ownerSVGElement.getBoundingClientRect();
      const [zoomX, zoomY] = [width / box.width, height / box.height];
      goal.x_m = Number((goal.x_m + (event.clientX - (last[0] ?? 0)) * zoomX / scale).toFixed(3));
      goal.y_m = Number((goal.y_m - (event.clientY - (last[1] ?? 0)) * zoomY / scale).toFixed(3));
      last = [event.clientX, event.clientY];
      made.setAttribute("cx", String(x?.(first.x_m + goal.x_m)));
      made.setAttribute("cy", String(y?.(first.y_m + goal.y_m)));
    });
    made.addEventListener("pointerup", () => this.dragged());
    return made;
  }

  /**
   * A bar of a round length.
   * @param {number} scale
   * @param {number} width
   * @param {number} height
   */
  bar(scale, width, height) {
    const rough = 80 / scale;
    const ten = 10 ** Math.floor(Math.log10(rough));
    const length = [5, 2, 1].map((it) => it * ten).find((it) => it <= rough) ?? ten;
    const left = width - 16 - length * scale;
    return [
      svg("path", { class: "axis", d: `M${left} ${height - 20}v6h${length * scale}v-6` }),
      svg("text", { x: width - 16, y: height - 24, "text-anchor": "end" }, [`${Number(length.toPrecision(2))} m`]),
    ];
  }

  /** @param {number} place of the record */
  show(place) {
    const record = this.run?.samples[place];
    if (!record) return;
    this.place = place;
    const time = /** @type {HTMLInputElement} */ (this.time);
    time.value = String(place);
    time.setAttribute("aria-valuetext", `${four(record.time_s)} s`);
    this.clock.textContent = `${four(record.time_s)} s`;
    this.pose?.(record);
    this.stand(record);
    for (const cursor of this.cursors) cursor(record.time_s);
    const rover = OF_ROVER.filter(([column]) => typeof record[column] === "number").map(([column, label]) => {
      const [name, unit = ""] = label.replace("]", "").split(" [");
      return `${name} ${four(record[column])}${unit === "°" ? "" : " "}${unit}`;
    });
    this.now.replaceChildren(
      element("table", {}, [
        element("caption", {}, [rover.slice(0, 5).join(", ")]),
        element("thead", {}, [element("tr", {}, [element("td"), ...OF_WHEELS.slice(0, 4).map(([, title]) => element("th", { scope: "col" }, [title]))])]),
        element("tbody", {}, record.wheels.map((/** @type {any} */ wheel) => element("tr", {}, [
          element("th", { scope: "row" }, [wheel.wheel]),
          ...OF_WHEELS.slice(0, 4).map(([column]) => element("td", { "data-column": `${wheel.wheel}-${column}` }, [four(wheel[column])])),
        ]))),
      ]),
    );
  }

  /**
   * Has the rover stand in three dimensions as a record has it.
   * @param {Row} record
   */
  stand(record) {
    this.scene.at(record["time_s"]);
  }

  play() {
    if (this.timer) {
      this.pause();
      return;
    }
    const samples = this.run?.samples;
    if (!samples?.length) return;
    const last = samples.length - 1;
    const from = this.place >= last ? 0 : this.place;
    this.button.textContent = "Pause";
    const began = performance.now();
    const step = () => {
      const place = Math.min(last, from + Math.round((performance.now() - began) / 1000 / PLAY * last));
      this.show(place);
      if (place < last) this.timer = requestAnimationFrame(step);
      else this.pause();
    };
    this.timer = requestAnimationFrame(step);
  }

  pause() {
    cancelAnimationFrame(this.timer);
    this.timer = 0;
    this.button.textContent = "Play";
  }

  /** The end of the run in a few words. */
  said() {
    return this.run ? `${this.run.outcome.replace(/_/g, " ")} after ${four(this.run.final.time_s)} s` : "there is no run";
  }
}
