// Asks the engine in node and the program's server the same, and prints which lines differ.
//
// `node … FOLDER PROGRAM`: FOLDER has the page without a server. The last line has the counts.

import { spawn } from "node:child_process";
import { readFileSync } from "node:fs";
import { createInterface } from "node:readline";
import { gzipSync } from "node:zlib";

const [folder, program] = process.argv.slice(1);

/** What is asked: a question with its name and what it is about; a list has no question. */
const ASKED = [
  ["what there is to choose from", "presets"],
  ["the documents of no folder", "documents"],
  ["a heading by the soil as written", "heading", { slope_deg: [0, 5, 10, 20, 30], nominal: true, shown: true }],
  ["a heading with its band", "heading", { soil: "toyoura-uncertain", slope_deg: 10, stages: [0, 20, 200], shown: true, figures: true, slide: true }],
  ["headings over slopes", "heading", { soil: "toyoura-uncertain", slope_deg: [2, 8, 14], set: { "soil.friction_angle_deg": 34 }, nominal: true }],
  ["derivatives of a heading", "heading", { slope_deg: [5, 15], nominal: true, gradients: ["all"] }],
  ["a heading by every model", "heading", { slope_deg: [10], model: "all", nominal: true }],
  ["a heading by crabbing", "heading", { slope_deg: [10], steering: "crab", nominal: true, shown: true }],
  ["a heading under other limits", "heading", { slope_deg: [12], samples: 40, seed: 3, no_go_slip_ratio: 0.5, shown: true }],
  ["a course", "heading-map", { soil: "toyoura-uncertain", slope_deg: 10, course_deg: 25, rim_speed_m_s: 0.05, stages: [0, 40], shown: true }],
  ["a wheel test with its band", "wheel-test", { soil: "toyoura-uncertain", slip_ratio: [-0.3, 0, 0.2, 0.5, 0.9], stages: [0, 40], shown: true, figures: true }],
  ["a wheel test by every model", "wheel-test", { model: "all", slip_angle_deg: [0, 20], gravity_m_s2: "moon" }],
  ["derivatives of a wheel test", "wheel-test", { slip_ratio: 0.2, nominal: true, gradients: ["all"] }],
  ["drawings of a wheel", "wheel-drawing", { load_n: 20, slip_ratio: 0.3, slip_angle_deg: 10 }],
  ["a scenario", "scenario", { rover: "hakuto", soil: "toyoura-uncertain" }],
  ["a stand", "stand", { soil: "toyoura" }],
  ["a soil that there is not", "heading", { soil: "toyora" }],
  ["a path without a folder", "scenario", { soil: "../mine.toml" }],
  ["a key that there is not", "heading", { slopes_deg: [5] }],
  ["a slope beyond the range", "heading", { slope_deg: 95 }],
  ["a number beyond the range", "wheel-test", { set: { "soil.friction_angle_deg": 91 } }],
  ["a number that samples vary", "heading", { soil: "toyoura-uncertain", set: { "soil.friction_angle_deg": 36 }, stages: [0, 20] }],
  ["derivatives with samples", "heading", { soil: "toyoura-uncertain", samples: 20, gradients: ["all"] }],
  ["too many rows", "wheel-test", { slip_ratio: Array.from({ length: 2000 }, () => 0.1), load_n: Array.from({ length: 50 }, () => 9) }],
  ["a wheel that is too heavy to draw", "wheel-drawing", { load_n: 1e9 }],
];

const script = readFileSync(`${folder}/instance.js`, "utf8");
const { engineOf } = await import(`data:text/javascript,${encodeURIComponent(script)}`);
const code = readFileSync(`${folder}/engine.wasm`);
const mb = (bytes) => `${(bytes.length / 1e6).toFixed(2)} MB`;
console.log(`engine.wasm: ${mb(code)}, ${mb(gzipSync(code))} by gzip`);
const ask = await engineOf(await WebAssembly.compile(code));

/** The lines of the engine's answer. */
function byEngine(name, question) {
  const lines = [];
  ask(name, question ? JSON.stringify(question) : "", {
    take: (line) => lines.push(line) > 0,
    goOn: () => true,
  });
  return lines;
}

const server = spawn(program, ["serve", "--no-open"], { stdio: ["ignore", "pipe", "inherit"] });
const address = await new Promise((found) => createInterface(server.stdout).once("line", (line) => found(new URL(line.trim()))));
const [token] = address.searchParams.values();

/** The lines of the program's answer. */
async function byProgram(name, question) {
  const headers = { authorization: `Bearer ${token}`, "content-type": "application/json" };
  const how = question ? { method: "POST", headers, body: JSON.stringify(question) } : { headers };
  const answer = await fetch(new URL(`/api/${name}`, address), how);
  return (await answer.text()).split("\n").filter(Boolean);
}

let [passed, failed] = [0, 0];
try {
  for (const [what, name, question] of ASKED) {
    const start = performance.now();
    const own = byEngine(name, question);
    const middle = performance.now();
    const expected = await byProgram(name, question);
    const end = performance.now();
    const differ = expected.filter((line, place) => line !== own[place]).length + Math.abs(own.length - expected.length);
    const isSame = differ === 0 && own.length > 0;
    [passed, failed] = [passed + isSame, failed + !isSame];
    console.log(`${what}: ${own.length} lines, ${isSame ? "all the same" : `${differ} differ`}; ${(middle - start).toFixed(0)} ms, the program ${(end - middle).toFixed(0)} ms`);
    if (!isSame) console.log(`  engine:  ${own[0]?.slice(0, 300)}\n  program: ${expected[0]?.slice(0, 300)}`);
  }
} finally {
  server.kill();
}
console.log(`${passed} passed, ${failed} failed`);
process.exit(failed ? 1 : 0);
