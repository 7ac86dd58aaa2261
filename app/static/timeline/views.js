/** The views of the lower part: the cells, the segment table, and the search of footfall patterns. */

import { byId, onPress, setAllowed, setAttribute } from "../lib/dom.js";
import { toast } from "../lib/toasts.js";
import { shownDocument } from "../state/store.js";

const NAMES = ["cells", "segments", "patterns"];

let current = "cells";
const followers = [];

/** The view that is shown: `cells`, `segments` or `patterns`. */
export const openedView = () => current;

/** Calls `act` with the name of each view that is opened. */
export function onView(act) {
  followers.push(act);
}

/** Shows a view. */
export function openView(name) {
  current = name;
  setAttribute(document.body, "data-view", name);
  for (const one of NAMES) {
    setAttribute(byId(`view-${one}`), "aria-selected", String(one === name));
    byId(`view-${one}`).tabIndex = one === name ? 0 : -1;
  }
  byId("segments").hidden = name !== "segments";
  followers.forEach((act) => act(name));
}

const NO_TABLE = "A sequence has no segment table. The inspector lists the parts of the sequence.";

/** Builds the tabs; a sequence has no segment table. */
export function mountViews(store) {
  NAMES.forEach((name, index) => {
    const tab = byId(`view-${name}`);
    onPress(tab, () => openView(name), toast);
    tab.addEventListener("keydown", (event) => {
      const to = { ArrowLeft: index - 1, ArrowRight: index + 1 }[event.key];
      if (to === undefined) return;
      event.preventDefault();
      event.stopPropagation();
      const next = byId(`view-${NAMES[(to + NAMES.length) % NAMES.length]}`);
      next.click();
      next.focus();
    });
  });
  openView(current);
  store.watch(
    (state) => [shownDocument(state)?.sequence],
    (state) => {
      const isSequence = Boolean(shownDocument(state)?.sequence);
      setAllowed(
        byId("view-segments"),
        isSequence ? NO_TABLE : null,
        "Opens the segment table, a spreadsheet for gaits made by hand",
      );
      if (isSequence && current === "segments") openView("cells");
    },
  );
}
