// The third view, by hand: a rover that keys and buttons drive, step after step. The engine computes
// each step from the state that the last one gave, which is kept here.

import { ask } from "./api.js";
import { DriveAnswer } from "./drive.js";
import { element, four, save } from "./dom.js";
import { about as aboutRover } from "./heading.js";

/** @typedef {import("./session.js").Session} Session */
/** @typedef {import("./api.js").Row} Row */

/** What the session calls a drive by hand, in place of a mission. */
export const BY_HAND = "by hand";
/** Time between two steps [s]: of the clock on the wall, and of the rover at the pace of 1. */
const STEP = 0.1;
/** The weight of the last step in the average of how long they take. */
const SMOOTH = 0.2;
/** The shortest step [s]. */
const LEAST = 0.01;
/** Seconds of the rover in one second. */
const PACES = [1, 4, 16];
/** How much slower the sides turn inside of a curve than straight ahead, and so much faster outside. */
const CURVE = 0.5;
/** What moves less stands: [m/s], and [°/s]. */
const STANDS = [1e-3, 0.1];
/** Records that are kept; with more of them every second one goes. */
const MOST = 6000;
/** How often charts and plan are drawn [ms]. */
const DRAWN = 700;
/** How far the rover drives between two scenes of the ground around it [m]. */
const GROUND = 0.6;
/** How far the way is above a plane, so that it is seen [m]. */
const LIFT = 0.004;
/** Points of charts and of the way. */
const POINTS = 300;
/** How long a press lasts that has no end, as one of a screen reader [ms]. */
const PRESS = 1000;

/**
 * The keys: what is pressed for each, its sign and what it is called.
 * @type {Record<string, [string, string]>}
 */
const KEYS = { ArrowUp: ["↑", "Forward"], ArrowLeft: ["←", "Turn left"], ArrowRight: ["→", "Turn right"], ArrowDown: ["↓", "Backward"] };

/**
 * Whether keys are for a control, and not for the rover.
 * @param {EventTarget | null} target
 */
function isField(target) {
  return target instanceof HTMLInputElement || target instanceof HTMLSelectElement || target instanceof HTMLTextAreaElement;
}

/**
 * Some of the records, with the last.
 * @param {any[]} all
 */
function some(all) {
  const every = Math.ceil(all.length / POINTS);
  return all.filter((_, place) => place % every === 0 || place === all.length - 1);
}

/** @param {number[]} numbers */
const mean = (numbers) => numbers.reduce((sum, one) => sum + one, 0) / (numbers.length || 1);

/** A rover that is driven by hand. */
export class HandDrive extends DriveAnswer {
  /**
   * @param {(error: Error | undefined) => void} ended
   * @param {(seen: string, isToAsk: boolean) => void} looked
   */
  constructor(ended, looked) {
    super(ended, looked);
    /** @type {Set<string>} keys and buttons that are held */
    this.held = new Set();
    /** @type {string | undefined} where the rover is, as the engine says it */
    this.state = undefined;
    /** What the drive is of, as text. */
    this.asked = "";
    /** What the rover's instruments would have said, as CSV in pieces. @type {string[]} */
    this.telemetry = [];
    this.reader = element("p", { class: "setup", id: "drive-command", hidden: true });
    this.isGoing = false;
    this.drawnAt = 0;
    /** How long a step takes, on the average of the last ones [s]. */
    this.took = 0;
    /** Where the last scene has its ground: x and y [m]. @type {[number, number] | undefined} */
    this.middle = undefined;
    /** @type {AbortController} */
    this.steps = new AbortController();
    this.pace = PACES[0] ?? 1;
    /** The kind of simulation; empty for that of the scenario. */
    this.simulation = "";
    this.scene.leaveArrows();
    this.numbers = element("table", { id: "live" });
    this.rate = element("output", { id: "rate" });
    this.pad = this.makePad();
    this.element.prepend(this.pad);
    this.pressed = (/** @type {KeyboardEvent} */ event) => this.press(event, true);
    this.released = (/** @type {KeyboardEvent} */ event) => this.press(event, false);
    this.left = () => this.held.clear();
    addEventListener("keydown", this.pressed);
    addEventListener("keyup", this.released);
    addEventListener("blur", this.left);
    document.addEventListener("visibilitychange", this.left);
  }

