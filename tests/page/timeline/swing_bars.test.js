/** The bars of swings over a row of the timeline. */

import assert from "node:assert/strict";
import { test } from "node:test";

import { swingSpans } from "../../../app/static/timeline/swing_bars.js";

test("a bar spans the samples of each swing", () => {
  assert.deepEqual(swingSpans("0110010"), [
    { first: 0, last: 0 },
    { first: 3, last: 4 },
    { first: 6, last: 6 },
  ]);
});
