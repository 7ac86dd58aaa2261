/** A switch that lays trials' tracks over the gait in 3D, with how the robot stood and which gait is shown. */

import { recalled, remember } from "./check_menu.js";
import { h, setText } from "./dom.js";
import { fixed } from "./format.js";
import { attempt } from "./toasts.js";
import { besideApi } from "./trial_beside.js";

const LAYER = "trial-tracks";
const FOLLOWS = "Rings follow the playhead; grey is unseen.";

/** How the robot stood, and what the playhead does. */
function words(tracks) {
  if (tracks.length > 1) return `${tracks.length} tracks, each turned back by how its robot stood. ${FOLLOWS}`;
  const [{ turn_deg: turn, gaps_mm: gaps, laps }] = tracks;
  const rings = laps > 1 ? `Rings follow the playhead over the first of ${laps} rounds; grey is unseen.` : FOLLOWS;
  return `Turned back by the robot's ${fixed(turn, 1)}°, feet of the first frame ± ${fixed(Math.max(...gaps), 1)} mm. ${rings}`;
}

/**
 * Makes parts with the switch; one at a time is in use.
 * @param {object} store
 * @param {(gait: string) => void} showGait
 * @returns {(ids: string[]) => {element: HTMLElement, refresh: () => Promise<void>, leave: () => void}} a part for some
 *   trials; `leave` takes their tracks away
 */
export function tracksParts(store, showGait) {
  let current = null;
  store.watch(({ selected, gaits }) => [selected, gaits], () => current?.tellGait());

  return (ids) => {
    const box = h("input", { type: "checkbox", "aria-label": "Tracks in 3D" });
    box.checked = recalled(LAYER, { on: true }).on;
    const [note, other] = [h("p", { class: "quiet" }), h("p", { class: "why", hidden: true })];
    let tracks = [];

    /** Says so where another gait is shown than the trials'. */
    function tellGait() {
      const { selected, gaits } = store.state;
      const wanted = tracks.map(({ gait }) => gait).find((gait) => gait && gait !== selected);
      const line = gaits.find(({ id }) => id === wanted);
      other.hidden = !line;
      if (!line) return;
      const show = h("button", { class: "link", text: `Show ${line.name}`, on: { click: () => showGait(wanted) } });
      other.replaceChildren("Another gait is shown than this trial's. ", show);
    }

    const part = {
      element: h("div", { class: "trial-tracks" }, h("label", {}, box, "Tracks in 3D"), note, other),
      tellGait,
      refresh: attempt(async () => {
        const found = box.checked ? await Promise.all(ids.map(besideApi.scene)) : [];
        if (current !== part || Boolean(found.length) !== box.checked) return;
        tracks = found;
        note.hidden = !tracks.length;
        if (tracks.length) setText(note, words(tracks));
        tellGait();
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
    current = part;
    return part;
  };
}
