/** A timer that counts only time in which the page ran. */

import assert from "node:assert/strict";
import { test } from "node:test";

import { runningTimer } from "../../../app/static/lib/running_timer.js";

/** Runs a timer of 3 s while time passes by steps of so many ms; what it called. */
function called(steps) {
  const [set, clear] = [globalThis.setInterval, globalThis.clearInterval];
  let look = null;
  globalThis.setInterval = /** @type {any} */ ((run) => (look = run));
  globalThis.clearInterval = () => (look = null);
  let now = 5000;
  const calls = [];
  runningTimer(3000, { act: () => calls.push("act"), slept: () => calls.push("slept"), clock: () => now });
  for (const step of steps) {
    now += step;
    look?.();
  }
  [globalThis.setInterval, globalThis.clearInterval] = [set, clear];
  return calls;
}

test("it acts once after its time", () => {
  assert.deepEqual(called(Array(59).fill(50)), []);
  assert.deepEqual(called(Array(80).fill(50)), ["act"]);
  assert.deepEqual(called([1500, 1400]), []);
});

for (const away of [2500, 20000, 3600000]) {
  test(`after ${away} ms without the page it gives up`, () => {
    assert.deepEqual(called([50, 50, away, ...Array(80).fill(50)]), ["slept"]);
  });
}
