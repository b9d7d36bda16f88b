// The fifth view: a design, the numbers of a rover that are the best under limits.

import { Asking } from "./api.js";
import { setOf } from "./session.js";
import { StudyAnswer } from "./study.js";
import { labelOf } from "./wheel.js";

/** @typedef {import("./session.js").Session} Session */

/**
 * What is asked of a design, whatever the question.
 * @param {Session} session
 */
export function about({ design, set }) {
  return { design, set: setOf({ set }, ["design"]) };
}

/** @typedef {{name: string, meaning: string}} Measure */

/**
 * A measure in a few words.
 * @param {Measure} measure
 */
export function wordsOf({ meaning }) {
  return meaning.split(/[,;]/)[0] ?? meaning;
}

/** @param {string} text */
const lower = (text) => text.charAt(0).toLowerCase() + text.slice(1);

/**
 * Numbers of a design, of which limits are called by what they limit.
 * @param {import("./api.js").Key[]} keys
 * @param {Measure[]} measures
 */
export function namedKeys(keys, measures) {
  return keys.map((key) => {
    const [, name, end] = key.key.match(/\.(\w+)\.at_(least|most)$/) ?? [];
    const measure = measures.find((it) => it.name === name);
    return measure ? { ...key, meaning: `At ${end}: ${lower(wordsOf(measure))}` } : key;
  });
}

/**
 * An end of a number that is free, called by the number and the part of the rover that has it.
 * @param {import("./api.js").Key} key
 */
export function nameOfEnd(key) {
  const [, path = "", end] = key.key.match(/\.free\.rover\.(.*)\.([01])$/) ?? [];
  const part = path.split(".").slice(0, -1).join(" ").replace(/_/g, " ").replace("wheel unit wheel", "wheel");
  return { ...key, meaning: `${labelOf(key)}${part ? ` (${part})` : ""}: ${end === "0" ? "at least" : "at most"}` };
}

/** The answer about a design. */
export class DesignAnswer extends StudyAnswer {
  /**
   * @param {(error: Error | undefined) => void} ended
   * @param {() => void} started
   */
  constructor(ended, started) {
    super({
      start: "Search the design",
      hint: "The search starts when you ask for it: it takes seconds, and minutes where soils are uncertain or measures are traded.",
      none: "no design is searched yet",
      failed: "no design",
    }, ended, started);
    this.checking = new Asking();
  }

  /**
   * @override
   * @param {Session} session
   */
  ask(session) {
    super.ask(session);
    // What is wrong with its numbers is said before it is searched.
    this.checking.ask("design-task", about(session), () => {}, (error) => {
      if (error) this.ended(error);
    });
  }

  /** @override */
  stop() {
    this.checking.stop();
    super.stop();
  }

  /**
   * @override
   * @param {Session} session
   * @returns {[string, object]}
   */
  question(session) {
    const trade = session.trade.split(",").filter(Boolean);
    return ["design", { ...about(session), nominal: session.belief === "nominal", trade, shown: true, figures: true, slide: true }];
  }

  /**
   * @override
   * @param {string[]} all
   */
  others(all) {
    return all.filter((it) => !it.startsWith("Between "));
  }

  /** @override */
  said() {
    return this.first.split(", ")[0] ?? "";
  }
}
