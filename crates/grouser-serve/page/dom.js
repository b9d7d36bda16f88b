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
 * A cell of a table: numbers with four digits, and names in words.
 * @param {any} value
 * @param {Record<string, string>} [words]
 */
function cell(value, words) {
  if (typeof value === "string" && words && Object.hasOwn(words, value)) return words[value] ?? value;
  return typeof value === "number" || value === null || value === undefined ? four(value) : Array.isArray(value) ? value.join(", ") : String(value);
}

/**
 * Rows as a table, each column with its label, which has its unit, or else with its name.
 * @param {{caption: string, columns: string[], labels?: string[], words?: Record<string, string>, rows: Record<string, any>[]}} table
 */
export function tableOf({ caption, columns, labels, words, rows }) {
  const side = (/** @type {string} */ name) => typeof rows[0]?.[name] === "string" ? { class: "text" } : {};
  const named = (/** @type {any} */ value) => words && Object.hasOwn(words, value) ? { title: value } : {};
  return element("div", { class: "wide", tabindex: 0, role: "group", "aria-label": caption }, [element("table", {}, [
    element("caption", {}, [caption]),
    element("thead", {}, [element("tr", {}, columns.map((name, place) => element("th", { scope: "col", title: name, ...side(name) }, [labels?.[place] ?? name])))]),
    element("tbody", {}, rows.map((row) => element("tr", {}, columns.map((name) => element("td", { "data-column": name, ...named(row[name]), ...side(name) }, [cell(row[name], words)]))))),
  ])]);
}

/**
 * The engine's pictures. As images they can run nothing, whatever is written in them.
 * @param {{caption: string, svg: string, is_wide?: boolean}[]} all
 */
export function picturesOf(all) {
  return all.map(({ caption, svg: content, is_wide: isWide }) => {
    const image = element("img", { src: URL.createObjectURL(new Blob([content], { type: "image/svg+xml" })), alt: caption });
    image.addEventListener("load", () => URL.revokeObjectURL(image.getAttribute("src") ?? ""));
    return element("figure", isWide ? { class: "across" } : {}, [image, element("figcaption", {}, [caption])]);
  });
}

/**
 * Offers a text, or bytes, as a file.
 * @param {string} name
 * @param {string | Uint8Array<ArrayBuffer>} content
 */
export function save(name, content) {
  const type = typeof content === "string" ? "text/plain" : "application/octet-stream";
  const url = URL.createObjectURL(new Blob([content], { type }));
  const link = element("a", { href: url, download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(url), 1000);
}
