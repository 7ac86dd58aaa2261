/** The two gaits of a transition: the choices, their timelines, and the default choice. */

import { api } from "../api/gaits.js";
import { shownDocument } from "../state/store.js";
import { attempt } from "../lib/toasts.js";

/** Gaits that a transition can lead from or to: of the shown gait's robot and orientation, no sequences, and none for the robot's clock. */
export function transitionGaits({ gaits, selected }) {
  const open = gaits.find(({ id }) => id === selected);
  return open ? gaits.filter(({ robot, orientation, source }) => robot === open.robot && orientation === open.orientation && !["sequence", "poses"].includes(source)) : [];
}

/** The timeline of a gait as the page knows it: the open one with its edits under way. */
export function timelineOf(store, problem, gait) {
  return gait && gait === store.state.selected ? shownDocument(store.state) : (problem.state.documents[gait] ?? null);
}

/** Keeps both gaits chosen among those that there are, and their documents at hand. */
export function mountPatternGaits(store, problem, isOpen) {
  const fetched = new Map();

  const fetchDocument = attempt(async (gait, line) => {
    try {
      const document = await api.document(gait);
      if (fetched.get(gait) === line) problem.set({ documents: { ...problem.state.documents, [gait]: document } });
    } catch (error) {
      if (fetched.get(gait) === line) fetched.delete(gait);
      throw error;
    }
  });

  function choose() {
    const { selected } = store.state;
    if (!isOpen() || !selected) return;
    // A gait just made is open before it is in the list: the cursors stay where they are until then.
    if (!store.state.gaits.some(({ id }) => id === selected)) return;
    const ids = transitionGaits(store.state).map(({ id }) => id);
    const { from, to } = problem.state;
    const first = ids.includes(from.gait) ? from.gait : ids.includes(selected) ? selected : (ids[0] ?? null);
    const second = ids.includes(to.gait) ? to.gait : (ids.find((id) => id !== first) ?? first);
    if (first !== from.gait) problem.set({ from: { gait: first, sample: 0 } });
    if (second !== to.gait) problem.set({ to: { gait: second, sample: 0 } });
    for (const gait of [first, second]) {
      const line = store.state.gaits.find(({ id }) => id === gait);
      if (!gait || gait === selected || fetched.get(gait) === line) continue;
      fetched.set(gait, line);
      fetchDocument(gait, line);
    }
  }

  store.watch(({ gaits, selected }) => [gaits, selected], choose);
  problem.watch(({ from, to }) => [from, to], choose);
  return { choose };
}
