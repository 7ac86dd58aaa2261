/** Tables of the page that are selected and copied: no cell of theirs begins a formula in a spreadsheet. */

import { tableCell } from "./table_cell.js";

/**
 * Rows as lines with tabs, and the text around them.
 * @param {HTMLElement} copied
 */
function plainText(copied) {
  for (const row of copied.querySelectorAll("tr"))
    row.replaceWith(`${[...row.cells].map(({ textContent }) => textContent).join("\t")}\n`);
  return copied.textContent;
}

/**
 * Marks the cells that begin a formula; true where there is one.
 * @param {HTMLElement} copied
 */
function markCells(copied) {
  let marked = false;
  for (const cell of copied.querySelectorAll("td, th")) {
    if (tableCell(cell.textContent) === cell.textContent) continue;
    cell.prepend("'");
    marked = true;
  }
  return marked;
}

/**
 * What is selected, as it would be copied; cells of one row in a row of their own.
 * @param {Selection} selection
 */
function contentsOf(selection) {
  const copied = document.createElement("div");
  copied.append(selection.getRangeAt(0).cloneContents());
  if (copied.querySelector(":scope > td, :scope > th")) {
    const row = document.createElement("tr");
    row.append(...copied.childNodes);
    copied.append(row);
  }
  return copied;
}

/** Watches what is copied; where no cell begins a formula, the browser copies by itself. */
export function mountCopiedTables() {
  document.addEventListener("copy", (event) => {
    const selection = getSelection();
    const { clipboardData, defaultPrevented, target } = event;
    if (defaultPrevented || !clipboardData || !selection || selection.isCollapsed) return;
    if (target instanceof Element && target.closest("input, textarea")) return;
    const copied = contentsOf(selection);
    if (!markCells(copied)) return;
    clipboardData.setData(
      "text/html",
      copied.querySelector("table") ? copied.innerHTML : `<table>${copied.innerHTML}</table>`,
    );
    clipboardData.setData("text/plain", plainText(copied));
    event.preventDefault();
  });
}