  /** The buttons, and what the keys do. */
  makePad() {
    const pace = element("select", { id: "pace", onchange: (/** @type {any} */ event) => {
      this.pace = Number(event.target.value);
    } }, PACES.map((it) => element("option", { value: it }, [it === 1 ? "as in time" : `${it} times as fast`])));
    const kinds = [["", "as the scenario says"], ["dynamic", "dynamic"], ["quasi-steady", "quasi-steady"]];
    const simulation = element("select", { id: "simulation", onchange: (/** @type {any} */ event) => {
      this.simulation = event.target.value;
      if (this.session) this.ask(this.session);
    } }, kinds.map(([value = "", text = ""]) => element("option", { value }, [text])));
    return element("div", { class: "pad", role: "group", "aria-label": "Drive by hand" }, [
      element("div", { class: "keys" }, Object.entries(KEYS).map(([key, [sign, label]]) => this.makeButton(key, sign, label))),
      element("div", {}, [
        element("p", { class: "setup", id: "pad-help" }, [
          "Hold an arrow key, or a button: ahead, back, and a turn to either side, on the spot or in a curve. Nothing drives while a field has the keys.",
        ]),
        element("div", { class: "choice" }, [
          element("label", {}, ["Pace ", pace]),
          element("label", {}, ["Simulation ", simulation]),
          element("button", { type: "button", id: "anew", onclick: () => this.begin() }, ["Start anew"]),
          element("button", { type: "button", id: "save-drive", onclick: () => this.saveDrive() }, ["Save the drive"]), this.rate,
        ]),
        this.reader,
      ]),
    ]);
  }

  /**
   * A button that is held as its key is.
   * @param {string} key
   * @param {string} sign
   * @param {string} label
   */
  makeButton(key, sign, label) {
    const hold = () => this.hold(key);
    const release = () => this.held.delete(key);
    const isPress = (/** @type {KeyboardEvent} */ event) => event.key === "Enter" || event.key === " ";
    let isHeld = false;
    const button = element("button", { type: "button", class: key, "aria-label": label, title: label, "aria-describedby": "pad-help" }, [sign]);
    button.addEventListener("pointerdown", (/** @type {PointerEvent} */ event) => {
      isHeld = true;
      button.setPointerCapture(event.pointerId);
      hold();
    });
    for (const end of ["pointerup", "pointercancel", "blur"]) button.addEventListener(end, release);
    button.addEventListener("keydown", (/** @type {KeyboardEvent} */ event) => {
      if (!isPress(event)) return;
      isHeld = true;
      hold();
    });
    button.addEventListener("keyup", (/** @type {KeyboardEvent} */ event) => {
      if (isPress(event)) release();
    });
    button.addEventListener("click", () => {
      // One that is pressed by other means has no end.
      if (!isHeld) {
        hold();
        setTimeout(release, PRESS);
      }
      isHeld = false;
    });
    return button;
  }

  /**
   * @param {KeyboardEvent} event
   * @param {boolean} isDown
   */
  press(event, isDown) {
    if (!(event.key in KEYS)) return;
    if (!isDown) {
      this.held.delete(event.key);
      return;
    }
    if (isField(event.target) || event.ctrlKey || event.metaKey || event.altKey || event.shiftKey) return;
    event.preventDefault();
    this.hold(event.key);
  }

  /** @param {string} key */
  hold(key) {
    this.held.add(key);
    this.pause();
    this.place = Math.max(0, (this.run?.samples.length ?? 0) - 1);
    this.go();
  }

  /** What is asked of every step. */
  question() {
    const session = /** @type {Session} */ (this.session);
    const isPlane = session.ground === "";
    const about = aboutRover(session);
    return {
      ...about, ...(isPlane ? { slope_deg: session.slope } : {}), yaw_deg: session.yaw,
      set: { ...about.set, ...(this.simulation ? { "scenario.simulation": this.simulation } : {}), ...(isPlane ? {} : { "scenario.terrain.file": session.ground }) },
    };
  }

  /**
   * A drive that is of something else begins anew.
   * @override
   * @param {Session} session
   */
  ask(session) {
    this.session = session;
    const asked = JSON.stringify(this.question());
    const isOther = asked !== this.asked || !this.state;
    this.asked = asked;
    this.middle = undefined;
    this.look(session.seen);
    if (isOther) this.begin();
    else this.seenAnew();
  }

  /** Has the scene where the rover is: of a step that is none of the drive. */
  async seenAnew() {
    if (this.isScene && !this.isGoing && !this.run?.outcome) {
      this.isGoing = true;
      await this.step(LEAST, true, (line) => this.takeScene(line));
      this.isGoing = false;
    }
    this.answered(undefined);
    if (this.held.size) this.go();
  }

