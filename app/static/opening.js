/** What a person sees first: the list of gaits. The page's other modules are read meanwhile. */

import { listen } from "./events.js";
import { mountGaits, selectAfterHello } from "./gaits.js";
import { createStore } from "./store.js";
import { report } from "./toasts.js";

const store = createStore();
mountGaits(store);
listen(store, () => selectAfterHello(store));

import("./main.js").then(({ start }) => start(store), (error) => {
  report(new Error(`The page could not be loaded whole: ${error.message}. Reload it.`));
});
