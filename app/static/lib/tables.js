/** Tables of figures, with a caption and column headings. */

import { h } from "./dom.js";

/**
 * A row's name, and the foot, counted from 1, that gives it its colour.
 * @typedef {{text: string, foot?: number|null}} RowName
 */

/**
 * The heads of columns; over what has none stands an empty cell, which is no heading.
 * @param {string[]} texts
 */
export const columnHeads = (texts) => texts.map((text) => (text ? h("th", { scope: "col", text }) : h("td")));

/**
 * Builds a table from finished rows.
 * @param {Record<string, any>} attributes
 * @param {string} caption
 * @param {string[]} head
 * @param {HTMLTableRowElement[]} rows
 */
export const captionedTable = (attributes, caption, head, rows) =>
  h(
    "table",
    attributes,
    h("caption", { text: caption }),
    h("thead", {}, h("tr", {}, ...columnHeads(head))),
    h("tbody", {}, ...rows),
  );

/**
 * What a foot's row is called; `foot` counts from 0.
 * @param {number} foot
 */
export const footName = (foot) => ({ text: `foot ${foot + 1}`, foot: foot + 1 });

/** @param {[RowName, ...any[]]} row */
function figureRow([{ text, foot }, ...values]) {
  return h(
    "tr",
    { data: foot ? { foot } : {} },
    h("th", { scope: "row" }, foot ? h("i", { class: "foot-dot", "aria-hidden": "true" }) : null, text),
    ...values.map((value) => h("td", { text: value })),
  );
}

/**
 * Builds a table of figures; each row begins with its name.
 * @param {string} caption
 * @param {string|null} help
 * @param {string[]} head
 * @param {[RowName, ...any[]][]} rows
 */
export const figureTable = (caption, help, head, rows) =>
  captionedTable({ class: "run-table", title: help }, caption, head, rows.map(figureRow));
