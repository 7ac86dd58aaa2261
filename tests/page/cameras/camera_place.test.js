/** Where on the floor a clicked point lies. */

import assert from "node:assert/strict";
import { test } from "node:test";

import { guessPlace } from "../../../app/static/cameras/camera_place.js";

test("points propose the place of the next", () => {
  const pixels = [
    [0, 0],
    [100, 10],
    [90, 120],
    [-10, 100],
  ];
  const places = [
    [0, 0],
    [10, 0],
    [10, 10],
    [0, 10],
  ];
  const points = pixels.map((pixel, at) => ({ pixel, place_cm: places[at] }));
  pixels.forEach((pixel, at) => {
    const guess = guessPlace(points, pixel);
    assert.equal(guess.length, 2);
    guess.forEach((value, axis) => assert.ok(Math.abs(value - places[at][axis]) < 1e-6));
  });
  assert.equal(guessPlace(points.slice(1), [0, 0]), null);
  const inLine = [0, 1, 2, 3].map((at) => ({ pixel: [at, at], place_cm: [at, at] }));
  assert.equal(guessPlace(inLine, [2, 2]), null);
});
