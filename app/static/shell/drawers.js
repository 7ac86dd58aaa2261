/** The rail at the left, and the drawers that its buttons open beside the stage: one at a time. */

import { byId, h, icon, setAttribute, setText } from "../lib/dom.js";
import { remember, remembered } from "../lib/remembered.js";
import { jobIsOn } from "./job_list.js";

const NAMES = ["gaits", "jobs", "runs", "trials", "published"];
const KEY = "drawer";
/** Drawers lie over the stage in a narrow window, so that none is open there until somebody opens it. */
const ROOMY = "(min-width: 1000px)";

let current = null;
const followers = {};

/** Registers what a drawer does when it is opened and closed. */
export function onDrawer(name, { opened = () => {}, closed = () => {} }) {
  followers[name] = { opened, closed };
  if (current === name) opened();
}

export const drawerIsOpen = (name) => current === name;

function show(name) {
  current = name;
  for (const one of NAMES) {
    byId(`drawer-${one}`).hidden = one !== name;
    setAttribute(byId(`rail-${one}`), "aria-expanded", String(one === name));
  }
  setAttribute(document.body, "data-drawer", name);
}

/**
 * Opens a drawer; null closes the one that is open. Returns whether anything changed. `isKept`: whether this
 * browser remembers it.
 */
export function openDrawer(name, { isKept = true } = {}) {
  const before = current;
  if (before === name) return false;
  const hadFocus = byId("drawers").contains(document.activeElement);
  show(name);
  if (before) followers[before]?.closed();
  if (name) followers[name]?.opened();
  if (hadFocus && !document.activeElement.checkVisibility()) byId(`rail-${before}`).focus();
  if (isKept) remember(KEY, { name: name ?? "" });
  return true;
}

/** Closes a drawer that lies over the stage. */
export function closeOverStage() {
  if (!matchMedia(ROOMY).matches) openDrawer(null, { isKept: false });
}

/** Folds the open drawer, or opens the one that was open last. */
export function foldDrawer() {
  const last = byId("drawers").dataset.last ?? NAMES[0];
  if (current) byId("drawers").dataset.last = current;
  openDrawer(current ? null : last);
}

function closeButton(name) {
  return h(
    "button",
    {
      class: "plain icon-only",
      "aria-label": `Close ${name}`,
      title: "Close",
      on: { click: () => openDrawer(null) },
    },
    icon("close"),
  );
}

/** Opens the drawer that was open before; where nobody has chosen yet, the gaits in a roomy window. */
export function mountDrawers(store) {
  for (const name of NAMES) {
    byId(`rail-${name}`).addEventListener("click", () => openDrawer(current === name ? null : name));
    byId(`drawer-${name}`).querySelector("header")?.append(closeButton(name));
  }
  const kept = remembered(KEY).name;
  const wanted = kept === undefined ? "gaits" : kept;
  show(NAMES.includes(wanted) && matchMedia(ROOMY).matches ? wanted : null);
  store.watch(
    ({ jobs }) => [jobs],
    ({ jobs }) => {
      const count = jobs.filter(jobIsOn).length;
      byId("jobs-count").hidden = count === 0;
      setText(byId("jobs-count"), String(count));
      setAttribute(byId("rail-jobs"), "aria-description", count ? `${count} running` : null);
    },
  );
}
