// The engine that answers where there is no server: WebAssembly in workers, behind the same functions as
// `page/engine.js`, whose place this module takes on the page of the documentation.

/** @typedef {import("../page/engine.js")} Engine */
/** @typedef {import("./worker.js").Task} Task */
/** @typedef {import("./worker.js").Report} Report */

/** @type {Engine["VIEWS"]} */
export const VIEWS = ["heading", "wheel"];

/** @type {Engine["REMARK"]} */
export const REMARK = {
  text: "Computed in your browser. Drives, maps, designs, campaigns, fits, logs and your own documents need the program:",
  command: "grouser serve my-rovers",
  guide: "../guide/console.html",
};

/** @type {Engine["LOST"]} */
export const LOST = "The engine cannot be loaded: is this page still there?";

/** How long the page rests before samples are computed [ms]: a slider that moves on asks anew. */
const REST = 100;
/** Workers for samples at the most: each has the memory of an engine. */
const MOST = 3;

/** A line with how far an answer is. */
const PROGRESS = "grouser.progress.v1";

const compiled = compile();

async function compile() {
  const response = await fetch(new URL("engine.wasm", import.meta.url));
  if (!response.ok) throw new TypeError(LOST);
  // Some servers give every file the same type.
  const isNamed = response.headers.get("content-type")?.startsWith("application/wasm");
  return isNamed ? WebAssembly.compileStreaming(response) : WebAssembly.compile(await response.arrayBuffer());
}

/**
 * A question that waits for a worker, or that one answers.
 * @typedef {object} Job
 * @property {Task} task
 * @property {(report: Report) => void} take
 * @property {() => void} done
 * @property {(error: unknown) => void} failed
 */

/** Workers that share the questions of one line. */
class Line {
  /**
   * @param {number} most workers at the most
   * @param {boolean} isLong whether a question that nobody waits for any more stops its worker
   */
  constructor(most, isLong) {
    this.most = most;
    this.isLong = isLong;
    /** @type {Job[]} */
    this.waiting = [];
    /** @type {Map<Worker, Job | undefined>} */
    this.workers = new Map();
  }

  /**
   * Asks a worker.
   * @param {Task} task
   * @param {AbortSignal} signal
   * @param {(report: Report) => void} take
   * @returns {Promise<void>}
   */
  ask(task, signal, take) {
    return new Promise((done, failed) => {
      /** @type {Job} */
      const job = { task, take, done, failed };
      signal.addEventListener("abort", () => {
        failed(signal.reason);
        this.leave(job);
      }, { once: true });
      this.waiting.push(job);
      this.next();
    });
  }

  /** Gives the first question that waits to a worker that is free. */
  async next() {
    const module = await compiled.catch((error) => {
      for (const job of this.waiting.splice(0)) job.failed(error);
    });
    if (!module || !this.waiting.length) return;
    const free = [...this.workers].find(([, job]) => !job)?.[0] ?? (this.workers.size < this.most ? this.start(module) : undefined);
    const job = free && this.waiting.shift();
    if (!job) return;
    this.workers.set(free, job);
    free.postMessage(job.task);
  }

  /** @param {WebAssembly.Module} module */
  start(module) {
    const worker = new Worker(new URL("worker.js", import.meta.url), { type: "module" });
    worker.addEventListener("message", (/** @type {MessageEvent<Report>} */ { data }) => this.take(worker, data));
    worker.addEventListener("error", () => {
      this.end(worker, LOST);
      this.next();
    });
    worker.postMessage(module);
    this.workers.set(worker, undefined);
    return worker;
  }

  /**
   * @param {Worker} worker
   * @param {Report} report
   */
  take(worker, report) {
    const job = this.workers.get(worker);
    if (job?.task.id !== report.id) return;
    if (report.end === undefined) {
      try {
        job.take(report);
      } catch (error) {
        job.failed(error);
      }
      return;
    }
    this.workers.set(worker, undefined);
    // What failed is in no state to be asked again.
    if (report.end) this.end(worker, report.end, job);
    job.done();
    this.next();
  }

  /**
   * A worker is not to be asked any more.
   * @param {Worker} worker
   * @param {string} why
   */
  end(worker, why, job = this.workers.get(worker)) {
    this.workers.delete(worker);
    worker.terminate();
    job?.failed(new Error(why));
  }

  /**
   * Nobody waits for a question any more.
   * @param {Job} job
   */
  leave(job) {
    this.waiting = this.waiting.filter((it) => it !== job);
    const worker = [...this.workers].find(([, own]) => own === job)?.[0];
    if (!worker || !this.isLong) return;
    this.end(worker, "");
    // The next one starts while the page rests.
    compiled.then((module) => {
      if (this.workers.size < this.most) this.start(module);
    }, () => {});
    this.next();
  }
}

// What is quick does not wait behind what takes long.
const quick = new Line(1, false);
const long = new Line(Math.max(1, Math.min(MOST, navigator.hardwareConcurrency - 1)), true);

let count = 0;

/** @type {Engine["answer"]} */
export async function answer(name, question, signal, take) {
  const asked = /** @type {{stages?: number[], samples?: number, shown?: boolean}} */ (question);
  const stages = asked.stages ?? [asked.samples ?? 0];
  const perStage = asked.shown || "slide" in question || "figures" in question ? 2 : 1;
  const first = stages.findIndex(Boolean);
  const [plain, all] = [first < 0 ? stages.length : first, stages.length];
  const text = JSON.stringify(question);
  const task = (/** @type {number} */ from, /** @type {number} */ to) => ({ id: (count += 1), name, question: text, from: from * perStage, to: to * perStage });
  if (plain) await quick.ask(task(0, plain), signal, ({ line }) => line && take(line));
  if (plain === all) return;
  await rest(signal);
  let taken = 0;
  await long.ask(task(plain, all), signal, ({ line, begun }) => {
    if (line) {
      taken += 1;
      take(line);
    } else {
      const samples = stages[plain + Math.floor(taken / perStage)] ?? 0;
      take(JSON.stringify({ schema: PROGRESS, what: "samples", done: Math.min(begun ?? 0, samples), all: samples }));
    }
  });
}

/** Lists of other views, which are empty. */
const EMPTY = ["data-sets"];

/** @type {Engine["textOf"]} */
export async function textOf(name) {
  if (EMPTY.includes(name)) return '{"rows": []}';
  let text = "";
  await quick.ask({ id: (count += 1), name, question: "", from: 0, to: 1 }, new AbortController().signal, ({ line }) => (text = line ?? text));
  return text;
}

/**
 * Waits until nothing new was asked for a while.
 * @param {AbortSignal} signal
 */
function rest(signal) {
  return new Promise((done, failed) => {
    const timer = setTimeout(done, REST);
    signal.addEventListener("abort", () => {
      clearTimeout(timer);
      failed(signal.reason);
    }, { once: true });
  });
}
