/** One published table: its sentences, the figures side by side, and the acts of the row that is open. */

import { h, setAttribute, setText } from "../lib/dom.js";
import { capital } from "../lib/format.js";
import { oneTabStop } from "../lib/tab_stop.js";
import { cellText, columnGroups, comparison, describing, description, nameHead } from "./figures.js";
import { rowDetail } from "./row_detail.js";

const SIGNS = { better: "▲", worse: "▼" };
const MEANING = {
  better: "Ours is better than the published figure",
  worse: "Ours is worse than the published figure",
};
const STATES = { running: "computing…", failed: "failed" };

/** A head with its unit: "Feet, mm". */
const headText = (text, unit) => [text, unit && h("span", { class: "unit", text: `, ${unit}` })];

/** Heads in two lines: the quantities, and the origins of their figures. */
function heads(columns, names) {
  const groups = columnGroups(columns);
  const upper = groups.map(({ quantity, unit, columns: members }) =>
    h(
      "th",
      { scope: "colgroup", colspan: members.length, class: "begins" },
      ...headText(capital(quantity), unit),
    ),
  );
  const lower = groups.flatMap(({ unit, columns: members }) =>
    members.map((column, place) =>
      h(
        "th",
        { scope: "col", class: place ? null : "begins", data: { who: column.who } },
        ...headText(column.origin, unit ? "" : column.unit),
      ),
    ),
  );
  const name = h("th", { scope: "col", rowspan: 2, text: capital(nameHead(names)) });
  return h("thead", {}, h("tr", {}, name, ...upper), h("tr", {}, ...lower));
}

function figureCell(row, column, columns) {
  const text = cellText(row, column);
  const compared = comparison(row, column, columns);
  const isWord = typeof row.cells[column.key] === "string";
  return h(
    "td",
    { class: isWord ? "word" : null, data: { who: column.who }, title: compared && MEANING[compared] },
    compared
      && h("span", { class: "sign", "aria-hidden": "true", data: { compared }, text: SIGNS[compared] }),
    text,
    compared && h("span", { class: "hidden-text", text: `, ${compared}` }),
  );
}

/** A row and the line below it with its acts. */
function tableRow({ table, columns, names, toggle, open }, { id }) {
  const figures = columns.filter(({ who }) => who);
  const [name, state] = [h("span"), h("small", { class: "quiet" })];
  const remark = h("small", { class: "quiet remark" });
  const button = h("button", { class: "plain", "aria-expanded": "false" }, name);
  const head = h("th", { scope: "row" }, button, state, remark);
  const element = h("tr", { data: { row: id } }, head);
  const below = h("td", {});
  const line = h("tr", { class: "published-below", hidden: true }, below);
  button.addEventListener("click", () => toggle(id));
  element.addEventListener("click", ({ target }) => {
    const isMarked = !document.getSelection().isCollapsed;
    if (!isMarked && !button.contains(/** @type {Node} */ (target))) toggle(id);
  });
  let shown = "";
  return {
    elements: [element, line],
    button,
    /** @param {import("./figures.js").Row} row */
    show(row, isOpen) {
      const words = description(row, names);
      setText(name, words);
      setText(state, STATES[row.state] ?? "");
      setText(remark, row.sentence);
      setAttribute(element, "data-state", row.state);
      setAttribute(button, "aria-expanded", String(isOpen));
      while (head.nextSibling) head.nextSibling.remove();
      element.append(...figures.map((column) => figureCell(row, column, columns)));
      line.hidden = !isOpen;
      const now = isOpen ? JSON.stringify(row) : "";
      if (now === shown) return;
      shown = now;
      below.colSpan = figures.length + 1;
      below.replaceChildren(...(isOpen ? [rowDetail(table, row, words, open)] : []));
    },
  };
}

/**
 * Builds the table of figures.
 * @param {Record<string, any>} content `id`, `name`, `title`, `columns`, `rows`
 * @param {{toggle: (row: string) => void,
 *   open: (row: string, source: string, step: string) => Promise<void>}} acts
 * @returns {{element: HTMLElement, show: (rows: import("./figures.js").Row[], opened: string|null) => void}}
 */
export function figuresTable({ id, name, title, columns, rows: first }, acts) {
  const { names } = describing(columns, first);
  const body = h("tbody");
  const rows = new Map();
  const element = h(
    "div",
    { class: "published-box", role: "region", "aria-label": `${name}, ${title}`, tabindex: "0" },
    h("table", { class: "published-figures" }, heads(columns, names), body),
  );
  oneTabStop(body, { items: "th > button" });
  return {
    element,
    show(wanted, opened) {
      for (const row of wanted) {
        if (!rows.has(row.id)) {
          rows.set(row.id, tableRow({ table: id, columns, names, ...acts }, row));
          body.append(...rows.get(row.id).elements);
        }
        rows.get(row.id).show(row, row.id === opened);
      }
    },
  };
}