  /** Saves the drive so far as telemetry, and says what reads it. */
  saveDrive() {
    save("drive.csv", this.telemetry.join(""));
    this.reader.hidden = false;
  }

  /** Stands at the start. */
  async begin() {
    this.steps.abort();
    this.steps = new AbortController();
    this.held.clear();
    this.state = undefined;
    this.telemetry = [];
    this.reader.hidden = true;
    this.scene.way = [];
    this.scene.standing = undefined;
    this.scene.target = undefined;
    this.run = { samples: [], outcome: null, flags: [] };
    this.outcome.classList.add("stale");
    const error = await this.step(STEP, this.isScene);
    if (error !== undefined) this.answered(error ?? undefined);
  }

  /** Goes on while a key is held, and until the rover stands. */
  async go() {
    if (this.isGoing || !this.state || this.run?.outcome) return;
    this.isGoing = true;
    let failed;
    const { steps } = this;
    while (steps === this.steps && this.isDriving() && failed === undefined) {
      const began = performance.now();
      failed = await this.step(STEP * this.pace, this.isFar()) || undefined;
      const took = (performance.now() - began) / 1000;
      await new Promise((resolve) => setTimeout(resolve, 1000 * Math.max(0, STEP - took)));
      this.took += SMOOTH * (took - this.took);
      this.rate.textContent = this.took > 1.2 * STEP ? `at ${four(Number((STEP * this.pace / this.took).toPrecision(2)))} times real time: the computer needs longer` : "";
    }
    this.isGoing = false;
    this.took = 0;
    if (steps !== this.steps) {
      if (this.held.size) this.go();
      return;
    }
    this.drawAll();
    this.outcome.replaceChildren(...this.became(this.run));
    if (failed || this.run?.outcome) this.answered(failed ?? undefined);
  }

  isDriving() {
    const { run, steps } = this;
    const last = run?.samples.at(-1);
    if (!last || run.outcome || steps.signal.aborted) return false;
    const [speed = 0, rate = 0] = STANDS;
    return this.held.size > 0 || Math.hypot(last.forward_speed_m_s, last.lateral_speed_m_s) > speed || Math.abs(last.yaw_rate_deg_s) > rate;
  }

  /** Whether there is no scene yet, or its ground is left behind. */
  isFar() {
    const last = this.run?.samples.at(-1);
    if (!this.isScene || !last) return false;
    return !this.middle || Math.hypot(last.x_m - this.middle[0], last.y_m - this.middle[1]) > GROUND;
  }

  /** The speeds of the sides, left and right [m/s]. */
  rims() {
    const is = (/** @type {string} */ key) => Number(this.held.has(key));
    const [ahead, turn] = [is("ArrowUp") - is("ArrowDown"), is("ArrowLeft") - is("ArrowRight")];
    const side = (/** @type {number} */ sign) => ahead ? ahead * (1 + sign * turn * CURVE) / (1 + Math.abs(turn) * CURVE) : sign * turn;
    return [side(-1), side(1)].map((it) => it * (this.session?.speed ?? 0));
  }

  /**
   * One step of the engine.
   * @param {number} span [s]
   * @param {boolean} hasScene
   * @param {(line: any) => void} take
   * @returns {Promise<Error | null | undefined>} what went wrong; null after the first step
   */
  async step(span, hasScene, take = (line) => this.takeStep(line)) {
    const { signal } = this.steps;
    const isFirst = !this.state;
    const question = {
      ...this.question(), rim_speed_m_s: this.rims(), dt_s: span, telemetry: true, ...(this.state ? { state: this.state } : {}), ...(hasScene ? { scene: true } : {}),
    };
    try {
      await ask("drive-step", question, signal, (line) => {
        if (!signal.aborted) take(line);
      });
      return signal.aborted ? undefined : isFirst ? null : undefined;
    } catch (error) {
      return signal.aborted ? undefined : /** @type {Error} */ (error);
    }
  }

