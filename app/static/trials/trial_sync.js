/** Keeps a shown trial in step with the server: sends one change at a time, and takes others' changes. */

import { announce, report, toast } from "../lib/toasts.js";
import { CONFLICT } from "../api/gaits.js";
import { trialApi } from "../api/trials.js";

/**
 * Follows a trial.
 * @param {import("../state/store.js").Store} store
 * @param {Record<string, any>} first as the server sent it
 * @param {(trial: Record<string, any>) => void} onChange gets each later state
 * @returns {{change: (changes: Record<string, any>, done?: string) => Promise<boolean>, leave: () => void}}
 *   `change` resolves to whether it was kept
 */
export function followTrial(store, first, onChange) {
  const { id } = first;
  let [now, isClosed] = [first, false];
  /** @type {Promise<any>} */
  let last = Promise.resolve();

  function take(trial) {
    if (isClosed || trial.revision < now.revision) return;
    now = trial;
    onChange(now);
  }

  async function refused(error) {
    if (error.status !== CONFLICT) throw error;
    take(await trialApi.read(id));
    const words = now.deleted
      ? error.message
      : `Somebody changed the trial “${now.name}” on another page. You now see the new version. `
        + "Make your last change again.";
    toast(words, { tone: "bad", of: "studio" });
  }

  async function send(changes, done) {
    try {
      take(await trialApi.change(id, now.revision, changes));
      if (done) announce(done);
      return true;
    } catch (error) {
      await refused(error).catch(report);
      return false;
    }
  }

  /** Does one thing after the other, so that each is made from what the one before led to. */
  function enqueue(act) {
    last = last.then(act, act);
    return last;
  }

  async function refresh() {
    const change = store.state.trialChanges[id];
    if (isClosed || (change && change.revision <= now.revision && change.deleted === now.deleted)) return;
    take(
      await trialApi.read(id).catch((error) => {
        report(error);
        return now;
      }),
    );
  }

  const forget = store.watch(
    ({ trialChanges, connected }) => [trialChanges[id], connected],
    ({ trialChanges, connected }) => {
      if (connected && trialChanges[id]) enqueue(refresh);
    },
  );
  return {
    change: (changes, done = "") => enqueue(() => send(changes, done)),
    leave() {
      isClosed = true;
      forget();
    },
  };
}
