/** A switch that lays trials' tracks over the gait in 3D, with how the robot stood and which gait is shown. */

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
      ? `The studio rotates the ${tracks.length} tracks, so that the robot has the same heading in the first `
        + "frame of each track."
      : `The studio rotates the track back by ${fixed(turn, 1)}°, the heading of the robot in the first frame. `
        + `Then each foot of the first frame is within ${fixed(Math.max(...gaps), 1)} mm of its expected `
        + "position.";
  return `${stood} Rings show the feet at the playhead. A grey line means that the foot was not seen.`;
}

/**
 * Makes parts with the switch; one at a time is in use.
 * @param {import("../state/store.js").Store} store
 * @param {(gait: string) => void} showGait
 * @returns {(ids: string[]) => {element: HTMLElement, refresh: () => Promise<void>, leave: () => void}} a part for some
 *   trials; `leave` takes their tracks away
 */
export function tracksParts(store, showGait) {
  let current = null;
  store.watch(
    ({ selected, gaits }) => [selected, gaits],
    () => current?.updateGait(),
  );

  return (ids) => {
    const box = h("input", { type: "checkbox", "aria-label": "Tracks in 3D" });
    box.checked = recalled(LAYER, { on: true }).on;
    const [note, other] = [h("p", { class: "quiet" }), h("p", { class: "why", hidden: true })];
    const lap = h("select", {
      "aria-label": "Repetition of the walk",
      title: "The walk repeats the plan several times. Choose which repetition is drawn over the shown gait",
    });
    const ofLaps = h("label", { hidden: true }, "repetition", lap);
    let tracks = [];

    function updateLaps() {
      const count = Math.min(...tracks.map(({ laps }) => laps), Infinity);
      ofLaps.hidden = !(count > 1 && count < Infinity);
      if (ofLaps.hidden || lap.length === count) return;
      lap.replaceChildren(
        ...Array.from({ length: count }, (_, index) =>
          h("option", { value: String(index + 1), text: `${index + 1} of ${count}` }),
        ),
      );
    }

    /** Says so where another gait is shown than the trials'. */
    function updateGait() {
      const { selected, gaits } = store.state;
      const wanted = tracks.map(({ gait }) => gait).find((gait) => gait && gait !== selected);
      const line = gaits.find(({ id }) => id === wanted);
      other.hidden = !line;
      if (!line) return;
      const show = h("button", {
        class: "link",
        text: `Show ${line.name}`,
        on: { click: () => showGait(wanted) },
      });
      other.replaceChildren("The shown gait is not the gait of this trial. ", show);
    }

    const part = {
      element: h(
        "div",
        { class: "trial-tracks" },
        h("div", { class: "tracks-choice" }, h("label", {}, box, "Tracks in 3D"), ofLaps),
        note,
        other,
      ),
      updateGait,
      refresh: attempt(async () => {
        const wanted = lap.value || "1";
        const found = box.checked ? await Promise.all(ids.map((id) => comparisonApi.scene(id, wanted))) : [];
        if (current !== part || Boolean(found.length) !== box.checked || wanted !== (lap.value || "1"))
          return;
        tracks = found;
        note.hidden = !tracks.length;
        if (tracks.length) setText(note, words(tracks));
        updateLaps();
        updateGait();
        store.set({ tracks });
      }),
      leave() {
        if (current !== part) return;
        current = null;
        store.set({ tracks: [] });
      },
    };
    box.addEventListener("change", () => {
      remember(LAYER, { on: box.checked });
      part.refresh();
    });
    lap.addEventListener("change", part.refresh);
    current = part;
    return part;
  };
}