  /** @param {any} line of a step */
  takeStep(line) {
    const isFirst = !this.state;
    const { samples } = this.run;
    const isFollowed = this.place >= samples.length - 1;
    this.state = line.state;
    this.telemetry.push(line.telemetry.csv);
    this.reader.replaceChildren("drive.csv is telemetry, which the view Log and ", element("code", {}, [line.telemetry.command]), " read.");
    for (const sample of isFirst ? line.samples : line.samples.slice(1)) {
      const before = samples.at(-1);
      const span = sample.time_s - (before?.time_s ?? sample.time_s);
      sample.turned_rad = sample.wheels.map((/** @type {Row} */ wheel, /** @type {number} */ at) => (before?.turned_rad[at] ?? 0) + span * wheel["wheel_speed_rad_s"]);
      samples.push(sample);
    }
    if (samples.length > MOST) this.run.samples = samples.filter((/** @type {any} */ _, /** @type {number} */ at) => at % 2 === 0 || at === samples.length - 1);
    this.run = { ...this.run, outcome: line.outcome, reason: line.reason, flags: line.flags, simulation: line.simulation, final: this.run.samples.at(-1) };
    this.takeScene(line);
    const last = this.run.samples.length - 1;
    this.time.setAttribute("max", String(last));
    this.way();
    if (isFirst || performance.now() - this.drawnAt > DRAWN) this.drawAll();
    if (isFollowed || isFirst) this.show(last);
    this.outcome.classList.remove("stale");
    this.outcome.replaceChildren(...this.became(this.run));
  }

  /** @param {any} line of a step */
  takeScene(line) {
    if (!line.scene || !this.isScene) return;
    this.middle = [this.run.final.x_m, this.run.final.y_m];
    this.scene.take(line.scene);
  }

  /** The way of the centre of mass so far; on a plane it is drawn on the ground. */
  way() {
    this.scene.way = some(this.run.samples).map(({ x_m: x, y_m: y, z_m: z }) => [x, y, z ?? LIFT]);
  }

  /** Draws charts and plan, which takes longer than a step. */
  drawAll() {
    this.drawnAt = performance.now();
    const run = { ...this.run, samples: some(this.run.samples) };
    this.drawCharts(run);
    this.drawPlan(run.samples, run.final.z_m === undefined);
    this.show(this.place);
  }

  /**
   * @override
   * @param {any} run
   */
  became(run) {
    const { final, outcome } = run;
    const of = (/** @type {string} */ column) => final.wheels.map((/** @type {Row} */ wheel) => wheel[column]);
    const rows = /** @type {[string, string, number][]} */ ([
      ["slip ratio, mean", "slip_ratio", mean(of("slip_ratio"))], ["sinkage, largest [mm]", "sinkage_mm", Math.max(0, ...of("sinkage_mm"))],
      ["power [W]", "power_w", final.power_w], ["speed [m/s]", "speed_m_s", Math.hypot(final.forward_speed_m_s, final.lateral_speed_m_s)],
      ["energy [J]", "energy_j", final.energy_j],
    ]);
    const words = outcome ? outcome.replace(/_/g, " ") : this.isDriving() ? "under way" : "ready";
    this.numbers.replaceChildren(
      element("caption", {}, [`At ${four(final.time_s)} s, x ${four(final.x_m)} m, y ${four(final.y_m)} m, yaw ${four(final.yaw_deg)}°`]),
      element("tbody", {}, rows.map(([label, column, value]) => element("tr", {}, [
        element("th", { scope: "row" }, [label]), element("td", { "data-column": `live-${column}` }, [four(value)]),
      ]))),
    );
    return [
      element("p", { class: `verdict ${outcome ? "no_go" : "cannot_tell"}`, id: "outcome" }, [element("span", { "aria-hidden": "true" }, [outcome ? "✕" : "●"]), words]),
      element("p", { class: "sentence", id: "why-ended" }, [outcome ? `${run.reason ?? ""} The drive is over: start anew.`.trim() : `Each step is computed as it is driven, ${(run.simulation ?? "").replace(/-/g, " ")}, on the soil as written.`]),
      this.numbers,
      ...(run.flags?.length ? [element("p", { class: "sentence" }, [`Outside of what was measured: ${run.flags.join(", ").replace(/_/g, " ")}.`])] : []),
    ];
  }

  /**
   * @override
   * @param {Row} record
   */
  stand(record) {
    this.scene.stand(record);
  }

  /** @override */
  stop() {
    this.steps.abort();
    removeEventListener("keydown", this.pressed);
    removeEventListener("keyup", this.released);
    removeEventListener("blur", this.left);
    document.removeEventListener("visibilitychange", this.left);
    super.stop();
  }

  /** @override */
  said() {
    const { run } = this;
    if (!run?.final) return "there is no drive";
    return run.outcome ? `${run.outcome.replace(/_/g, " ")} after ${four(run.final.time_s)} s` : "the rover stands ready";
  }
}
