/** The search over all foot orders: its button, progress, table and front. */

import { api } from "../api/gaits.js";
import { fastestApi } from "../api/fastest.js";
import { h, onPress, setAllowed, setText } from "../lib/dom.js";
import { fixed, mm } from "../lib/format.js";
import { attempt } from "../lib/toasts.js";
import { jobIsOn } from "../shell/job_list.js";
import { frontPlot, pointText } from "./fastest_front.js";
import { choiceText, degrees, priceOf, searchedText, speedText } from "./fastest_words.js";

const WITH_FRONT = "Also try other stability margins and stop bounds (takes some minutes)";
const HEADS = ["Foot order", "Margin", "Stop bound", "In mid-walk", "A cycle", "Moves", ""];
const SAME = 1e-9;

const paceOf = (one) => priceOf(one).pace ?? -1;
const keyOf = ({ order, heading, overlap, margin, stop_bound: bound }) =>
  JSON.stringify([order, heading, overlap, margin, bound]);

function tableRow(one, nameOf, use) {
  const price = priceOf(one);
  const cells = [
    h("td", {
      title: `Feet ${one.order.join("-")}`,
      text: choiceText(one, nameOf(one.order), one.on_the_spot),
    }),
    ...[`${mm(one.margin, 0)} mm`, `${fixed(one.stop_bound, 1)} s`].map((text) =>
      h("td", { class: "number", text }),
    ),
    h("td", { class: "number" }, h("b", { text: speedText(price) })),
  ];
  if (price.pace === null)
    return h("tr", { title: one.explanation?.join(" ") }, ...cells, h("td"), h("td"), h("td"));
  const choose = h("button", {
    type: "button",
    class: "link",
    text: "Choose",
    "aria-label": `Choose ${pointText(one, nameOf)}`,
    on: { click: () => use(one) },
  });
  const cycle = one.on_the_spot ? `${degrees(one.turn, 1)}°` : `${mm(one.step)} mm`;
  return h(
    "tr",
    {},
    ...cells,
    h("td", { class: "number", text: cycle }),
    h("td", { class: "number", text: String(one.moves) }),
    h("td", {}, choose),
  );
}

/** The table; rows that stand in it stay where they are while others come between them. */
function triedTable(nameOf, use) {
  const body = h("tbody");
  const element = h(
    "table",
    { class: "fast-table", "aria-label": "Gaits that were tried", hidden: true },
    h(
      "thead",
      {},
      h("tr", {}, ...HEADS.map((text, place) => h(text ? "th" : "td", { class: place && "number", text }))),
    ),
    body,
  );
  let rows = new Map();
  return {
    element,
    show(tried) {
      const sorted = [...tried].sort((one, other) => paceOf(other) - paceOf(one));
      const shown = new Map(
        sorted.map((one) => [keyOf(one), rows.get(keyOf(one)) ?? tableRow(one, nameOf, use)]),
      );
      for (const [key, row] of rows) if (!shown.has(key)) row.remove();
      rows = shown;
      [...shown.values()].forEach((row, place) => {
        if (body.children[place] !== row) body.insertBefore(row, body.children[place] ?? null);
      });
      element.hidden = !sorted.length;
    },
    /** Makes every row anew: foot orders have other names now. */
    rename(tried) {
      this.show([]);
      this.show(tried);
    },
  };
}

/** The search that is on, else the picked one, else the newest of a robot. */
function shownJob({ jobs }, robot, picked) {
  const searches = jobs.filter(({ kind }) => kind === "fastest");
  return (
    searches.find(jobIsOn)
    ?? searches.find(({ id }) => id === picked)
    ?? searches.find((one) => one.request.robot === robot)
    ?? null
  );
}

/** What stands in the table: of a search with a front, the gaits at the request's margin and stop bound. */
function listed({ tried = [], request, front, state }) {
  if (!front || state !== "done") return tried;
  const isAsked = (one) =>
    Math.abs(one.margin - request.margin) + Math.abs(one.stop_bound - request.stop_bound) < SAME;
  return tried.filter(isAsked);
}

