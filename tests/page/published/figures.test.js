/** Figures of published tables as text: names, heads, comparisons and files. */

import assert from "node:assert/strict";
import { test } from "node:test";

import {
  cellText,
  columnGroups,
  comparison,
  copiedText,
  csvText,
  describing,
  description,
  nameHead,
  tableLines,
} from "../../../app/static/published/figures.js";

const column = (key, more = {}) => ({
  key,
  label: key,
  unit: "",
  who: "",
  quantity: "",
  origin: "",
  decimals: 1,
  better: "",
  ...more,
});
const figure = (who, decimals, more = {}) =>
  column(`${who}.feet_mm`, { who, quantity: "feet", unit: "mm", decimals, better: "less", ...more });
const COLUMNS = [
  column("gait", { label: "Gait" }),
  column("step_mm", { label: "Step", unit: "mm" }),
  figure("published", 1),
  figure("ours", 2),
  column("ours.lean_deg", { who: "ours", quantity: "lean", unit: "°" }),
];
const row = (published, ours) => ({
  id: "walk-10",
  cells: { gait: "Walk", step_mm: 10, "published.feet_mm": published, "ours.feet_mm": ours },
  state: "done",
  sentence: "",
  opens: [],
  has_plot: false,
});
const OURS = COLUMNS[3];

test("a row is named by what tells the rows apart; what all rows share stands elsewhere", () => {
  const columns = [COLUMNS[0], column("version", { label: "Version" }), COLUMNS[1], OURS];
  const rows = [0, 1].map((version) => ({ ...row(1, 2), cells: { gait: "Amble", version, step_mm: 10 } }));
  const { names, shared } = describing(columns, rows);
  assert.equal(nameHead(names), "Version");
  assert.equal(description(rows[0], names), "version 0");
  assert.equal(description(rows[0], shared), "Amble, 10 mm");
});

test("a table of one row names it by its first column", () => {
  const { names, shared } = describing(COLUMNS, [row(1, 2)]);
  assert.equal(nameHead([...names, ...shared]), "Gait, step");
  assert.equal(description(row(1, 2), names), "Walk");
});

test("columns of a quantity that stand side by side have one head, with the unit that they share", () => {
  const kinds = columnGroups(COLUMNS).map(({ quantity, unit, columns }) => [quantity, unit, columns.length]);
  assert.deepEqual(kinds, [
    ["feet", "mm", 2],
    ["lean", "°", 1],
  ]);
  const [mixed] = columnGroups([figure("published", 1, { unit: "cm" }), OURS]);
  assert.equal(mixed.unit, "");
});

for (const { published, ours, more = {}, expected } of [
  { published: 1.7, ours: 0.21, expected: "better" },
  { published: 2.8, ours: 3.04, expected: "worse" },
  { published: 1.7, ours: 1.74, expected: null },
  { published: -8.9, ours: 3.2, expected: "better" },
  { published: 0.4, ours: 2.6, more: { better: "more" }, expected: "better" },
  { published: 1.7, ours: 0.21, more: { better: "" }, expected: null },
  { published: 1.7, ours: null, expected: null },
  { published: null, ours: 0.21, expected: null },
]) {
  test(`${ours} beside ${published} with ${JSON.stringify(more)} is ${expected}`, () => {
    assert.equal(comparison(row(published, ours), { ...OURS, ...more }, COLUMNS), expected);
  });
}

test("only ours are compared with the published figures", () => {
  assert.equal(comparison(row(1.7, 0.21), COLUMNS[2], COLUMNS), null);
  assert.equal(comparison(row(1.7, 0.21), COLUMNS[4], COLUMNS), null);
});

test("a cell has its decimals, and a figure that is missing is a dash", () => {
  assert.equal(cellText(row(1.7, 0.2134), OURS), "0.21");
  assert.equal(cellText(row(1.7, null), OURS), "–");
  assert.equal(cellText(row(1.7, 0.2), COLUMNS[4]), "–");
});

test("files have all digits, and no cell of theirs is a formula", () => {
  const lines = tableLines(COLUMNS, [{ ...row(-1.7, 0.2134), sentence: '=1, "falls"\nat 3.2 s' }]);
  assert.deepEqual(lines[0], [
    "Gait",
    "Step, mm",
    "published.feet_mm, mm",
    "ours.feet_mm, mm",
    "ours.lean_deg, °",
    "Remark",
  ]);
  assert.deepEqual(lines[1].slice(0, 5), ["Walk", "10", "-1.7", "0.2134", ""]);
  assert.ok(csvText(lines).endsWith('\r\nWalk,10,-1.7,0.2134,,"\'=1, ""falls""\nat 3.2 s"\r\n'));
  assert.ok(copiedText(lines).endsWith('\nWalk\t10\t-1.7\t0.2134\t\t\'=1, "falls" at 3.2 s\n'));
});
