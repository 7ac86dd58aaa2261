/** The two gaits of a transition: the choices, their timelines, and the default choice. */

import { api } from "../api/gaits.js";
import { shownDocument } from "../state/store.js";
import { attempt } from "../lib/toasts.js";

/**
 * Gaits that a transition can lead from or to: of the shown gait's robot and orientation, no sequences, and
 * none for the robot's clock.
 */
export function transitionGaits({ gaits, selected }) {
  const open = gaits.find(({ id }) => id === selected);
  return open
    ? gaits.filter(
        ({ robot, orientation, source }) =>
          robot === open.robot && orientation === open.orientation && !["sequence", "poses"].includes(source),
      )
    : [];
}

/** The timeline of a gait as the page knows it: the open one with its edits under way. */
export function timelineOf(store, problem, gait) {
  return gait && gait === store.state.selected
    ? shownDocument(store.state)
    : (problem.state.documents[gait] ?? null);
}

const STANDING_AT_LEAST = 3;

/**
 * The sample at which a cursor stands first: in the middle of the swing that is nearest to the middle of the
 * gait, with three feet down. The first sample where there is no such swing.
 * @param {{feet: string[]}} timeline
 * @returns {number} from 0
 */
export function midGait({ feet }) {
  const count = feet[0].length;
  const state = (sample) => feet.map((row) => row[sample]).join("");
  const isSwinging = (sample) =>
    state(sample).includes("0") && feet.filter((row) => row[sample] === "1").length >= STANDING_AT_LEAST;
  const middles = [];
  for (let first = 0; first < count;) {
    let last = first;
    while (last + 1 < count && state(last + 1) === state(first)) last += 1;
    if (first > 0 && last < count - 1 && isSwinging(first)) middles.push(Math.floor((first + last) / 2));
    first = last + 1;
  }
  const away = (sample) => Math.abs(sample - (count - 1) / 2);
  return (
    middles.reduce((best, sample) => (best === null || away(sample) < away(best) ? sample : best), null) ?? 0
  );
}

/** Keeps both gaits chosen among those that there are, and their documents at hand. */
export function mountPatternGaits(store, problem, isOpen) {
  const fetched = new Map();

  const fetchDocument = attempt(async (gait, line) => {
    try {
      const document = await api.document(gait);
      if (fetched.get(gait) === line)
        problem.set({ documents: { ...problem.state.documents, [gait]: document } });
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
    if (first !== from.gait) problem.set({ from: { gait: first, sample: null } });
    if (second !== to.gait) problem.set({ to: { gait: second, sample: null } });
    for (const gait of [first, second]) {
      const line = store.state.gaits.find(({ id }) => id === gait);
      if (!gait || gait === selected || fetched.get(gait) === line) continue;
      fetched.set(gait, line);
      fetchDocument(gait, line);
    }
  }

  /** A cursor that nobody has moved stands in mid-gait as soon as the gait is known. */
  function place() {
    for (const side of ["from", "to"]) {
      const { gait, sample } = problem.state[side];
      const document = sample === null ? timelineOf(store, problem, gait) : null;
      if (document) problem.set({ [side]: { gait, sample: midGait(document.timeline) } });
    }
  }

  store.watch(({ gaits, selected }) => [gaits, selected], choose);
  store.watch(({ view }) => [view?.id], place);
  problem.watch(({ from, to, documents }) => [from, to, documents], place);
  problem.watch(({ from, to }) => [from, to], choose);
  return { choose };
}
