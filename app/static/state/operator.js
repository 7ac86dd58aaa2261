/** The operator's name: asked once, kept in this browser. */

import { askName } from "../lib/dialogs.js";

/** @typedef {import("./store.js").Store} Store */

const KEY = "footfall.operator";

function remembered() {
  try {
    return localStorage.getItem(KEY) ?? "";
  } catch {
    return "";
  }
}

/** @param {string} name */
function remember(name) {
  try {
    localStorage.setItem(KEY, name);
  } catch {
    return;
  }
}

/** Puts the remembered name into the store. @param {Store} store */
export function recallOperator(store) {
  store.set({ operator: remembered() });
}

/**
 * Resolves to the operator's name, asking where it is not known; null where the user declines.
 * @param {Store} store
 * @param {string} [why]
 * @returns {Promise<string|null>}
 */
export async function needOperator(store, why) {
  if (store.state.operator) return store.state.operator;
  return changeOperator(store, why);
}

/**
 * Asks for another name.
 * @param {Store} store
 * @param {string} [why]
 * @returns {Promise<string|null>}
 */
export async function changeOperator(
  store,
  why = "The studio saves your name with each approval and each run.",
) {
  const name = await askName("Who is working here?", why, store.state.operator);
  if (!name) return null;
  remember(name);
  store.set({ operator: name });
  return name;
}
