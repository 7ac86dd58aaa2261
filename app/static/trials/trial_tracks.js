/** A switch that lays trials' tracks over the gait in 3D, with how the robot stood and the shown gait. */

import { recalled, remember } from "../lib/remembered.js";
import { h, setText } from "../lib/dom.js";
import { fixed } from "../lib/format.js";
import { attempt } from "../lib/toasts.js";
import { comparisonApi } from "./trial_comparison.js";

const LAYER = "trial-tracks";

/** How the robots stood, and what the rings are. */
function words(tracks) {
  const [{ turn_deg: turn, gaps_mm: gaps }] = tracks;
  const stood =
    tracks.length > 1
      ? `The studio rotates the ${tracks.length} tracks, `
        + "so that the robot has the same heading in the first frame of each track."
      : `The studio rotates the track back by ${fixed(turn, 1)}°, the heading of the robot in the first `
        + `frame. Then each foot of the first frame is within ${fixed(Math.max(...gaps), 1)} mm of its `
        + "expected position.";
  return `${stood} Rings show the feet at the playhead. A grey line means that the foot was not seen.`;
}

/** The choice of the repetition of the walk, hidden where there is only one. */
function lapChoice() {
  const select = h("select", {
    "aria-label": "Repetition of the walk",
    title: "The walk repeats the plan several times. Choose which repetition is drawn over the shown gait",
  });
  const element = h("label", { hidden: true }, "repetition", select);
  return {
    element,
    select,
    chosen: () => select.value || "1",
    show(tracks) {
      const count = Math.min(...tracks.map(({ laps }) => laps), Infinity);
      element.hidden = !(count > 1 && count < Infinity);
      if (element.hidden || select.length === count) return;
      select.replaceChildren(
        ...Array.from({ length: count }, (_, index) =>
          h("option", { value: String(index + 1), text: `${index + 1} of ${count}` }),
        ),
      );
    },
  };
}

/** Says so where another gait is shown than the trials'. */
function otherGaitNote(store, showGait) {
  const element = h("p", { class: "why", hidden: true });
  return {
    element,
    show(tracks) {
      const { selected, gaits } = store.state;
      const wanted = tracks.map(({ gait }) => gait).find((gait) => gait && gait !== selected);
      const line = gaits.find(({ id }) => id === wanted);
      element.hidden = !line;
      if (!line) return;
      const show = h("button", {
        class: "link",
        text: `Show ${line.name}`,
        on: { click: () => showGait(wanted) },
      });
      element.replaceChildren("The shown gait is not the gait of this trial. ", show);
    },
  };
}

/** The switch for some trials; tracks that come when `isCurrent` no longer holds are dropped. */
function tracksPart(ids, { store, showGait, isCurrent }) {
  const box = h("input", { type: "checkbox", "aria-label": "Tracks in 3D" });
  box.checked = recalled(LAYER, { on: true }).on;
  const note = h("p", { class: "quiet" });
  const [lap, other] = [lapChoice(), otherGaitNote(store, showGait)];
  let tracks = [];

  const refresh = attempt(async () => {
    const wanted = lap.chosen();
    const found = box.checked ? await Promise.all(ids.map((id) => comparisonApi.scene(id, wanted))) : [];
    if (!isCurrent() || Boolean(found.length) !== box.checked || wanted !== lap.chosen()) return;
    tracks = found;
    note.hidden = !tracks.length;
    if (tracks.length) setText(note, words(tracks));
    lap.show(tracks);
    other.show(tracks);
    store.set({ tracks });
  });

  box.addEventListener("change", () => {
    remember(LAYER, { on: box.checked });
    refresh();
  });
  lap.select.addEventListener("change", refresh);
  const choice = h("div", { class: "tracks-choice" }, h("label", {}, box, "Tracks in 3D"), lap.element);
  return {
    element: h("div", { class: "trial-tracks" }, choice, note, other.element),
    updateGait: () => other.show(tracks),
    refresh,
  };
}

/**
 * Makes parts with the switch; one at a time is in use.
 * @param {import("../state/store.js").Store} store
 * @param {(gait: string) => void} showGait
 * @returns {(ids: string[]) => {element: HTMLElement, refresh: () => Promise<void>, leave: () => void}} a
 *   part for some trials; `leave` takes their tracks away
 */
export function tracksParts(store, showGait) {
  let current = null;
  store.watch(
    ({ selected, gaits }) => [selected, gaits],
    () => current?.updateGait(),
  );

  return (ids) => {
    const part = tracksPart(ids, { store, showGait, isCurrent: () => current === part });
    current = part;
    return {
      element: part.element,
      refresh: part.refresh,
      leave() {
        if (current !== part) return;
        current = null;
        store.set({ tracks: [] });
      },
    };
  };
}
