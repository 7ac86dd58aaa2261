/** The gaits that were deleted, and the way back for each. */

import { api } from "../api/gaits.js";
import { dialogFrame, openDialog } from "../lib/dialogs.js";
import { h } from "../lib/dom.js";
import { clockTime } from "../lib/format.js";
import { toast } from "../lib/toasts.js";

const NONE = "No gait is deleted: there is nothing to bring back.";

/** Why the list cannot be shown: null where there is something in it. */
export const noneDeleted = async () => ((await api.deleted()).length ? null : NONE);

function row({ id, name, when }, close) {
  return h("li", {}, h("span", { class: "deleted-name" }, h("b", { text: name }), h("small", { class: "quiet", text: `deleted ${clockTime(when)}` })),
    h("button", { type: "button", "aria-label": `Bring back ${name}`, text: "Bring back", on: { click: () => close(id) } }));
}

/**
 * Lists what was deleted and brings back what is chosen.
 * @param {(id: string) => Promise<void>} show shows a gait
 */
export async function bringBack(show) {
  const gaits = await api.deleted();
  if (!gaits.length) {
    toast(NONE);
    return;
  }
  const id = await openDialog((close) => dialogFrame("Deleted gaits", close, () => close(null),
    h("p", { class: "quiet", text: "A gait comes back with its unsaved edits, its versions and its undo history." }),
    h("ul", { class: "deleted-gaits", "aria-label": "Deleted gaits" }, ...gaits.map((gait) => row(gait, close))),
    h("div", { class: "buttons" }, h("button", { type: "submit", text: "Close" }))));
  if (!id) return;
  await api.restore(id);
  await show(id);
}
