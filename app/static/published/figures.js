/** Figures of a published table as text: heads of columns, cells, comparisons, and lines of a file. */

import { fixed, lowered } from "../lib/format.js";
import { tableCell } from "../lib/table_cell.js";

/**
 * A column. `who` is "" where it describes the row; else `quantity` and `origin` are its heads.
 * @typedef {{key: string, label: string, unit: string, who: string, quantity: string, origin: string,
 *   decimals: number, better: string}} Column
 * @typedef {{id: string, cells: Record<string, number|string|null>, state: string, sentence: string,
 *   opens: string[], has_plot: boolean}} Row
 */

/**
 * The columns that tell the rows apart, and those that describe all rows alike; the others have figures.
 * @param {Column[]} columns
 * @param {Row[]} rows
 */
export function describing(columns, rows) {
  const all = columns.filter(({ who }) => !who);
  const isShared = ({ key }) => rows.every(({ cells }) => cells[key] === rows[0].cells[key]);
  const apart = all.filter((column) => !isShared(column));
  const names = apart.length ? apart : all.slice(0, 1);
  return { names, shared: all.filter((column) => !names.includes(column)) };
}

/** The head of the rows' names: "Gait, step". @param {Column[]} names */
export const nameHead = (names) =>
  names.map(({ label }, place) => (place ? lowered(label) : label)).join(", ");

/** @type {(row: Row, column: Column) => string} */
function describingWord({ cells }, { key, label, unit }) {
  const value = cells[key] ?? null;
  if (typeof value !== "number") return value ?? "";
  return unit ? `${value} ${unit}` : `${lowered(label)} ${value}`;
}

/**
 * A description by some columns: "Walk, 10 mm", "Amble, version 2".
 * @param {Row} row
 * @param {Column[]} columns
 */
export const description = (row, columns) =>
  columns
    .map((column) => describingWord(row, column))
    .filter(Boolean)
    .join(", ");

/**
 * Columns of figures, side by side, that have the same quantity.
 * @param {Column[]} columns
 * @returns {{quantity: string, unit: string, columns: Column[]}[]} `unit` is "" where units differ
 */
export function columnGroups(columns) {
  const groups = [];
  for (const column of columns.filter(({ who }) => who)) {
    const { quantity } = column;
    const last = groups.at(-1);
    if (last?.quantity === quantity) last.columns.push(column);
    else groups.push({ quantity, columns: [column] });
  }
  return groups.map(({ quantity, columns: members }) => {
    const isOne = members.every(({ unit }) => unit === members[0].unit);
    return { quantity, unit: isOne ? members[0].unit : "", columns: members };
  });
}

/**
 * The text of a cell; "–" where there is no figure.
 * @param {Row} row
 * @param {Column} column
 */
export function cellText({ cells }, { key, decimals }) {
  const value = cells[key] ?? null;
  return typeof value === "string" ? value : fixed(value, decimals);
}

/**
 * Compares our figure with the published figure of the same quantity, as both are shown.
 * @param {Row} row
 * @param {Column} column `better`: "less" where the figure nearer to zero is better, else "more"
 * @param {Column[]} columns
 * @returns {"better"|"worse"|null} null where there is nothing to compare, or no difference
 */
export function comparison({ cells }, column, columns) {
  if (column.who !== "ours" || !column.better) return null;
  const other = columns.find(({ who, quantity }) => who === "published" && quantity === column.quantity);
  if (!other) return null;
  const [ours, published] = [cells[column.key], cells[other.key]];
  if (typeof ours !== "number" || typeof published !== "number") return null;
  const decimals = Math.min(column.decimals, other.decimals);
  const shown = (value) => Number((column.better === "less" ? Math.abs(value) : value).toFixed(decimals));
  const difference = shown(ours) - shown(published);
  if (difference === 0) return null;
  return difference < 0 === (column.better === "less") ? "better" : "worse";
}

/** A column's name where there is one line of heads. */
const fullName = ({ label, unit }) => [label, unit].filter(Boolean).join(", ");

/**
 * The table as lines of cells, with all digits of each figure, and the rows' remarks last.
 * @param {Column[]} columns
 * @param {Row[]} rows
 * @returns {string[][]}
 */
export function tableLines(columns, rows) {
  const lines = rows.map(({ cells, sentence }) => [
    ...columns.map(({ key }) => String(cells[key] ?? "")),
    sentence,
  ]);
  return [[...columns.map(fullName), "Remark"], ...lines].map((line) => line.map(tableCell));
}

const quoted = (cell) => (/[",\r\n]/.test(cell) ? `"${cell.replaceAll('"', '""')}"` : cell);

/** Lines of cells as a CSV file. @param {string[][]} lines */
export const csvText = (lines) => lines.map((line) => `${line.map(quoted).join(",")}\r\n`).join("");

/** Lines of cells as a spreadsheet takes them from the clipboard. @param {string[][]} lines */
export const copiedText = (lines) =>
  lines.map((line) => `${line.map((cell) => cell.replace(/\s+/g, " ")).join("\t")}\n`).join("");
