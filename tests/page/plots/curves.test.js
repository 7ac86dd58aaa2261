/** Curves of the strip plots: ticks and paths. */

import assert from "node:assert/strict";
import { test } from "node:test";

import { acrossOf, pathOf, ticksOf } from "../../../app/static/plots/curves.js";

/** @type {[number, number, number, number[]][]} */
const TICKS = [
  [0, 30, 4, [0, 10, 20, 30]],
  [3.2, 8.1, 2, [5]],
  [-0.1, 0.1, 3, [-0.1, 0, 0.1]],
  [2, 2, 4, []],
];
for (const [low, high, most, ticks] of TICKS) {
  test(`ticks from ${low} to ${high} are round values`, () => {
    const found = ticksOf(low, high, most);
    assert.equal(found.length, ticks.length);
    found.forEach((tick, at) => assert.ok(Math.abs(tick - ticks[at]) < 1e-9, `${tick} is not ${ticks[at]}`));
  });
}

test("more samples than pixels are thinned and keep their extremes", () => {
  const times = Array.from({ length: 60000 }, (_, index) => index * 0.001);
  const axis = { samples: 60000, columns: 60000, first: 0, shown: 60000, step: 0.001, start: -0.0005 };
  const values = times.map((_, index) => (index === 31234 ? 77 : index === 40000 ? null : index % 2));
  const path = pathOf(
    acrossOf(axis, times),
    (index) => values[index],
    (value) => value,
  );
  const corners = [...path.matchAll(/[ML][0-9.]+ ([0-9.-]+)/g)].map(([, y]) => Number(y));
  assert.ok(corners.length <= 2002);
  assert.equal(Math.max(...corners), 77);
  assert.equal(Math.min(...corners), 0);
});
