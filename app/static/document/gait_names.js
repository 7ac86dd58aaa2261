/** Gait names that are still free. */

/**
 * The name, with a number where another gait has it already.
 * @param {{gaits: Record<string, any>[]}} state
 * @param {string} base
 */
export function freeName({ gaits }, base) {
  const names = new Set(gaits.map(({ name }) => name));
  let name = base;
  for (let count = 2; names.has(name); count += 1) name = `${base} ${count}`;
  return name;
}
