// The eighth view: a log of a drive beside what is predicted for it.

import { about as aboutScenario } from "./heading.js";
import { StudyAnswer } from "./study.js";

/** @typedef {import("./session.js").Session} Session */

/** Samples behind the bands. */
const SAMPLES = 50;

/** The answer about a log. */
export class LogAnswer extends StudyAnswer {
  /**
   * @param {(error: Error | undefined) => void} ended
   * @param {() => void} started
   */
  constructor(ended, started) {
    super({
      start: "Replay the log",
      hint: "A log of the folder is replayed when you ask for it: what its instruments read beside what is predicted at the wheel speeds and the attitude that they read, and what the differences point to.",
      none: "no log is replayed yet",
      failed: "no replay",
    }, ended, started);
  }

  /**
   * @override
   * @param {Session} session
   * @returns {[string, object]}
   */
  question(session) {
    const samples = session.belief === "nominal" ? {} : { samples: SAMPLES };
    return ["replay", { ...aboutScenario(session), log: session.log, ...samples, shown: true, figures: true, slide: true }];
  }
}