function sentenceOf(job) {
  const { state, sentence, tried = [], result } = job;
  const best = tried.reduce((fastest, one) => (paceOf(one) > paceOf(fastest) ? one : fastest), {
    speed: null,
  });
  const fastest =
    best.speed === null ? "" : ` Fastest gait${jobIsOn(job) ? " so far" : ""}: ${speedText(priceOf(best))}.`;
  if (state === "cancelling") return sentence;
  if (jobIsOn(job)) return `${sentence}${fastest}`;
  if (state !== "done") return `The last search: ${sentence}${fastest}`;
  const scope = result.complete ? "every foot order" : `only some of the ${result.orders} foot orders`;
  return `The search tried ${scope}. ${sentence}${fastest}`;
}

/** The elements of the search, with its table. */
function build(table) {
  const front = h("input", { type: "checkbox" });
  const start = h("button", { type: "button", text: "Search all foot orders" });
  const [bar, words, searched] = [h("i"), h("p", { class: "quiet fast-state" }), h("p", { class: "quiet" })];
  const cancel = h("button", { type: "button", text: "Cancel search" });
  const progress = h(
    "div",
    { class: "simulating", hidden: true },
    h("div", { class: "progress" }, bar),
    cancel,
  );
  const plot = h("div");
  const error = h("p", { class: "field-error", role: "alert", hidden: true });
  const element = h(
    "section",
    { class: "fast-search", "aria-label": "Search" },
    h("div", { class: "fast-start" }, start, h("label", {}, front, WITH_FRONT)),
    error,
    progress,
    words,
    searched,
    h("div", { class: "fast-found" }, plot, table.element),
  );
  return { element, front, start, bar, words, searched, cancel, progress, plot, error };
}

/** Shows how far a search is, and what it has found. */
function showProgress({ start, cancel, progress, bar, words, searched }, job) {
  const isOn = Boolean(job) && jobIsOn(job);
  setAllowed(
    start,
    isOn ? "A search is running. Wait until the search ends, or cancel the search." : null,
    "Tries every foot order and direction. The search uses the other values that you have chosen above",
  );
  // What has the focus is not taken away with it.
  if (!isOn && document.activeElement === cancel) start.focus();
  progress.hidden = !isOn;
  bar.style.transform = `scaleX(${job?.share ?? 0})`;
  setText(words, job ? sentenceOf(job) : "");
  setText(searched, job?.tried?.length ? `Searched with: ${searchedText(job.request)}.` : "");
}

/**
 * Builds the search.
 * @param {import("../state/store.js").Store} store
 * @param {object} page
 * @param {() => Record<string, any>} page.request
 * @param {(order: number[]) => string|null} page.nameOf
 * @param {(request: Record<string, any>) => void} page.use takes a gait of table or front as the new request
 */
export function searchPart(store, { request, nameOf, use }) {
  let [job, picked, drawn] = [null, null, null];
  const take = ({ order, heading, overlap, margin, stop_bound: bound }) =>
    use({ ...job.request, order, heading, overlap, margin, stop_bound: bound });
  const table = triedTable(nameOf, take);
  const parts = build(table);
  const { element, front, start, cancel, plot, error } = parts;

  onPress(start, async () => {
    error.hidden = true;
    try {
      await fastestApi.search(request(), front.checked);
      element.scrollIntoView({ block: "start" });
    } catch ({ message }) {
      setText(error, message);
      error.hidden = false;
    }
  });
  cancel.addEventListener(
    "click",
    attempt(() => api.cancelJob(job.id)),
  );

  function showFront({ id, result, tried }) {
    const about = result?.front.length ? id : null;
    if (about === drawn) return;
    drawn = about;
    plot.replaceChildren(...(about ? [frontPlot(result.front, tried, nameOf, take)] : []));
  }

  function show(state) {
    const before = job?.id;
    job = shownJob(state, request().robot, picked);
    showProgress(parts, job);
    if (job?.id !== before) table.show([]);
    if (job) table.show(listed(job));
    showFront(job ?? {});
  }

  return {
    element,
    show,
    rename() {
      drawn = null;
      if (job) table.rename(listed(job));
      showFront(job ?? {});
    },
    pick(id) {
      picked = id;
    },
  };
}
