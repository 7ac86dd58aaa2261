/** Tables of figures, with a caption and column headings. */

import { h } from "./dom.js";

/** The heads of columns; over what has none stands an empty cell, which is no heading. */
export const columnHeads = (texts) => texts.map((text) => (text ? h("th", { scope: "col", text }) : h("td")));

/** Builds a table from finished rows. */
export const captionedTable = (attributes, caption, head, rows) =>
  h(
    "table",
    attributes,
    h("caption", { text: caption }),
    h("thead", {}, h("tr", {}, ...columnHeads(head))),
    h("tbody", {}, ...rows),
  );

/** What a foot's row is called; `foot` counts from 0. */
export const footName = (foot) => ({ text: `foot ${foot + 1}`, foot: foot + 1 });

function figureRow([{ text, foot }, ...values]) {
  return h(
    "tr",
    { data: foot ? { foot } : {} },
    h("th", { scope: "row" }, foot && h("i", { class: "foot-dot", "aria-hidden": "true" }), text),
    ...values.map((value) => h("td", { text: value })),
  );
}

/** Builds a table whose rows are `[{text, foot}, ...values]`; `foot`, counted from 1, gives a row its colour. */
export const figureTable = (caption, help, head, rows) =>
  captionedTable({ class: "run-table", title: help }, caption, head, rows.map(figureRow));
