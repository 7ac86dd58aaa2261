/** A number of a field while a person changes it. */

/**
 * @typedef {import("./fields.js").NumberField} NumberField
 * @typedef {import("../document/drawable.js").GaitDocument} GaitDocument
 */

/**
 * A number as text, with at most `decimals` decimals.
 * @param {number|null} value
 * @param {number} decimals
 */
export const textOf = (value, decimals) => (value === null ? "" : String(Number(value.toFixed(decimals))));

/** @param {number|null} value @param {NumberField} field */
const withUnit = (value, field) =>
  value === null ? field.empty : `${textOf(value, field.decimals)} ${field.unit}`.trim();

/**
 * The running change of a number: on screen at once, one edit at the end, or nothing.
 * @param {import("./store.js").Store} store
 * @param {import("./edits.js").Edits} edits
 * @param {NumberField} field
 * @param {ReturnType<typeof import("./limit_hint.js").limitHint>} limit
 */
export function changing(store, edits, field, limit) {
  const { act, write = (document) => document } = field;
  /** @type {number|null|undefined} */
  let value;

  function end() {
    value = undefined;
    limit.end();
    store.set({ gesture: null });
  }

  return {
    get on() {
      return value !== undefined;
    },
    /** @param {number|null|undefined} next */
    show(next) {
      if (value === undefined) limit.begin(edits.shown());
      value = next;
      const apply = (/** @type {GaitDocument} */ document) => (act ? document : write(document, next));
      store.set({ gesture: { apply } });
    },
    commit() {
      if (value === undefined) return;
      const next = value;
      end();
      const before = field.read(edits.shown());
      const same = before === null || next === null ? before === next : Math.abs(before - next) < 1e-9;
      if (same) return;
      if (act) act(next);
      else edits.edit((document) => write(document, next), `${field.name} to ${withUnit(next, field)}`);
    },
    drop() {
      if (value === undefined) return false;
      end();
      return true;
    },
  };
}
