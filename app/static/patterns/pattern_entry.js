/** The ways to the pattern search, which is loaded when it is first opened: its tab, and the menu Gait. */

import { runIsOn } from "../state/store.js";
import { onStep } from "../steps/steps.js";
import { onView, openedView, openView } from "../timeline/views.js";
import { report } from "../lib/toasts.js";

const KEY = "footfall.patterns.open";

const ENTRIES = [
  {
    mode: "transition",
    text: "Transition to…",
    help: "Searches for the footfall pattern of a transition from this gait to another gait",
  },
  {
    mode: "limbs",
    text: "Gait for some limbs…",
    help:
      "Searches for a gait in which only some limbs walk. "
      + "The other limbs are held up, broken or on the ground",
  },
  {
    mode: "drawing",
    text: "Complete the drawing…",
    help: "Keeps the locked cells of this gait's timeline and searches for the other cells",
  },
];

function remembersOpen(open) {
  try {
    if (open === undefined) return sessionStorage.getItem(KEY) === "1";
    sessionStorage.setItem(KEY, open ? "1" : "0");
  } catch {
    return false;
  }
  return open;
}

/**
 * Builds the entries.
 * @param {import("../state/store.js").Store} store
 * @param {import("./pattern_actions.js").Page & {gaitTools: Record<string, any>}} page
 * @returns {{cancel: () => boolean}} `cancel` ends a drag in the pattern
 */
export function mountPatternEntry(store, page) {
  let [loading, panel, isOpen, wanted] = [null, null, false, null];

  async function open() {
    try {
      loading ??= import("./pattern_view.js").then(({ mountPatterns }) => mountPatterns(store, page));
      panel = await loading;
      if (isOpen) panel.open(wanted);
      wanted = null;
    } catch (error) {
      loading = null;
      report(error);
    }
  }

  onView((name) => {
    isOpen = name === "patterns";
    remembersOpen(isOpen);
    if (isOpen) open();
    else panel?.close();
  });

  // A step is shown where the search has its fields.
  onStep(() => {
    if (openedView() === "patterns") openView("cells");
  });

  const go = (mode) => {
    wanted = mode;
    openView("patterns");
  };
  for (const { mode, ...entry } of ENTRIES)
    page.gaitTools.addAct({ ...entry, group: "Pattern search", act: () => go(mode) });

  let first = true;
  store.watch(
    ({ view }) => [Boolean(view)],
    ({ view, robot }) => {
      if (!view || !first) return;
      first = false;
      if (remembersOpen() && !runIsOn(robot)) openView("patterns");
    },
  );
  return { cancel: () => isOpen && Boolean(panel?.cancel()) };
}
