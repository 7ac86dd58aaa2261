/** Starts the page with the list of gaits, and loads the other modules after it is drawn. */

import { byId, painted } from "./lib/dom.js";
import { listen } from "./state/server_events.js";
import { mountDrawers } from "./shell/drawers.js";
import { mountGaits, selectAfterHello } from "./shell/gait_list.js";
import { createStore } from "./state/store.js";
import { report } from "./lib/toasts.js";

/** A tab in the background is not painted, and a studio that has only just started still reads its files. */
const LONGEST_LIST_MS = 300;

/** The list that comes with the page, as a preload: the greeting waits for a socket and brings the same. */
async function listEarly(store) {
  try {
    const { gaits } = await (await fetch("/api/gaits")).json();
    if (gaits && !store.state.greeted) store.set({ gaits });
  } catch {
    return;
  }
  await painted();
}

const store = createStore();
mountDrawers(store);
mountGaits(store);
listen(store, () => selectAfterHello(store));

const late = new Promise((resume) => {
  setTimeout(resume, LONGEST_LIST_MS);
});
Promise.race([listEarly(store), late])
  .then(() => {
    document.head.append(byId("later-modules").content);
    return import("./editor.js");
  })
  .then(
    ({ start }) => start(store),
    (error) => {
      report(new Error(`Part of the page could not be loaded: ${error.message}. Reload the page.`));
    },
  );
