// The session: what all answers are about. It is kept in the address's fragment, so that a link
// carries it; the token is not in it.

/**
 * @typedef {object} Session
 * @property {string} view
 * @property {string} rover
 * @property {string} soil
 * @property {string} wheel empty for the rover's
 * @property {string} model empty for the usual one
 * @property {string} belief `samples` or `nominal`
 * @property {number} slope [°]
 * @property {number} course [°]
 * @property {number} speed of the rims [m/s]
 * @property {number} load [N]
 * @property {number} slip ratio
 * @property {number} angle slip angle [°]
 * @property {number} yaw at the start of a run [°]
 * @property {number} duration of a run [s]
 * @property {string} ground a map of heights that is driven on, empty for a plane
 * @property {string} dem the map of heights
 * @property {string} layer of the map
 * @property {string} which course: `fixed`, `best` or `worst`
 * @property {string} at the place that is looked at, as x,y [m]
 * @property {string} from the start of a way
 * @property {string} to its goal
 * @property {string} least what the way has least of
 * @property {string} keepout a file of areas
 * @property {string} design
 * @property {string} trade two measures, with a comma between
 * @property {string} campaign
 * @property {number} runs of it, 0 for those of its document
 * @property {string} out its folder
 * @property {string} data measured wheel tests
 * @property {string} log of a drive
 * @property {string} fit keys of the soil, with commas between
 * @property {string} where conditions on rows, with semicolons between
 * @property {string} without lines of measured trials that are left out, with commas between
 * @property {string} mission that is driven, empty for one heading
 * @property {string} seen how a drive is shown: `plan` or `scene`
 * @property {string} legs of it as JSON, empty for its own
 * @property {string} added keys of its limits that are none of its own, with commas between
 * @property {Record<string, number>} set keys of documents that have another number
 */

/** @type {Session} */
const USUAL = {
  view: "heading", rover: "hakuto", soil: "toyoura-uncertain", wheel: "", model: "",
  belief: "samples", slope: 10, course: 0, speed: 0.06, load: 17, slip: 0.2, angle: 0,
  yaw: 0, duration: 20, ground: "", dem: "", layer: "verdict", which: "fixed", at: "", from: "", to: "", least: "time", keepout: "",
  design: "design-lighter-wheels", trade: "",
  campaign: "campaign-wheel-test", runs: 0, out: "campaign",
  mission: "", legs: "", added: "", seen: "plan", log: "", data: "", fit: "soil.shear.longitudinal_m", where: "", without: "",
  set: {},
};

/**
 * @param {string} text as in a fragment
 * @returns {Session}
 */
export function parse(text) {
  /** @type {any} */
  const session = structuredClone(USUAL);
  for (const [key, value] of new URLSearchParams(text)) {
    const number = Number(value);
    if (key.startsWith("set.")) {
      if (Number.isFinite(number)) session.set[key.slice(4)] = number;
    } else if (!Object.hasOwn(USUAL, key) || key === "set") {
      continue;
    } else if (typeof session[key] === "number") {
      if (Number.isFinite(number)) session[key] = number;
    } else {
      session[key] = value;
    }
  }
  return session;
}

/**
 * @param {Session} session
 * @returns {string}
 */
export function text(session) {
  const words = new URLSearchParams();
  for (const [key, value] of Object.entries(session)) {
    if (key === "set") continue;
    if (value !== /** @type {any} */ (USUAL)[key]) words.set(key, String(value));
  }
  for (const [key, value] of Object.entries(session.set)) words.set(`set.${key}`, String(value));
  return words.toString();
}

/** The session and the pinned ones, as the address has them. */
export function fromAddress() {
  const [own, ...pinned] = location.hash.slice(1).split("|").map(parse);
  return { own: own ?? parse(""), pinned };
}

/**
 * Keeps the session and the pinned ones in the address, without the token.
 * @param {Session} own
 * @param {Session[]} pinned
 */
export function toAddress(own, pinned) {
  history.replaceState(null, "", `${location.pathname}#${[own, ...pinned].map(text).join("|")}`);
}

/**
 * The numbers that are set in documents of some kinds.
 * @param {{set: Record<string, number>}} session
 * @param {string[]} kinds
 */
export function setOf(session, kinds) {
  const entries = Object.entries(session.set);
  return Object.fromEntries(entries.filter(([key]) => kinds.includes(key.split(".")[0] ?? "")));
}
