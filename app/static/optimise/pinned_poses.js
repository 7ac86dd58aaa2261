/** The pinned poses of a gait for the robot's clock: how to pin one, and a way to let each go. */

import { pinWords, pinnedOf, withoutPinned } from "../document/pinned_poses.js";
import { h, setText } from "../lib/dom.js";
import { shownDocument } from "../state/store.js";

const HOW =
  "To pin a pose, pause at this pose. Then drag the mark of the pose in the 3D preview, or move "
  + "the mark with the arrow keys. "
  + "The search then keeps the body at this place and computes all other poses again.";
const NOT_HERE =
  "You cannot pin poses of this gait, because it turns, sways, or has a short stop bound that "
  + "can divide moves.";

/** The list, hidden for every other gait. */
export function pinnedPoses(store, edits, goTo) {
  const list = h("ul", { class: "pinned", role: "list", "aria-label": "Pinned poses" });
  const how = h("p", { class: "why" });
  const element = h("div", { hidden: true }, how, list);
  const letGo = (pose) => () => {
    edits.edit((document) => withoutPinned(document, pose), `Unpin pose ${pose}`);
    (list.querySelector("button") ?? document.getElementById("play")).focus({ preventScroll: true });
  };
  const line = (pin) =>
    h(
      "li",
      {},
      h("button", {
        class: "link",
        text: `Pose ${pin.pose}`,
        title: "Show this pose",
        on: { click: () => goTo({ sample: pin.pose - 1, foot: null }) },
      }),
      h("span", { text: pinWords(pin) }),
      h("button", {
        class: "link",
        text: "Unpin",
        "aria-label": `Unpin pose ${pin.pose}`,
        on: { click: letGo(pin.pose) },
      }),
    );
  store.watch(
    ({ view, pending, gesture }) => [view, pending, gesture],
    (state) => {
      const gait = shownDocument(state);
      element.hidden = !gait?.poses;
      setText(how, state.view?.plan?.poses?.pinnable === false ? NOT_HERE : HOW);
      const pinned = gait ? pinnedOf(gait) : [];
      const key = JSON.stringify(pinned);
      if (list.dataset.shown === key) return;
      list.dataset.shown = key;
      list.replaceChildren(...pinned.map(line));
    },
  );
  return element;
}
