/** While a gait has no motion, plots and robot show, in grey, the last plan of the same gait that worked. */

import assert from "node:assert/strict";
import { test } from "node:test";

import { createStore } from "../../../app/static/state/store.js";
import { drawnPlan, greyOf, mountWorkedPlan } from "../../../app/static/state/worked_plan.js";

function plan(hash, status = "optimal") {
  const live = { status, lacks: [] };
  return { hash, source: "live", times: [0, 0.4], refusal: null, live };
}

function refusedPlan(hash) {
  return { hash, source: "draft", times: [], refusal: { sentence: "It ends in the air." }, live: null };
}

function opened(id, shown) {
  const view = { id, plan: shown, document: { robot: "deltawalker" } };
  return { selected: id, view, live: null, tryout: null };
}

test("the last plan that worked is drawn in grey until one works again", async () => {
  const [no, refused] = [plan("no", "infeasible"), refusedPlan("refused")];
  const ofAnotherRobot = { id: "a", document: { robot: "hexapod" } };
  /** @type {[Record<string, any>, (string|null)[]][]} */
  const states = [
    [opened("a", plan("first")), [null, "first"]],
    [{ live: { plan: no } }, ["worked", "first"]],
    [{ live: { plan: plan("second") } }, [null, "second"]],
    [{ live: { plan: refused } }, ["worked", "second"]],
    [{ tryout: plan("tried") }, [null, "tried"]],
    [{ tryout: null }, ["worked", "second"]],
    [{ gesture: null, view: ofAnotherRobot, live: { plan: no } }, ["nearest", "no"]],
    [opened("b", no), ["nearest", "no"]],
    [opened("b", refused), [null, "refused"]],
    [opened("a", no), ["nearest", "no"]],
  ];
  const store = createStore();
  mountWorkedPlan(store);
  for (const [state, seen] of states) {
    store.set(state);
    await new Promise((resume) => setTimeout(resume));
    assert.deepEqual([greyOf(store.state), drawnPlan(store.state)?.hash ?? null], seen);
  }
});
