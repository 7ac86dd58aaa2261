/** A camera setup that is being changed: kept by itself after each change, as its next revision. */

import { watchable } from "../state/store.js";
import { report, toast } from "../lib/toasts.js";
import { CONFLICT } from "../api/gaits.js";
import { setupApi } from "../api/videos.js";

/** Whether two setups are equal. */
const same = (one, other) => JSON.stringify(one) === JSON.stringify(other);

/** Shows a setup as somebody else has changed it meanwhile; other refusals are said as they are. */
async function conflict(store, error) {
  if (error.status !== CONFLICT) throw error;
  const now = await setupApi.read(store.state.id);
  store.set({ setup: now.setup, answer: now, revision: now.revision, kept: true });
  toast(`The setup “${now.setup.name}” was changed elsewhere meanwhile; it is shown as it is now. Make your last change again.`, { tone: "bad", of: "studio" });
}

/**
 * Begins with a setup as the server sent it.
 * @param {object} first with `id`, `revision` and `setup`
 * @returns {object} `state` and `watch` as of a store: `setup` as it is on the page, `answer` what the server says of it, `kept`
 *   whether that is of this very setup, `trouble` why it could not be kept; `change(patch, last)`, where `last` is false while a finger drags and nothing is kept; `check()` asks what the server says
 *   meanwhile; `settled()` resolves when all is kept
 */
export function setupDraft(first) {
  const store = watchable({ id: first.id, revision: first.revision, setup: first.setup, answer: first, kept: true, trouble: null });
  let [working, checking, settled] = [false, false, []];

  function take(answer, requested) {
    store.set({ answer, revision: answer.revision || store.state.revision, kept: Boolean(answer.id) && same(requested, store.state.setup) });
  }

  async function keep() {
    if (working) return;
    working = true;
    let refused = null;
    while (!store.state.kept && !same(refused, store.state.setup)) {
      const { id, revision, setup } = store.state;
      try {
        take(await setupApi.change(id, revision, setup), setup);
      } catch (error) {
        refused = setup;
        await conflict(store, error).catch((other) => { store.set({ trouble: other.message }); report(other); });
      }
    }
    working = false;
    settled.splice(0).forEach((act) => act());
  }

  /** Checks a setup that is not kept yet on the server; only the newest. */
  async function check() {
    if (checking) return;
    checking = true;
    let requested = null;
    while (!working && !store.state.kept && requested !== store.state.setup) {
      requested = store.state.setup;
      try {
        take(await setupApi.check(requested), requested);
      } catch {
        break;
      }
    }
    checking = false;
  }

  return {
    get state() { return store.state; },
    watch: store.watch,
    change(patch, last = true) {
      const setup = { ...store.state.setup, ...patch };
      if (same(setup, store.state.setup) && (store.state.kept || !last)) return;
      store.set({ setup, kept: false, trouble: null });
      if (last) keep();
    },
    check,
    settled: () => (working ? new Promise((resolve) => { settled.push(resolve); }) : Promise.resolve()),
  };
}
