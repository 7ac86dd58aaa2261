/** What lies over the plots of a plan: a simulation and a run. */

import assert from "node:assert/strict";
import { test } from "node:test";

import { oversOf } from "../../../app/static/plots/measured.js";

test("a run and a simulation lie over each other and a stale one over nothing", () => {
  const feet = [[[0, 0, 0]], [[0, 0, 0.001]]];
  const motion = { times: [0, 1], strokes_mm: [[1], [2]], feet, margins_mm: [3, null] };
  const simulation = { key: "k", waypoints_hash: "p", motion };
  const run = { gait: "g", strokes: { plan_times: [0, 1], laps: [0, 0], measured_mm: [[1], [3]] } };
  const view = { plan: { waypoints_hash: "p" }, simulation: { key: "k", fresh: true } };
  const stale = { plan: { waypoints_hash: "q" }, simulation: { key: "k", fresh: false } };
  const words = (state, strip) => oversOf({ selected: "g", view, ...state }, strip).map(({ word }) => word);
  const iterate = { plan: { waypoints_hash: "i" } };
  assert.deepEqual(words({ simulation, run }, "strokes"), ["simulated", "measured"]);
  assert.deepEqual(words({ simulation }, "margin"), ["simulated"]);
  assert.deepEqual(words({ simulation, run, view: stale }, "strokes"), ["measured"]);
  assert.deepEqual(words({ simulation, iterate }, "strokes"), []);
});
