/** The drawer of published experiments, which takes the whole page and is loaded when it is first opened. */

import { byId } from "../lib/dom.js";
import { report } from "../lib/toasts.js";
import { drawerIsOpen, onDrawer, openDrawer } from "../shell/drawers.js";
import { runIsOn } from "../state/store.js";

const NAME = "published";

/**
 * Fills the drawer when it is opened. It gives way to the steps and to a run.
 * @param {import("../state/store.js").Store} store
 * @returns {() => boolean} closes the drawer; true where it was open
 */
export function mountPublishedEntry(store) {
  let loading = null;
  const leave = () => drawerIsOpen(NAME) && openDrawer(null);

  async function open() {
    try {
      loading ??= import("./published.js").then(({ mountPublished }) => mountPublished(store));
      const panel = await loading;
      if (drawerIsOpen(NAME)) panel.open();
    } catch (error) {
      loading = null;
      report(error);
    }
  }

  onDrawer(NAME, { opened: open });
  const steps = byId("tab-design").parentElement;
  steps.addEventListener("click", leave);
  steps.addEventListener(
    "keydown",
    ({ key }) => {
      if (key === "ArrowLeft" || key === "ArrowRight") leave();
    },
    true,
  );
  store.watch(
    ({ robot }) => [runIsOn(robot)],
    ({ robot }) => {
      if (runIsOn(robot)) leave();
    },
  );
  return leave;
}
