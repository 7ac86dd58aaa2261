/** What the store keeps about a gait's check. */

import assert from "node:assert/strict";
import { test } from "node:test";

import { acceptHello, acceptView, checkGone, createStore, withJob } from "../../../app/static/state/store.js";

test("a check that no edit took away is not said to be gone by one", () => {
  const store = createStore({ selected: "walk" });
  const why = (view) => {
    acceptView(store, { id: "walk", ...view });
    return checkGone(store.state.view, store.state.checked.walk);
  };
  why({ stamp: 1, revision: 7, verdict: {} });
  const simulation = { fresh: true };
  const simulated = why({ stamp: 2, revision: 7, simulation });
  assert.equal(simulated, "the gait was simulated again after the check");
  assert.equal(why({ stamp: 3, revision: 7 }), "the plan was computed again after the check");
  assert.equal(why({ stamp: 4, revision: 8, simulation }), "the gait changed");
});

test("the newest job is the first one though the clock was set back, and stays in its place", () => {
  const jobs = [
    { id: "a", number: 1, created: 1000 },
    { id: "b", number: 2, created: 7 },
    { id: "c", number: 3, created: 500 },
  ].reduce(withJob, []);
  const changed = withJob(jobs, { id: "b", number: 2, created: 7, state: "done" });
  assert.deepEqual(
    changed.map(({ id }) => id),
    ["c", "b", "a"],
  );
});

test("late answers are left out after a reconnection, and taken after another start of the studio", () => {
  const store = createStore({ selected: "walk" });
  const greeted = (start, stamp) => acceptHello(store, { start, gaits: [], jobs: [], robot: { stamp } });
  const shownAfter = (stamp) => {
    acceptView(store, { id: "walk", stamp });
    return store.state.view.stamp;
  };
  greeted("a", 5);
  assert.equal(shownAfter(7), 7);
  greeted("a", 4);
  assert.equal(store.state.robot.stamp, 5);
  assert.equal(shownAfter(6), 7);
  greeted("b", 1);
  assert.equal(store.state.robot.stamp, 1);
  assert.equal(shownAfter(2), 2);
});
