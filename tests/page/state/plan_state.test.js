/** The words and the tone of a plan. */

import assert from "node:assert/strict";
import { test } from "node:test";

import { planState } from "../../../app/static/state/plan_state.js";

test("a manual plan that cannot be carried out is not green", () => {
  const plan = { source: "manual", live: null, times: [0, 1], refusal: null, balance: 0.01 };
  const unreachable = { ...plan, refusal: { sentence: "Too far." } };
  assert.deepEqual(
    [plan, { ...plan, balance: -0.004 }, unreachable].map((one) => planState(one)),
    [
      ["By hand", "good"],
      ["By hand, off balance", "bad"],
      ["By hand, out of reach", "bad"],
    ],
  );
});
