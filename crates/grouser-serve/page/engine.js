// The engine that answers: here the server that the page is from. A page without a server has another
// module of this name, `without-server/engine.js`.

/** The views that the engine answers; all of them if there is no list. */
export const VIEWS = /** @type {string[] | undefined} */ (undefined);

/** What is said of the views that are not there, the command that has them, and the page about it. */
export const REMARK = /** @type {{text: string, command: string, guide: string} | undefined} */ (undefined);

/** What is said where nothing answers. */
export const LOST = /** @type {string} */ ("The server does not answer: is it still running?");

/**
 * Asks a question; each line of the answer is handed on as it comes.
 * @param {string} name of the question
 * @param {object} question
 * @param {AbortSignal} signal stops the computation, too
 * @param {(line: string) => void} take
 * @returns {Promise<void>}
 */
export async function answer(name, question, signal, take) {
  const response = await fetch(`api/${name}`, {
    method: "POST",
    headers: { "content-type": "application/json" },
    body: JSON.stringify(question),
    signal,
  });
  if (!response.body) throw new Error("there is no answer");
  const reader = response.body.pipeThrough(new TextDecoderStream()).getReader();
  let rest = "";
  for (;;) {
    const { done, value } = await reader.read();
    if (done) break;
    const lines = (rest + value).split("\n");
    rest = lines.pop() ?? "";
    for (const line of lines) if (line) take(line);
  }
  if (rest) take(rest);
}

/**
 * A list of what there is to choose from, as JSON.
 * @param {string} name
 * @returns {Promise<string>}
 */
export async function textOf(name) {
  return (await fetch(`api/${name}`)).text();
}
