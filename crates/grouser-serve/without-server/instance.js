// The engine as WebAssembly, in a browser or in node: a question goes in as text, lines come out.

/**
 * What is done with an answer on its way.
 * @typedef {object} Watch
 * @property {(line: string) => boolean} take takes a line; whether to go on after it
 * @property {() => boolean} goOn whether to go on: asked before each sample
 */

/** @typedef {(name: string, question: string, watched: Watch) => void} Ask */

/** @typedef {{memory: WebAssembly.Memory, room: (bytes: number) => number, ask: (name: number) => void, _initialize?: () => void}} Exports */

/** The error of a system that has no such file. */
const NO_FILE = 8;
/** The error of one that has no threads. */
const NO_THREADS = 58;

/**
 * An engine, which answers one question after another. Where asking throws, the engine has failed, and
 * is not to be asked again.
 * @param {WebAssembly.Module} module
 * @returns {Promise<Ask>}
 */
export async function engineOf(module) {
  /** @type {Watch | undefined} */
  let watch;
  const [encoder, decoder] = [new TextEncoder(), new TextDecoder()];
  /** @type {(start: number, bytes: number) => Uint8Array} */
  const memory = (start, bytes) => new Uint8Array(exports.memory.buffer, start, bytes);
  // The engine is compiled for WASI, and asks little of a system. It has no files and no variables; chance
  // is asked for by hash tables alone, whose order nothing depends on.
  /** @type {Record<string, Record<string, (...numbers: any[]) => number>>} */
  const imports = {
    wasi_snapshot_preview1: {
      clock_time_get: (_clock, _precision, /** @type {number} */ place) => {
        const now = BigInt(Math.round(performance.now() * 1e6));
        new DataView(exports.memory.buffer).setBigUint64(place, now, true);
        return 0;
      },
      environ_sizes_get: (/** @type {number} */ count, /** @type {number} */ bytes) => {
        memory(count, 4).fill(0);
        memory(bytes, 4).fill(0);
        return 0;
      },
      environ_get: () => 0,
      random_get: () => 0,
      proc_exit: (/** @type {number} */ code) => {
        throw new Error(`the engine ended, ${code}`);
      },
    },
    env: { pthread_create: () => NO_THREADS },
    page: {
      take: (/** @type {number} */ start, /** @type {number} */ bytes) => Number(watch?.take(decoder.decode(memory(start, bytes)))),
      go_on: () => Number(watch?.goOn()),
    },
  };
  for (const { module: from, name } of WebAssembly.Module.imports(module)) {
    (imports[from] ??= {})[name] ??= () => from === "env" ? 0 : NO_FILE;
  }
  const instance = await WebAssembly.instantiate(module, imports);
  const exports = /** @type {Exports} */ (/** @type {unknown} */ (instance.exports));
  exports._initialize?.();
  // The name of a question, or of a list.
  return (name, question, watched) => {
    const [head, body] = [encoder.encode(name), encoder.encode(question)];
    const start = exports.room(head.length + body.length);
    memory(start, head.length).set(head);
    memory(start + head.length, body.length).set(body);
    watch = watched;
    exports.ask(head.length);
  };
}
