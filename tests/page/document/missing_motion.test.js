/** Where a drawing has no motion: hatched cells, outlined phases, and why in a few words. */

import assert from "node:assert/strict";
import { test } from "node:test";

import {
  missingMotionByCell,
  missingPhases,
  shortWords,
} from "../../../app/static/document/missing_motion.js";

function lack(family, first, last, feet = [], { amount = 1, unit = "mm" } = {}) {
  return { family, first, last, feet, amount, unit, sentence: `${family} lacks ${amount.toFixed(1)}.` };
}

/** The plan of a drawing with these feet down (one text a sample) and these lacks. */
function planOf(contact, ...lacks) {
  return { contact: contact.map((row) => [...row].map((down) => down === "1")), live: { lacks } };
}

/** The tone of every hatched cell. */
function tonesOf(plan) {
  const blamed = [...missingMotionByCell(plan)].filter(([, { tone }]) => tone);
  return Object.fromEntries(blamed.map(([place, { tone }]) => [place, tone]));
}

test("of balance the swings are to blame and of reach the foot", () => {
  const contact = ["1111", "0101", "1101", "1111"];
  assert.deepEqual(tonesOf(planOf(contact, lack("body_torque", 1, 2, [1, 3]))), {
    "0,1": "bad",
    "2,1": "bad",
    "2,2": "bad",
  });
  const reach = planOf(contact, lack("margin", 0, 0, [1, 2]), lack("workspace", 1, 2, [1]));
  assert.deepEqual(tonesOf(reach), { "1,0": "bad", "2,0": "bad", "1,1": "caution", "1,2": "caution" });
});

for (const [contact, missing, words] of [
  ["0101", lack("body_torque", 4, 6, [1, 3]), "feet 1 and 3 in the air"],
  ["000111", lack("margin", 4, 6, [3, 4]), "margin 1.0 mm short"],
  ["001100", lack("margin", 4, 6, [3, 4]), "feet 1, 2, 5 and 6 in the air"],
  ["0111", lack("margin", 4, 6, [1, 3], { amount: 0.84 }), "margin 0.8 mm short"],
  ["1111", lack("workspace", 4, 6, [1], { amount: 3.12 }), "foot 2: reach 3.1 mm short"],
  ["1110", lack("foot_speed", 4, 6, [3], { unit: "mm/s" }), "foot 4 too fast"],
  ["1111", lack("body_speed", 4, 6, [], { unit: "mm/s" }), "body too fast"],
  ["1111", lack("something new", 4, 6), "a limit is violated"],
]) {
  test(`a flag says why in a few words: ${words}`, () => {
    const phases = missingPhases(planOf(Array(20).fill(contact), missing));
    assert.deepEqual(
      phases.map((phase) => phase.words),
      [words],
    );
  });
}

for (const [words, short] of [
  ["foot 2: reach 3.1 mm short", "foot 2"],
  ["feet 1 and 3 in the air", "feet 1 and 3"],
  ["margin 0.8 mm short", "margin"],
  ["foot 4 too fast", "foot 4"],
  ["feet 1 and 2 too close", "feet 1 and 2"],
  ["body height off by 2.0 mm", "body height"],
  ["a limit is violated", "a limit is violated"],
]) {
  test(`where there is no room a flag keeps whole words: ${short}`, () => {
    assert.equal(shortWords(words), short);
  });
}

test("entries that meet are one phase and the three worst are shown", () => {
  const still = Array(40).fill("1111");
  const phasesOf = (...lacks) => missingPhases(planOf(still, ...lacks));
  assert.deepEqual(
    phasesOf(lack("workspace", 4, 8, [1]), lack("margin", 2, 5, [0, 1]), lack("margin", 9, 9)),
    [
      { first: 2, last: 8, words: "foot 2: reach 1.0 mm short" },
      { first: 9, last: 9, words: "margin 1.0 mm short" },
    ],
  );
  const following = phasesOf(lack("foot_speed", 4, 5, [1]), lack("foot_speed", 6, 7, [1]));
  assert.deepEqual(
    following.map(({ first, last }) => [first, last]),
    [[4, 7]],
  );
  const many = [30, 10, 20, 0].map((first) => lack("workspace", first, first + 1, [1]));
  assert.deepEqual(
    phasesOf(...many).map(({ first }) => first),
    [10, 20, 30],
  );
});
