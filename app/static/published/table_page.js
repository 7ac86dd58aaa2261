/** The page of one published table: how far ours are, what is compared, the figures, and their files. */

import { publishedApi } from "../api/published.js";
import { h, onPress, setAllowed, setText } from "../lib/dom.js";
import { remember, remembered } from "../lib/remembered.js";
import { announce, attempt, report, toast } from "../lib/toasts.js";
import { copiedText, csvText, describing, description, tableLines } from "./figures.js";
import { progressText } from "./table_list.js";
import { figuresTable } from "./table_view.js";

const FOLD = "published-about";
const LOW = "(max-height: 800px)";
const COMPUTE_HELP = "Computes the missing figures of ours, one row after the other";

/**
 * Puts text on the system's clipboard, also where the page has no secure address.
 * @param {string} text
 * @returns {boolean} false where the browser refuses
 */
function copyText(text) {
  const put = (event) => {
    event.clipboardData.setData("text/plain", text);
    event.preventDefault();
  };
  document.addEventListener("copy", put, { capture: true, once: true });
  const isCopied = document.execCommand("copy");
  document.removeEventListener("copy", put, true);
  return isCopied;
}

/** A button to compute ours; while that goes on a bar and Cancel. */
function computePart(id, changed) {
  const [bar, words] = [
    h("i"),
    h("span", { class: "quiet number", role: "status", "aria-label": "Computed" }),
  ];
  const compute = h("button", { class: "primary" });
  const cancel = h("button", { text: "Cancel" });
  const progress = h("div", { class: "progress" }, bar);
  const act = (request) => attempt(async () => changed(await request(id)));
  onPress(compute, act(publishedApi.compute), toast);
  onPress(cancel, act(publishedApi.cancel), toast);
  return {
    element: h("div", { class: "published-compute" }, words, progress, compute, cancel),
    show(line) {
      const { state, done, total } = line;
      const isRunning = state === "running";
      const isWhole = !total || state === "done";
      setText(words, total ? `Ours: ${progressText(line)}` : "");
      bar.style.transform = `scaleX(${done / Math.max(total, 1)})`;
      progress.hidden = cancel.hidden = !isRunning;
      compute.hidden = isRunning || isWhole;
      setText(compute, done ? "Compute the rest" : "Compute ours");
      setAllowed(compute, null, COMPUTE_HELP);
    },
  };
}

/** The sentences about what is compared; folded in a low window until somebody unfolds them. */
function aboutPart() {
  const sentences = h("div");
  const open = remembered(FOLD).open ?? !matchMedia(LOW).matches;
  const summary = h("summary", { text: "What is compared" });
  const element = h("details", { class: "published-about", open }, summary, sentences);
  summary.addEventListener("click", () => remember(FOLD, { open: !element.open }));
  return {
    element,
    show(texts) {
      if (sentences.textContent !== texts.join(""))
        sentences.replaceChildren(...texts.map((text) => h("p", { text })));
    },
  };
}

/** Acts on the whole table. @param {() => Record<string, any>} content */
function filesPart(content) {
  const lines = () => tableLines(content().columns, content().rows);
  const copy = () => {
    if (copyText(copiedText(lines()))) announce("The table is copied.");
    else report(new Error("The browser does not let the page copy. Save the table as CSV instead."));
  };
  const save = () => {
    const address = URL.createObjectURL(new Blob([csvText(lines())], { type: "text/csv" }));
    h("a", { href: address, download: `published-${content().id}.csv` }).click();
    setTimeout(() => URL.revokeObjectURL(address), 1000);
  };
  const help = "with all digits of each figure";
  const button = (text, title, click) => h("button", { class: "link", text, title, on: { click } });
  return h(
    "div",
    { class: "published-files" },
    button("Copy table", `Copies the table for a spreadsheet, ${help}`, copy),
    button("CSV", `Saves the table as a CSV file, ${help}`, save),
  );
}

/**
 * @typedef {import("./figures.js").Column} Column
 * @typedef {import("./figures.js").Row} Row
 * @typedef {{id: string, columns: Column[], rows: Row[]} & Record<string, any>} Content
 */

/**
 * Where the table is printed, and what all its rows share: "T Table A.1, page 85 · Walk, iterations 3".
 * @param {Content} content
 */
function sourceText({ source, columns, rows }) {
  const { shared } = describing(columns, rows);
  return [source, description(rows[0], shared)].filter(Boolean).join(" · ");
}

/**
 * Builds the page of a table.
 * @param {Content} first
 * @param {{back: () => void, toggle: (row: string) => void, changed: () => void,
 *   open: (row: string, source: string, step: string) => Promise<void>}} acts
 * @returns {{element: HTMLElement, fits: (content: Content) => boolean,
 *   show: (content: Content, opened: string) => void}} `fits`: whether the content has the same
 *   columns and rows
 */
export function tablePage(first, acts) {
  const shape = ({ id, columns, rows }) => JSON.stringify([id, columns, rows.map((row) => row.id)]);
  let content = first;
  const compute = computePart(first.id, acts.changed);
  const about = aboutPart();
  const trouble = h("p", { class: "box-note", data: { tone: "bad" } });
  const table = figuresTable(first, acts);
  const signs = h("p", {
    class: "quiet published-signs",
    text: "▲ ours is better than the published figure, ▼ ours is worse.",
  });
  const element = h(
    "div",
    { class: "published-table" },
    h("button", { class: "link published-back", text: "All tables", on: { click: acts.back } }),
    h(
      "header",
      {},
      h(
        "div",
        {},
        h("h3", { text: `${first.name}  ${first.title}` }),
        h("p", { class: "quiet", text: sourceText(first) }),
      ),
      compute.element,
    ),
    about.element,
    trouble,
    table.element,
    h(
      "div",
      { class: "published-foot" },
      signs,
      filesPart(() => content),
    ),
  );
  return {
    element,
    fits: (next) => shape(next) === shape(content),
    show(next, opened) {
      content = next;
      compute.show(next);
      about.show(next.about);
      trouble.hidden = !next.sentence;
      setText(trouble, next.sentence);
      signs.hidden = !next.columns.some(({ better }) => better);
      table.show(next.rows, opened);
    },
  };
}
