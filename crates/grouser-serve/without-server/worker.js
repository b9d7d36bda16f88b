// A worker that has an engine: it answers one question after another, beside the page.

import { engineOf } from "./instance.js";

/**
 * A question for a worker.
 * @typedef {object} Task
 * @property {number} id
 * @property {string} name
 * @property {string} question as JSON
 * @property {number} from lines before this one are not wanted
 * @property {number} to nor are those from this one on
 */

/**
 * What a worker reports: lines, samples that were begun since the last line, and the end.
 * @typedef {{id: number, line?: string, begun?: number, end?: string}} Report
 */

/** The least time between two reports of samples [ms]. */
const BETWEEN = 60;

/** @type {(report: Report) => void} */
const report = (it) => postMessage(it);

/** @type {Promise<import("./instance.js").Ask> | undefined} */
let engine;

addEventListener("message", async ({ data }) => {
  if (data instanceof WebAssembly.Module) engine = engineOf(data);
  else if (engine) answer(await engine, data);
});

/**
 * @param {import("./instance.js").Ask} ask
 * @param {Task} task
 */
function answer(ask, { id, name, question, from, to }) {
  let [lines, begun, due] = [0, 0, performance.now() + BETWEEN];
  /** @type {string | undefined} */
  let failed;
  const take = (/** @type {string} */ line) => {
    const isWanted = lines >= from && lines < to;
    lines += 1;
    begun = 0;
    // Of a refusal there is one, whatever is wanted.
    if (isWanted || line.startsWith('{"schema":"grouser.error')) report({ id, line });
    return lines < to;
  };
  const goOn = () => {
    begun += 1;
    if (lines >= from && performance.now() >= due) {
      report({ id, begun });
      due = performance.now() + BETWEEN;
    }
    return true;
  };
  try {
    ask(name, question, { take, goOn });
  } catch (error) {
    failed = String(error);
  }
  report({ id, end: failed ?? "" });
}
