/** A timer that counts only time in which the page ran. */

import assert from "node:assert/strict";
import { test } from "node:test";

import { runningTimer } from "../../../app/static/lib/running_timer.js";

/** Runs a timer of 3 s while time passes by steps of so many ms, of both clocks or of each. */
function called(steps) {
  const [set, clear] = [globalThis.setInterval, globalThis.clearInterval];
  let look = null;
  globalThis.setInterval = /** @type {any} */ ((run) => (look = run));
  globalThis.clearInterval = () => (look = null);
  let [now, wall] = [5000, 1e12];
  const calls = [];
  runningTimer(3000, {
    act: () => calls.push("act"),
    slept: () => calls.push("slept"),
    clocks: [() => now, () => wall],
  });
  for (const step of steps) {
    const [running, real] = [step].flat();
    now += running;
    wall += real ?? running;
    look?.();
  }
  [globalThis.setInterval, globalThis.clearInterval] = [set, clear];
  return calls;
}

test("it acts once after its time", () => {
  assert.deepEqual(called(Array(59).fill(50)), []);
  assert.deepEqual(called(Array(80).fill(50)), ["act"]);
});

test("a page that was busy for a moment counts little of it", () => {
  assert.deepEqual(called([1900, 1900, ...Array(45).fill(50)]), []);
  assert.deepEqual(called([1900, 1900, ...Array(55).fill(50)]), ["act"]);
});

for (const away of [2500, 20000, 3600000, [40, 20000], [0, -7200000]]) {
  test(`after ${away} ms without the page it gives up`, () => {
    assert.deepEqual(called([50, 50, away, ...Array(80).fill(50)]), ["slept"]);
  });
}
