/** The list of published tables: the name and title of each, and how many of its rows are computed. */

import { h, setAttribute, setText } from "../lib/dom.js";
import { oneTabStop } from "../lib/tab_stop.js";

/** @typedef {{id: string, name: string, title: string, source: string, state: string, done: number,
 *   total: number, sentence: string}} TableLine */

const WORDS = { running: "computing", failed: "failed" };

/** How far a table is, in a few words. @param {TableLine} line */
export function progressText({ state, done, total }) {
  if (!total) return "";
  return [`${done} of ${total}`, WORDS[state]].filter(Boolean).join(", ");
}

function tableButton({ id }, open) {
  const [name, progress, title] = [h("b"), h("span", { class: "quiet" }), h("span", { class: "quiet" })];
  const button = h(
    "button",
    { class: "run-row", on: { click: () => open(id) } },
    h("span", { class: "run-line" }, name, progress),
    title,
  );
  return {
    element: h("li", {}, button),
    /** @param {TableLine} line */
    show(line, isChosen) {
      setText(name, line.name);
      setText(title, line.title);
      setText(progress, progressText(line));
      setAttribute(progress, "data-state", line.state);
      setAttribute(button, "title", [line.source, line.sentence].filter(Boolean).join(". "));
      setAttribute(button, "aria-current", isChosen ? "true" : null);
    },
  };
}

/**
 * Builds the list.
 * @param {(id: string) => void} open
 * @returns {{element: HTMLElement, show: (lines: TableLine[], chosen: string|null) => void}}
 */
export function tableList(open) {
  const element = h("ul", { class: "run-list", role: "list", "aria-label": "Published tables" });
  /** @type {Map<string, ReturnType<typeof tableButton>>} */
  const known = new Map();
  oneTabStop(element);
  return {
    element,
    show(lines, chosen) {
      for (const line of lines) {
        if (!known.has(line.id)) known.set(line.id, tableButton(line, open));
        const button = known.get(line.id);
        button.show(line, line.id === chosen);
        if (!button.element.isConnected) element.append(button.element);
      }
    },
  };
}
