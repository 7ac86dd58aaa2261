/** Rings that run along the tracks of feet. */

import assert from "node:assert/strict";
import { test } from "node:test";

import { Tracks } from "../../../app/static/preview/tracks.js";

test("rings of a track follow a plan of another length", () => {
  const middles = [];
  const client = /** @type {any} */ ({
    node: () => ({}),
    updateMessage: () => ({}),
    moveSegments: (_, points) => {
      middles.push((points[0] + points[60]) / 2);
      return [];
    },
  });
  const tracks = new Tracks(client);
  const track = {
    feet: [
      [
        [0, 0],
        [1, 0],
      ],
    ],
    filled: [[false, false]],
    colours: ["#ff0000"],
  };
  tracks.set([{ ...track, shares: [0, 1], playing: [0, 1] }]);
  tracks.messages(0, 10, 0);
  for (const duration of [10, 20, 20]) tracks.messages(2, duration, 0);
  assert.equal(middles.length, 2);
  middles.forEach((middle, at) => assert.ok(Math.abs(middle - [0.2, 0.1][at]) < 1e-6));
});
