// The session: what all answers are about. It is kept in the address's fragment, so that a link
// carries it; the token is not in it.

/**
 * @typedef {object} Session
 * @property {string} view
 * @property {string} rover
 * @property {string} soil
 * @property {string} wheel
 * @property {string} model empty for the usual one
 * @property {string} belief `samples` or `nominal`
 * @property {number} slope [°]
 * @property {number} course [°]
 * @property {number} speed of the rims [m/s]
 * @property {number} load [N]
 * @property {number} slip ratio
 * @property {number} angle slip angle [°]
 * @property {Record<string, number>} set keys of documents that have another number
 */

/** @type {Session} */
const USUAL = {
  view: "heading", rover: "hakuto", soil: "toyoura-uncertain", wheel: "hakuto", model: "",
  belief: "samples", slope: 10, course: 0, speed: 0.06, load: 17, slip: 0.2, angle: 0, set: {},
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
 * @param {Session} session
 * @param {string[]} kinds
 */
export function setOf(session, kinds) {
  const entries = Object.entries(session.set);
  return Object.fromEntries(entries.filter(([key]) => kinds.includes(key.split(".")[0] ?? "")));
}
