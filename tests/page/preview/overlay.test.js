/** The geometry of the marks on the floor. */

import assert from "node:assert/strict";
import { test } from "node:test";

import { hull, sampleAt } from "../../../app/static/preview/overlay.js";

test("hull leaves out inner feet", () => {
  const corners = hull([
    [0, 0],
    [2, 0],
    [1, 0.5],
    [2, 2],
    [0, 2],
    [1, 0],
  ]);
  const sorted = [...corners].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  assert.deepEqual(sorted, [
    [0, 0],
    [0, 2],
    [2, 0],
    [2, 2],
  ]);
});

for (const [time, sample] of [
  [-1, 0],
  [0.39, 0],
  [0.4, 1],
  [0.79, 1],
  [9, 2],
]) {
  test(`the current sample is the last one not after the playhead: ${time} s`, () => {
    assert.equal(sampleAt([0, 0.4, 0.8], time), sample);
  });
}
