// A study that takes long: started and stopped by hand, with its progress.

import { Asking } from "./api.js";
import { element, four, picturesOf, tableOf } from "./dom.js";
import { exportOf } from "./heading.js";

/** @typedef {import("./session.js").Session} Session */
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
    this.asking.watch = (line) => this.progress(line);
    this.button = element("button", { type: "button", id: "start", onclick: start }, [what]);
    this.halt = element("button", { type: "button", id: "stop", disabled: true, onclick: () => {
      this.stop();
      this.words.textContent = this.what ? `${this.words.textContent}: stopped` : "stopped";
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
   * @param {(line: Line) => void} take
   * @param {(error: Error | undefined) => void} end
   */
  run(name, question, take, end) {
    this.show(true);
    this.what = this.all = undefined;
    this.words.textContent = "waiting for its turn …";
    this.asking.ask(name, question, take, (error) => {
      this.show(false);
      // What is quick counts nothing on its way.
      this.words.textContent = !error && this.all ? `${this.all} of ${this.all} ${this.what}` : "";
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

/** The answer of a study: its sentences, tables and figures once it has ended. */
export class StudyAnswer {
  /**
   * @param {object} words
   * @param {string} words.start what the start button says
   * @param {string} words.hint what stands there before the first answer
   * @param {string} words.none what is said then
   * @param {string} words.failed what is said where there is no answer
   * @param {(error: Error | undefined) => void} ended
   * @param {() => void} started
   */
  constructor({ start, hint, none, failed }, ended, started) {
    this.ended = ended;
    this.failed = failed;
    /** @type {string | undefined} the picture for a slide */
    this.slide = undefined;
    this.first = this.before = none;
    this.study = new Study(start, () => {
      started();
      this.start();
    }, () => {
      this.first = this.before;
      this.hint.textContent = hint;
      this.ended(undefined);
    });
    this.asking = this.study.asking;
    this.hint = element("p", { class: "sentence" }, [hint]);
    this.body = element("div", {}, [this.hint]);
    this.element = element("div", {}, [this.study.element, this.body]);
  }

  /**
   * The question of a session, with its name.
   * @param {Session} session
   * @returns {[string, object]}
   */
  question(session) {
    throw new Error(`no question of ${session.view}`);
  }

  /**
   * The sentences that are shown below the first.
   * @param {string[]} all
   */
  others(all) {
    return all;
  }

  /** @param {Session} session */
  ask(session) {
    // What is shown is of numbers that were moved since.
    if (this.session) this.body.classList.add("old");
    this.session = session;
    this.ended(undefined);
  }

  start() {
    if (!this.session) return;
    this.before = this.first;
    this.first = "computing …";
    if (this.hint.isConnected) this.hint.textContent = "The answer comes when it is computed to its end.";
    this.study.run(...this.question(this.session), (line) => {
      if (line.schema === "grouser.shown.v1") this.take(line);
      else this.answer(line);
    }, (error) => {
      if (error) {
        this.first = this.failed;
        this.slide = undefined;
        this.body.classList.remove("old");
        this.body.replaceChildren(element("p", { class: "error", id: "why-none" }, [error.message]));
      }
      this.ended(error);
    });
  }

  /**
   * Takes the object of the answer, before what is shown of it.
   * @param {Line} line
   */
  answer(line) {
    void line;
  }

  /** @param {Line} line */
  take(line) {
    this.slide = line.slide;
    const [first = "", ...others] = (line.sentences ?? []).filter(Boolean);
    this.first = first;
    this.body.classList.remove("old");
    this.body.replaceChildren(
      element("div", { class: "card" }, [
        element("p", { class: "found", id: "found" }, [first]),
        element("ul", {}, this.others(others).map((it) => element("li", {}, [it]))),
      ]),
      ...(line.tables ?? []).map(tableOf),
      element("div", { class: "figures" }, picturesOf(line.figures ?? [])),
      exportOf(line, undefined),
    );
  }

  stop() {
    this.study.stop();
  }

  said() {
    return this.first;
  }
}
