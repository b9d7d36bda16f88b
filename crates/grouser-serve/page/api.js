// Asks the engine, and reads its answers line by line.

import { LOST, answer, textOf } from "./engine.js";

/**
 * A row of an answer: columns by their names.
 * @typedef {Record<string, any>} Row
 */

/**
 * A line of an answer.
 * @typedef {object} Line
 * @property {string} schema what it is
 * @property {Row[]} [rows]
 * @property {string} [error]
 * @property {string} [key] of the question, that is to blame
 * @property {string} [hint]
 * @property {string} [command]
 * @property {string[]} [sentences]
 * @property {string[]} [assumptions]
 * @property {Record<string, string>} [documents]
 * @property {Key[]} [keys]
 * @property {Record<string, string>} [names]
 * @property {string} [model]
 * @property {boolean} [states_uncertainty]
 * @property {{name: string, caption: string, svg: string}[]} [drawings]
 * @property {{caption: string, svg: string, is_wide?: boolean}[]} [figures]
 * @property {{name: string, label: string, about: string}[]} [layers]
 * @property {Record<string, number[]>} [frame] where the ground lies on a drawing
 * @property {string[]} [notes]
 * @property {string} [slide] as SVG
 * @property {string | null} [scene] a run in three dimensions: binary glTF, in base64
 * @property {{caption: string, columns: string[], words?: Record<string, string>, rows: Row[]}[]} [tables]
 * @property {Key[]} [free] ends of the numbers of a design
 * @property {{name: string, meaning: string}[]} [measures]
 * @property {string} [what] is counted
 * @property {number} [runs] of a campaign
 * @property {any[]} [legs] of a mission
 * @property {any} [run] of a mission
 * @property {string} [verdict] what the answer says first
 * @property {number} [done] of it
 * @property {number | null} [all]
 * @property {string} [pdf] a file, in base64
 * @property {number} [time_s]
 * @property {Record<string, string>} [files]
 */

/**
 * A number of a document that may be set.
 * @typedef {object} Key
 * @property {string} key
 * @property {number} value
 * @property {number | null} minimum
 * @property {number | null} maximum
 * @property {string | null} unit
 * @property {string | null} meaning
 * @property {boolean} [is_uncertain]
 * @property {boolean} [is_assumed]
 */

/** Lines that say how far an answer is. */
const PROGRESS = "grouser.progress.v1";

/** What the engine says is wrong, and with which key. */
export class Refused extends Error {
  /** @param {Line} line */
  constructor(line) {
    super(line.error + (line.hint ? `\n${line.hint}` : ""));
    this.key = line.key;
  }
}

/**
 * Asks a question; each line is handed on as it comes.
 * @param {string} name of the question
 * @param {object} question
 * @param {AbortSignal} signal stops the computation, too
 * @param {(line: Line) => void} take
 */
export async function ask(name, question, signal, take) {
  await answer(name, question, signal, (text) => {
    /** @type {Line} */
    const line = JSON.parse(text);
    if (line.error !== undefined) throw new Refused(line);
    take(line);
  });
}

/**
 * What there is to choose from.
 * @param {string} name of the list
 * @returns {Promise<Row[]>}
 */
export async function list(name) {
  const listed = JSON.parse(await textOf(name));
  if (listed.error) throw new Refused(listed);
  return listed.rows;
}

/**
 * A question that is asked again and again: a new one stops the one before it.
 */
export class Asking {
  constructor() {
    /** @type {AbortController | undefined} */
    this.running = undefined;
    /** @type {[string, any] | undefined} the last question, with its name */
    this.asked = undefined;
    /** @type {(line: Line) => void} takes how far the answer is, where that is known */
    this.watch = () => {};
  }

  /**
   * @param {string} name
   * @param {object} question
   * @param {(line: Line) => void} take
   * @param {(error: Error | undefined) => void} end with what went wrong, if anything did
   */
  async ask(name, question, take, end) {
    this.running?.abort();
    this.asked = [name, question];
    const own = new AbortController();
    this.running = own;
    const isCurrent = () => this.running === own;
    try {
      await ask(name, question, own.signal, (line) => {
        if (isCurrent()) (line.schema === PROGRESS ? this.watch : take)(line);
      });
      if (isCurrent()) end(undefined);
    } catch (error) {
      if (!isCurrent()) return;
      end(error instanceof TypeError ? new Error(LOST) : /** @type {Error} */ (error));
    }
  }

  stop() {
    this.running?.abort();
    this.running = undefined;
  }
}
