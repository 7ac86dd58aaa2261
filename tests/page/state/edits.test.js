/** Edits against a studio that answers late, with a refusal, or not at all. */

import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";

import { createEdits } from "../../../app/static/state/edits.js";
import { acceptView, createStore } from "../../../app/static/state/store.js";

/** Fates of the next requests that change the gait: "lost" (made, not answered), "refused", … */
let fates = [];
let studio = { revision: 0, stamp: 0, feet: 0, edits: [] };

const view = () => ({ ...studio, id: "a", document: { feet: studio.feet }, stamp: (studio.stamp += 1) });
const answer = (status, body) => new Response(JSON.stringify(body), { status });

function put(path, { feet }) {
  const number = new URL(path, "http://studio").searchParams.get("edit");
  if (studio.edits.includes(number)) return;
  studio = { ...studio, feet, revision: studio.revision + 1, edits: [number, ...studio.edits] };
}

async function fetched(path, { method, body }) {
  const fate = method === "GET" ? null : fates.shift();
  if (fate === "refused") return answer(422, { error: "No.", where: null });
  const revision = Number(new URL(path, "http://studio").searchParams.get("revision"));
  if (method === "PUT" && revision !== studio.revision)
    return answer(409, { error: "Old.", where: "revision" });
  if (method === "PUT") put(path, JSON.parse(body));
  if (fate === "lost") throw new TypeError("the line was cut");
  if (fate === "made, then 503") return answer(503, { error: "Disk.", where: null });
  return answer(200, view());
}

const add = (count) => (document) => ({ ...document, feet: document.feet + count });
const rest = (ms) => new Promise((resume) => setTimeout(resume, ms));

let store = createStore();
let edits = createEdits(store);

beforeEach(() => {
  globalThis.fetch = /** @type {any} */ (fetched);
  globalThis.document = /** @type {any} */ ({ getElementById: () => null, querySelector: () => null });
  fates = [];
  studio = { revision: 0, stamp: 0, feet: 0, edits: [] };
  store = createStore();
  store.set({ selected: "a", view: view() });
  edits = createEdits(store);
});

const shown = () => edits.shown().feet;

test("an edit whose event comes before its answer is shown once", async () => {
  const made = edits.edit(add(1), "One");
  await rest(0);
  assert.equal(shown(), 1);
  await made;
  assert.deepEqual([shown(), studio.feet], [1, 1]);
});

test("a drawing that was refused is no longer marked once the next edit took it along", async () => {
  fates = ["refused", "lost"];
  await edits.edit(add(1), "Drawn", { drawing: true });
  assert.notEqual(store.state.refused, null);
  await edits.edit(add(10), "More", { drawing: true }).catch(() => {});
  assert.equal(studio.feet, 11);
  acceptView(store, view());
  await edits.settled();
  assert.deepEqual([shown(), store.state.pending, store.state.refused], [11, [], null]);
});

test("a drawing that was made although its answer was an error is made once", async () => {
  fates = ["made, then 503"];
  await edits.edit(add(1), "Drawn", { drawing: true });
  await edits.edit(add(10), "More", { drawing: true });
  assert.deepEqual([shown(), studio.feet], [11, 11]);
});
