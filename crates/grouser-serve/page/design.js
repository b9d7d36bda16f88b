// The fifth view: a design, the numbers of a rover that are the best under limits.

import { element, picturesOf, tableOf } from "./dom.js";
import { exportOf } from "./heading.js";
import { setOf } from "./session.js";
import { Study } from "./study.js";

/** @typedef {import("./session.js").Session} Session */
/** @typedef {import("./api.js").Line} Line */

/**
 * What is asked of a design, whatever the question.
 * @param {Session} session
 */
export function about({ design, set }) {
  return { design, set: setOf({ set }, ["design"]) };
}

/** The answer about a design. */
export class DesignAnswer {
  /**
   * @param {(error: Error | undefined) => void} ended
   * @param {() => void} started
   */
  constructor(ended, started) {
    this.ended = ended;
    /** @type {string | undefined} the picture for a slide */
    this.slide = undefined;
    this.first = "no design is searched yet";
    this.study = new Study("Search the design", () => {
      started();
      this.start();
    }, () => this.ended(undefined));
    this.asking = this.study.asking;
    this.body = element("div", {}, [element("p", { class: "sentence" }, ["The search starts when you ask for it: it takes seconds, and minutes where soils are uncertain or measures are traded."])]);
    this.element = element("div", {}, [this.study.element, this.body]);
  }

  /** @param {Session} session */
  ask(session) {
    // What is shown is of numbers that were moved since.
    if (this.session) this.body.classList.add("old");
    this.session = session;
    this.ended(undefined);
  }

  start() {
    const { session } = this;
    if (!session) return;
    const trade = session.trade.split(",").filter(Boolean);
    const question = { ...about(session), nominal: session.belief === "nominal", trade, shown: true, figures: true, slide: true };
    this.study.run("design", question, (line) => {
      if (line.schema === "grouser.shown.v1") this.take(line);
    }, (error) => {
      if (error) {
        this.first = "no design";
        this.body.replaceChildren(element("p", { class: "error", id: "why-none" }, [error.message]));
      }
      this.ended(error);
    });
  }

  /** @param {Line} line */
  take(line) {
    this.slide = line.slide;
    const [first = "", ...others] = line.sentences ?? [];
    this.first = first;
    this.body.classList.remove("old");
    this.body.replaceChildren(
      element("div", { class: "card" }, [
        element("p", { class: "found", id: "found" }, [first]),
        element("ul", {}, others.filter(Boolean).filter((it) => !it.startsWith("Between ")).map((it) => element("li", {}, [it]))),
      ]),
      ...(line.tables ?? []).map(({ caption, columns, rows }) => tableOf(caption, columns, rows)),
      element("div", { class: "figures" }, picturesOf(line.figures ?? [])),
      exportOf(line, undefined),
    );
  }

  stop() {
    this.study.stop();
  }

  said() {
    return this.first.split(", ")[0] ?? "";
  }
}
