/** Choices that this browser keeps from visit to visit. */

/**
 * The object that was kept under a name; empty where there is none.
 * @param {string} name
 * @returns {Record<string, any>}
 */
export function remembered(name) {
  try {
    return JSON.parse(localStorage.getItem(`footfall.${name}`) ?? "null") ?? {};
  } catch {
    return {};
  }
}

/**
 * The defaults, with each value that was kept and has the type of its default.
 * @param {string} name
 * @param {Record<string, any>} defaults
 * @returns {Record<string, any>}
 */
export function recalled(name, defaults) {
  const kept = remembered(name);
  return Object.fromEntries(
    Object.entries(defaults).map(([key, value]) => [
      key,
      typeof kept[key] === typeof value ? kept[key] : value,
    ]),
  );
}

/**
 * Keeps an object under a name.
 * @param {string} name
 * @param {Record<string, any>} choice
 */
export function remember(name, choice) {
  try {
    localStorage.setItem(`footfall.${name}`, JSON.stringify(choice));
  } catch {
    // Private windows may refuse: the choice then lasts as long as the page.
  }
}
