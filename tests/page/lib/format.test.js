/** Numbers as words. */

import assert from "node:assert/strict";
import { test } from "node:test";

import { paceText, readable } from "../../../app/static/lib/format.js";

for (const [speed, turnRate, words] of [
  [0.00227, 0, "2.27 mm/s"],
  [0.0025, 0.03, "2.50 mm/s"],
  [0, 0.103, "5.9°/s"],
  [0.000001, -0.103, "5.9°/s"],
  [0, 0, ""],
  [null, null, ""],
]) {
  test(`words of ${speed} m/s and ${turnRate} rad/s are of the speed and without one of the turn`, () => {
    assert.equal(paceText({ speed, turn_rate: turnRate }), words);
  });
}

test("a rule without a value has no room of zero", () => {
  const shown = [readable(null, "rad"), readable(null, "m"), readable(0, "rad")];
  assert.deepEqual(
    shown.map(({ value, unit }) => value + unit),
    ["–", "–", "0.00°"],
  );
});
