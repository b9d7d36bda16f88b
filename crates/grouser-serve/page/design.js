// The fifth view: a design, the numbers of a rover that are the best under limits.

import { setOf } from "./session.js";
import { StudyAnswer } from "./study.js";

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
