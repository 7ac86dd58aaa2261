/** The keys that drive the robot. */

import assert from "node:assert/strict";
import { test } from "node:test";

import { AXIS_KEYS, CHOICE_KEYS, markOf, MOTOR_ROWS, stepOf } from "../../../app/static/robot/drive_keys.js";

test("24 keys move twelve motors up and down, and no key has two meanings", () => {
  const motors = [...MOTOR_ROWS.up, ...MOTOR_ROWS.down];
  assert.equal(motors.length, 24);
  const all = [...motors, ...Object.keys(AXIS_KEYS), ...Object.keys(CHOICE_KEYS)];
  assert.equal(new Set(all).size, all.length);
  const moved = motors.map((code) => {
    const { foot, motor, by_mm: by } = stepOf(code, 0, 3);
    return `${(foot - 1) * 3 + motor} ${by}`;
  });
  const numbers = Array.from({ length: 12 }, (_, index) => index + 1);
  assert.deepEqual(moved, [...numbers.map((one) => `${one} -3`), ...numbers.map((one) => `${one} 3`)]);
});

test("the arrows move the body or the chosen foot along the robot's axes", () => {
  const body = { part: "body", foot: null, motor: null };
  assert.deepEqual(stepOf("ArrowUp", 0, 2), { ...body, axis: "x", by_mm: 2 });
  assert.deepEqual(stepOf("ArrowRight", 0, 2), { ...body, axis: "y", by_mm: -2 });
  assert.deepEqual(stepOf("PageUp", 3, 2), { part: "foot", foot: 3, motor: null, axis: "z", by_mm: 2 });
});

test("other keys and those that choose make no step", () => {
  for (const code of [...Object.keys(CHOICE_KEYS), "Space", "Tab", "Escape", "KeyZ", "Home", ""])
    assert.equal(stepOf(code, 0, 2), null);
});

test("a key shows what stands on it, by the browser's layout where that is known", () => {
  const layout = new Map([["KeyQ", "a"]]);
  assert.equal(markOf("KeyQ", layout), "A");
  assert.equal(markOf("KeyQ"), "Q");
  assert.equal(markOf("Digit0"), "0");
  assert.equal(markOf("BracketLeft", layout), "[");
});
