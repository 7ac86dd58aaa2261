/**
 * Cells of copied tables: texts that a spreadsheet would run as formulas are marked as text by an apostrophe.
 * The same rule writes exported files (`app/common/table_cell.py`).
 */

const NUMBER = /^ *[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?\s*$/i;
const FORMULA = /^'*([\t\r\n]|\s*[=+\-@＝＋－＠])/;

/**
 * A cell that a spreadsheet shows as it stands; numbers stay numbers.
 * @param {string} text
 */
export const tableCell = (text) => (FORMULA.test(text) && !NUMBER.test(text) ? `'${text}` : text);

/**
 * The text of a cell that was copied here.
 * @param {string} cell
 */
export const plainCell = (cell) => (cell.startsWith("'") && FORMULA.test(cell) ? cell.slice(1) : cell);
