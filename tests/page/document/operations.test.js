/** Operations on a selection of the timeline: what becomes of its rows, and what each is called. */

import assert from "node:assert/strict";
import { test } from "node:test";

import { outcomeOf } from "../../../app/static/document/operations.js";

/** Four feet that swing one after the other, 24 samples. */
const FOUR = [
  "111100001111111111111111",
  "111111110000111111111111",
  "111111111111000011111111",
  "111111111111111100001111",
];

/** Some rows with a foot's samples (both counted from 1) painted. */
function painted(rows, foot, first, last, text) {
  return rows.map((row, at) =>
    at === foot - 1 ? row.slice(0, first - 1) + text.repeat(last - first + 1) + row.slice(last) : row,
  );
}

/** The four rows with samples (counted from 1) replaced by other text. */
function spliced(first, last, ...inside) {
  return FOUR.map((row, at) => row.slice(0, first - 1) + inside[at] + row.slice(last));
}

const CASES = [
  {
    operation: "stance",
    from: [1, 5],
    to: [2, 9],
    feet: painted(painted(FOUR, 1, 5, 8, "1"), 2, 9, 9, "1"),
    label: "Feet 1–2, samples 5–9 to stance",
  },
  {
    operation: "duplicate",
    from: [1, 5],
    to: [1, 8],
    feet: painted(FOUR, 1, 9, 12, "0"),
    label: "Duplicate foot 1, samples 5–8",
  },
  {
    operation: "mirror",
    from: [1, 5],
    to: [1, 12],
    feet: [FOUR[1], FOUR[0], FOUR[2], FOUR[3]],
    label: "Mirror foot 1, samples 5–12",
  },
  {
    operation: "reverse",
    from: [1, 5],
    to: [1, 9],
    feet: painted(painted(FOUR, 1, 5, 5, "1"), 1, 9, 9, "0"),
    label: "Reverse foot 1, samples 5–9",
  },
  {
    operation: "shift",
    from: [1, 5],
    to: [1, 9],
    amount: -3,
    feet: painted(painted(FOUR, 1, 6, 6, "1"), 1, 9, 9, "0"),
    label: "Shift foot 1, samples 5–9 by −3",
  },
  {
    operation: "stretch",
    from: [1, 5],
    to: [1, 8],
    amount: 6,
    feet: painted(FOUR, 1, 5, 10, "0"),
    label: "Stretch foot 1, samples 5–8 to 6 samples",
  },
  {
    operation: "stretch",
    from: [1, 5],
    to: [4, 8],
    amount: 2,
    feet: spliced(5, 8, "00", "11", "11", "11"),
    label: "Stretch all feet, samples 5–8 to 2 samples",
  },
  {
    operation: "insert",
    from: [3, 6],
    to: [3, 6],
    amount: 3,
    feet: spliced(6, 5, "000", "111", "111", "111"),
    label: "Insert 3 samples before sample 6",
  },
  {
    operation: "remove",
    from: [2, 1],
    to: [2, 3],
    feet: spliced(1, 3, "", "", "", ""),
    label: "Remove samples 1–3",
  },
  {
    operation: "repeat",
    from: [1, 5],
    to: [1, 10],
    amount: 2,
    feet: spliced(5, 10, "000011".repeat(2), "111100".repeat(2), "1".repeat(12), "1".repeat(12)),
    label: "Repeat samples 5–10 2×",
  },
];

for (const { operation, from, to, amount = null, feet, label } of CASES) {
  test(`an operation changes the region and nothing else: ${label}`, () => {
    const region = { feet: [from[0] - 1, to[0] - 1], samples: [from[1] - 1, to[1] - 1] };
    const content = { timeline: { sample_time: 0.4, feet: FOUR, locked: null }, direction: 1, iterations: 1 };
    const state = { document: content, region, mirror: [1, 0, 3, 2] };
    const outcome = JSON.parse(JSON.stringify(outcomeOf(operation, state, amount)));
    assert.equal(outcome.reason ?? null, null);
    assert.deepEqual(outcome.document.timeline.feet, feet);
    assert.equal(outcome.label, label);
    assert.deepEqual({ ...outcome.document, timeline: null }, { ...content, timeline: null });
  });
}
