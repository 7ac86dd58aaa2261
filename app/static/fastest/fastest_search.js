/** The search over all foot orders: its button, progress, table and front. */

import { api } from "../api/gaits.js";
import { fastestApi } from "../api/fastest.js";
import { h, onPress, setAllowed, setText } from "../lib/dom.js";
import { fixed, mm } from "../lib/format.js";
import { announce, attempt } from "../lib/toasts.js";
import { frontPlot, pointText } from "./fastest_front.js";
import { degrees, headingText, orderText, paceText, priceOf } from "./fastest_words.js";

const OPEN = ["queued", "running", "cancelling"];
const WITH_FRONT = "Also try other margins and stop bounds (some minutes)";

const byPace = (one, other) => (priceOf(other).pace ?? -1) - (priceOf(one).pace ?? -1);

function tableRow(one, nameOf, use) {
  const { order, overlap, heading, margin, stop_bound: bound, step, turn, moves } = one;
  const price = priceOf(one);
  const words = [h("td", { title: `Feet ${order.join("-")}` }, `${orderText({ order, overlap }, nameOf(order))}, ${headingText(heading)}`),
    h("td", { class: "number", text: `${mm(margin, 0)} mm` }), h("td", { class: "number", text: `${fixed(bound, 1)} s` }),
    h("td", { class: "number" }, h("b", { text: paceText(price) }))];
  if (price.pace === null) return h("tr", { title: one.explanation?.[0] }, ...words, h("td"), h("td"), h("td"));
  return h("tr", {}, ...words, h("td", { class: "number", text: price.on_the_spot ? `${degrees(turn, 1)}°` : `${mm(step)} mm` }), h("td", { class: "number", text: String(moves) }),
    h("td", {}, h("button", { type: "button", class: "link", text: "Choose", "aria-label": `Choose ${pointText(one, nameOf)}`, on: { click: () => use(one) } })));
}

function table(tried, nameOf, use) {
  const heads = ["Foot order", "Margin", "Stop bound", "In mid-walk", "A cycle", "Moves", ""];
  return h("table", { class: "fast-table", "aria-label": "Gaits that were tried" },
    h("thead", {}, h("tr", {}, ...heads.map((text, place) => h("th", { class: place && "number", text })))),
    h("tbody", {}, ...[...tried].sort(byPace).map((one) => tableRow(one, nameOf, use))));
}

/** The newest search of a robot. */
const newest = ({ jobs }, robot) => jobs.find((job) => job.kind === "fastest" && job.question?.robot === robot) ?? null;

/**
 * Builds the search.
 * @param {object} store
 * @param {{question: () => object, nameOf: Function, use: (one: object, question: object) => void}} page `use` takes a tried gait into the question
 */
export function searchPart(store, { question, nameOf, use }) {
  const front = h("input", { type: "checkbox" });
  const start = h("button", { type: "button", text: "Search all foot orders" });
  const [bar, words] = [h("i"), h("p", { class: "quiet", role: "status", "aria-label": "Search" })];
  const cancel = h("button", { type: "button", text: "Cancel search" });
  const progress = h("div", { class: "simulating", hidden: true }, h("div", { class: "progress" }, bar), cancel);
  const found = h("div", { class: "fast-found" });
  const error = h("p", { class: "field-error", role: "alert", hidden: true });
  const element = h("section", { class: "fast-search", "aria-label": "Search" },
    h("div", { class: "fast-start" }, start, h("label", {}, front, WITH_FRONT)), error, progress, words, found);
  let [shown, job] = [null, null];

  onPress(start, async () => {
    error.hidden = true;
    try {
      await fastestApi.search(question(), front.checked);
    } catch ({ message }) {
      setText(error, message);
      error.hidden = false;
    }
  });
  cancel.addEventListener("click", attempt(() => api.cancelJob(job.id)));

  function showFound({ tried, result, question: asked }) {
    const choose = (one) => use(one, asked);
    const parts = [];
    if (result?.front.length) parts.push(frontPlot(result.front, tried, nameOf, choose));
    // With a front the table would be long: it holds the choices at the margin and the stop bound that were asked.
    const listed = result?.tried ?? tried;
    if (listed.length) parts.push(table(listed, nameOf, choose));
    found.replaceChildren(...parts);
  }

  function show(state) {
    job = newest(state, question().robot);
    const isOn = Boolean(job) && OPEN.includes(job.state);
    progress.hidden = !isOn;
    setAllowed(start, isOn ? "A search is on. Wait for it, or cancel it." : null, "Tries every foot order and direction with the values above");
    bar.style.transform = `scaleX(${job?.share ?? 0})`;
    setText(words, job ? sentenceOf(job, isOn) : "");
    const about = job && `${job.id} ${job.state} ${job.tried?.length}`;
    if (about === shown) return;
    if (shown?.startsWith(job?.id) && !isOn) announce(words.textContent);
    shown = about;
    if (job) showFound(job);
    else found.replaceChildren();
  }

  return { element, show };
}

function sentenceOf({ state, sentence, tried = [], result }, isOn) {
  const best = [...tried].sort(byPace)[0];
  const fastest = best && best.speed !== null ? ` The fastest${isOn ? " yet" : ""}: ${paceText(priceOf(best))}.` : "";
  if (isOn) return state === "cancelling" ? sentence : `${sentence}${fastest}`;
  if (state !== "done") return `The last search: ${sentence}${fastest}`;
  const scope = result.complete ? "every foot order" : `some of ${result.orders} foot orders`;
  return `Tried ${scope}, ${tried.length} gaits.${fastest}`;
}
