// A study that takes long: started and stopped by hand, with its progress.

import { Asking } from "./api.js";
import { element, four } from "./dom.js";

/** @typedef {import("./api.js").Line} Line */

/** The buttons of a study, and how far it is. */
export class Study {
  /**
   * @param {string} what the start button says
   * @param {() => void} start
   * @param {() => void} stopped
   */
  constructor(what, start, stopped) {
    this.asking = new Asking();
    this.button = element("button", { type: "button", id: "start", onclick: start }, [what]);
    this.halt = element("button", { type: "button", id: "stop", disabled: true, onclick: () => {
      this.stop();
      stopped();
    } }, ["Stop"]);
    this.bar = element("progress", { id: "progress", "aria-label": "Progress", hidden: true });
    this.words = element("output", { id: "progress-words" });
    /** @type {string | undefined} what is counted */
    this.what = undefined;
    /** @type {number | null | undefined} how many there are of it */
    this.all = undefined;
    this.element = element("div", { class: "study", role: "group", "aria-label": "Study" }, [this.button, this.halt, this.bar, this.words]);
  }

  /**
   * @param {string} name
   * @param {object} question
   * @param {(line: Line) => void} take all lines but those of the progress
   * @param {(error: Error | undefined) => void} end
   */
  run(name, question, take, end) {
    this.show(true);
    this.words.textContent = "waiting for its turn …";
    this.asking.ask(name, question, (line) => {
      if (line.schema === "grouser.progress.v1") this.progress(line);
      else take(line);
    }, (error) => {
      this.show(false);
      if (error) this.words.textContent = "";
      else if (this.all) this.words.textContent = `${this.all} of ${this.all} ${this.what}`;
      end(error);
    });
  }

  /** @param {Line} line */
  progress({ what, done = 0, all, time_s: time }) {
    [this.what, this.all] = [what, all];
    if (all) {
      this.bar.setAttribute("max", String(all));
      this.bar.setAttribute("value", String(done));
    }
    this.words.textContent = `${done}${all ? ` of ${all}` : ""} ${what}, ${four(Math.round(time ?? 0))} s`;
  }

  /** @param {boolean} isRunning */
  show(isRunning) {
    this.button.toggleAttribute("disabled", isRunning);
    this.halt.toggleAttribute("disabled", !isRunning);
    this.bar.hidden = !isRunning;
    this.bar.removeAttribute("value");
    if (isRunning) this.halt.focus();
    else if (document.activeElement === document.body || document.activeElement === this.halt) this.button.focus();
  }

  /** Whoever goes away stops the computation, too. */
  stop() {
    this.asking.stop();
    this.show(false);
  }
}
