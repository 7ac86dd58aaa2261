/** The pinned poses of a gait for the robot's clock: how to pin one, which there are, and a way to let each go. */

import { pinWords, pinnedOf, withoutPinned } from "../document/pinned_poses.js";
import { h } from "../lib/dom.js";
import { shownDocument } from "../state/store.js";

const HOW = "Pause at a pose and drag its mark in the 3D preview: the body is kept there, and the rest is solved anew.";

/** The list, hidden for every other gait. */
export function pinnedPoses(store, edits, goTo) {
  const list = h("ul", { class: "pinned", role: "list", "aria-label": "Pinned poses" });
  const element = h("div", { hidden: true }, h("p", { class: "why", text: HOW }), list);
  const line = (pin) => h("li", {},
    h("button", { class: "link", text: `Pose ${pin.pose}`, title: "Show it", on: { click: () => goTo({ sample: pin.pose - 1, foot: null }) } }),
    h("span", { text: pinWords(pin) }),
    h("button", { class: "link", text: "Let go", "aria-label": `Let pose ${pin.pose} go`, on: { click: () => edits.edit((document) => withoutPinned(document, pin.pose), `Let pose ${pin.pose} go`) } }));
  store.watch(({ view, pending, gesture }) => [view, pending, gesture], (state) => {
    const document = shownDocument(state);
    element.hidden = !document?.poses;
    const pinned = document ? pinnedOf(document) : [];
    const key = JSON.stringify(pinned);
    if (list.dataset.shown === key) return;
    list.dataset.shown = key;
    list.replaceChildren(...pinned.map(line));
  });
  return element;
}
