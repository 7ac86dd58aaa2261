/** The search for the poses of a gait for the robot's clock: how far it is, Cancel, and Search again. */

import { api } from "../api/gaits.js";
import { h } from "../lib/dom.js";
import { paceText } from "../lib/format.js";
import { attempt } from "../lib/toasts.js";

/** What is known of the shown gait's search; events of the same search are newer than its view. */
function searchOf({ view, poseSearch }) {
  const known = view?.search ?? null;
  return known?.state === "running" && poseSearch?.motion === known.motion ? poseSearch : known;
}

/** The box with the search, hidden while none is on. */
export function poseSearch(store) {
  const words = h("p", { role: "status", "aria-label": "Search for poses" });
  const act = (call) => attempt(() => call(store.state.selected));
  const cancel = h("button", {
    text: "Cancel",
    title:
      "Ends the search. "
      + "You then see the last motion, adapted to the new values. "
      + "This motion cannot be sent to the robot",
    on: { click: act(api.cancelSearch) },
  });
  const again = h("button", { text: "Search again", on: { click: act(api.searchAgain) } });
  const element = h(
    "div",
    { class: "box-note", role: "region", "aria-label": "Search", hidden: true },
    words,
    h("div", { class: "buttons" }, cancel, again),
  );
  store.watch(
    (state) => [state.view?.search, state.poseSearch, state.view?.id],
    (state) => {
      const search = searchOf(state);
      element.hidden = !search;
      if (!search) return;
      const running = search.state === "running";
      const fastest = paceText(search);
      const best = fastest && ` ${fastest} so far.`;
      words.textContent = running
        ? `Looking for the fastest motion: ${search.stage.toLowerCase() || "waiting for the solver"}.${best}`
        : `${search.stage} You see the last motion, adapted to the new values. `
          + `This motion cannot be sent to the robot.`;
      [cancel.hidden, again.hidden] = [!running, running];
    },
  );
  return element;
}
