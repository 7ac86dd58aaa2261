/** Places of the flags over phases without motion. */

import assert from "node:assert/strict";
import { test } from "node:test";

import { flagPlaces } from "../../../app/static/timeline/phase_flags.js";

/** @type {[string, number[][], number[][]][]} */
const CASES = [
  [
    "with room",
    [
      [100, 140],
      [300, 340],
    ],
    [
      [100, 90],
      [300, 90],
    ],
  ],
  ["at the end", [[560, 600]], [[510, 90]]],
  ["begun before", [[-50, 40]], [[0, 90]]],
  [
    "with short words",
    [
      [10, 50],
      [80, 120],
      [400, 440],
    ],
    [
      [10, 50],
      [80, 90],
      [400, 90],
    ],
  ],
  [
    "as a mark",
    [
      [10, 20],
      [30, 40],
    ],
    [
      [10, 16],
      [30, 90],
    ],
  ],
];
for (const [name, phases, places] of CASES) {
  test(`flags neither lie on each other nor are cut: ${name}`, () => {
    const given = phases.map(([left, right]) => ({ left, right, width: 90, short: 50 }));
    assert.deepEqual(
      flagPlaces(given, 600).map(({ left, width }) => [left, width]),
      places,
    );
  });
}
