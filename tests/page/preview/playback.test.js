/** The playback clock, with a clock of the test's own. */

import assert from "node:assert/strict";
import { test } from "node:test";

import { Playback } from "../../../app/static/preview/playback.js";

/** A playback of ten seconds, a function that lets time pass, and the events that it sent. */
function begun() {
  const clock = { now: 0, waiting: [] };
  const playback = new Playback({
    duration: 10,
    step: 0.4,
    now: () => clock.now,
    requestFrame: (callback) => clock.waiting.push(callback),
    cancelFrame: () => {
      clock.waiting = [];
    },
  });
  const advance = (seconds) => {
    clock.now += seconds * 1000;
    for (const callback of clock.waiting.splice(0)) callback();
  };
  const seen = [];
  for (const type of ["time", "state", "end"]) {
    playback.addEventListener(type, (/** @type {CustomEvent} */ event) =>
      seen.push([type, event.detail.cause]),
    );
  }
  return { playback, advance, seen };
}

function assertClose(value, expected) {
  assert.ok(Math.abs(value - expected) < 1e-6, `${value} is not ${expected}`);
}

test("time follows the clock at the speed that is set", () => {
  const { playback, advance } = begun();
  playback.play();
  advance(1);
  playback.setSpeed(10);
  advance(0.25);
  assertClose(playback.time, 3.5);
});

test("it stops at the end and plays again from the start", () => {
  const { playback, advance, seen } = begun();
  playback.setTime(9.5);
  playback.play();
  advance(2);
  assert.deepEqual([playback.time, playback.playing], [10, false]);
  playback.play();
  advance(0.5);
  assertClose(playback.time, 0.5);
  assert.ok(seen.some(([type]) => type === "end"));
});

test("a loop wraps by the time that ran over", () => {
  const { playback, advance } = begun();
  playback.setLoop([6, 2]);
  playback.setTime(5);
  playback.play();
  advance(2);
  assertClose(playback.time, 3);
});

test("a step pauses and goes to whole samples", () => {
  const { playback } = begun();
  playback.setTime(1);
  playback.play();
  playback.step(1);
  assertClose(playback.time, 1.6);
  playback.step(-100);
  assert.deepEqual([playback.time, playback.playing], [0, false]);
});

for (const [wanted, given] of [
  [0.01, 0.1],
  [99, 10],
  [2.5, 2.5],
  [NaN, 1],
]) {
  test(`speed is held between a tenth and ten: ${wanted}`, () => {
    assert.equal(begun().playback.setSpeed(wanted), given);
  });
}

test("a shorter plan holds the playhead and says so", () => {
  const { playback, seen } = begun();
  playback.setTime(8);
  playback.setPlan(5, 0.2);
  assert.equal(playback.time, 5);
  assert.deepEqual(seen.at(-2), ["time", "plan"]);
});

test("an empty plan does not play", () => {
  const { playback } = begun();
  playback.setPlan(0);
  playback.play();
  assert.equal(playback.playing, false);
});
