// Makes elements. Texts become text nodes: what a document calls itself is never markup.

/**
 * @param {string} name
 * @param {Record<string, any>} [attributes]
 * @param {(Node | string | null | undefined)[]} [children]
 */
export function element(name, attributes = {}, children = []) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (key.startsWith("on")) made.addEventListener(key.slice(2), value);
    else if (value === true) made.setAttribute(key, "");
    else if (value !== false && value !== undefined) made.setAttribute(key, String(value));
  }
  made.append(...children.filter((child) => child !== null && child !== undefined));
  return made;
}

const NAMES = "http://www.w3.org/2000/svg";

/**
 * A shape.
 * @param {string} name
 * @param {Record<string, string | number>} [attributes]
 * @param {(Node | string)[]} [children]
 */
export function svg(name, attributes = {}, children = []) {
  const made = document.createElementNS(NAMES, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, String(value));
  made.append(...children);
  return /** @type {SVGElement} */ (made);
}

/**
 * The element of an id.
 * @param {string} id
 * @returns {any}
 */
export function byId(id) {
  return document.getElementById(id);
}

/**
 * A number as the program's tables have it: four digits.
 * @param {number | null | undefined} value
 */
export function four(value) {
  if (value === null || value === undefined) return "–";
  return String(Number(value.toPrecision(4)));
}

/**
 * Offers a text as a file.
 * @param {string} name
 * @param {string} content
 */
export function save(name, content) {
  const url = URL.createObjectURL(new Blob([content], { type: "text/plain" }));
  const link = element("a", { href: url, download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(url), 1000);
}
