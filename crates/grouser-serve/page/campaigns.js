// The sixth view: campaigns, many runs over what is uncertain, in folders of the folder.

import { Asking, list } from "./api.js";
import { byId, element, picturesOf, tableOf } from "./dom.js";
import { exportOf } from "./heading.js";
import { setOf } from "./session.js";
import { Study } from "./study.js";

/** @typedef {import("./session.js").Session} Session */
/** @typedef {import("./api.js").Line} Line */
/** @typedef {import("./api.js").Row} Row */

/**
 * What is asked of a campaign, whatever the question.
 * @param {Session} session
 */
export function about({ campaign, set, runs }) {
  return { campaign, set: { ...setOf({ set }, ["campaign"]), ...(runs ? { "campaign.runs": runs } : {}) } };
}

/** The campaigns of the folder, one of which may be computed or looked at. */
export class CampaignAnswer {
  /**
   * @param {(error: Error | undefined) => void} ended
   * @param {() => void} started
   */
  constructor(ended, started) {
    this.ended = ended;
    this.started = started;
    this.words = "no campaign is looked at";
    /** @type {string | undefined} the picture for a slide */
    this.slide = undefined;
    this.study = new Study("Start the campaign", () => this.start(), () => {
      this.ended(undefined);
      this.study.words.textContent += "; runs of a part that was not finished are computed again";
      // What is computed is there.
      setTimeout(() => this.listed(), 500);
    });
    this.asking = new Asking();
    this.folders = element("div", { id: "campaigns", class: "wide", tabindex: 0, role: "group", "aria-label": "Campaigns of the folder" });
    this.body = element("div");
    this.element = element("div", {}, [this.study.element, this.folders, this.body]);
  }

  /** @param {Session} session */
  ask(session) {
    this.session = session;
    this.listed();
  }

  /** Lists the campaigns that are there. */
  async listed() {
    try {
      this.show(await list("campaigns"));
      this.ended(undefined);
    } catch (error) {
      this.ended(/** @type {Error} */ (error));
    }
  }

  /** @param {Row[]} rows */
  show(rows) {
    const button = (/** @type {string} */ text, /** @type {Row} */ row, /** @type {() => void} */ act) =>
      element("button", { type: "button", "aria-label": `${text} ${row["out"]}`, onclick: act }, [text]);
    this.folders.replaceChildren(element("table", {}, [
      element("caption", {}, [rows.length ? "Campaigns of the folder" : "There are no campaigns in the folder yet."]),
      ...(rows.length ? [element("thead", {}, [element("tr", {}, ["folder", "study", "runs", ""].map((it) => it ? element("th", { scope: "col", ...(it === "runs" ? {} : { class: "text" }) }, [it]) : element("td")))])] : []),
      element("tbody", {}, rows.map((row) => element("tr", { "data-campaign": row["out"] }, [
        element("th", { scope: "row" }, [row["out"]]), element("td", { class: "text" }, [row["name"]]),
        element("td", {}, [row["is_finished"] ? `${row["runs"]}, finished` : `${row["done"]} of ${row["runs"]}`]),
        element("td", {}, [
          ...(row["is_finished"] ? [] : [button("Go on", row, () => this.run({ out: row["out"] }))]),
          ...(row["done"] ? [" ", button("Look", row, () => this.look(row["out"]))] : []),
        ]),
      ]))),
    ]));
  }

  start() {
    const { session } = this;
    const fields = ["campaign.runs", "out"].map(byId);
    if (session && fields.every((field) => field?.reportValidity() ?? true)) this.run({ ...about(session), out: session.out });
  }

  /** @param {object} question */
  run(question) {
    this.started();
    this.asking.stop();
    this.study.run("campaign", question, (line) => this.take(line), (error) => this.listed().then(() => this.ended(error)));
  }

  /** @param {string} out */
  look(out) {
    this.started();
    this.asking.ask("campaign-summary", { out }, (line) => this.take(line), (error) => this.ended(error));
  }

  /** @param {Line} line */
  take(line) {
    if (line.schema !== "grouser.shown.v1") return;
    this.slide = line.slide;
    this.words = line.sentences?.[0] ?? "";
    this.body.replaceChildren(
      element("p", { class: "found", id: "found" }, [this.words]),
      ...(line.tables ?? []).map(tableOf),
      element("div", { class: "figures" }, picturesOf(line.figures ?? [])),
      exportOf(line, undefined),
    );
  }

  stop() {
    this.study.stop();
    this.asking.stop();
  }

  said() {
    return this.words.split(",")[0] ?? "";
  }
}
