/** How far a number can go while everything else of a drawing stays: said beside it while it changes. */

import { api } from "../api/gaits.js";
import { h } from "../lib/dom.js";
import { fixed } from "../lib/format.js";
import { isDrawing } from "./live_plan.js";

/**
 * The hint of a field; empty where the field has no `limit`.
 * @param {import("./store.js").Store} store
 * @param {import("./fields.js").NumberField} field
 */
export function limitHint(store, field) {
  const element = h("span", { class: "field-limit", role: "status", hidden: true });
  /** @type {AbortController|null} */
  let asked = null;
  return {
    element,
    /**
     * Asks once a change; the number's own value plays no part.
     * @param {import("../document/drawable.js").GaitDocument} document
     */
    async begin(document) {
      if (!field.limit || !isDrawing(document)) return;
      const mine = new AbortController();
      asked?.abort();
      asked = mine;
      const value = await api
        .limit(store.state.selected, { document, which: field.limit }, mine.signal)
        .catch(() => null);
      if (asked !== mine || value === null) return;
      element.textContent = `Possible up to ${fixed(field.fromSI?.(value))} ${field.unit}`;
      element.hidden = false;
    },
    end() {
      asked?.abort();
      asked = null;
      element.hidden = true;
    },
  };
}
