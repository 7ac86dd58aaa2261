/** What is wrong with the studio's database: the notice over the preview, and lines of unreadable entries. */

import { api } from "../api/gaits.js";
import { byId, h, setText } from "../lib/dom.js";
import { attempt, toast } from "../lib/toasts.js";

const HELP = "Take this entry out of its list. The studio keeps the entry, and Undo brings it back";

/**
 * An entry that cannot be read.
 * @typedef {{table: string, row: number, noun: string, id: string, sentence: string,
 *   may_be_set_aside: boolean}} Unreadable
 */

/**
 * The line of an entry that cannot be read.
 * @param {Unreadable} entry
 * @param {() => unknown} changed called when it is set aside, and when it is brought back
 */
export function unreadableRow({ table, row, noun, id, sentence, may_be_set_aside: mayGo }, changed) {
  const setAside = attempt(async () => {
    const { number } = await api.setAside(table, row);
    changed();
    const undo = attempt(async () => {
      await api.bringBack(number);
      changed();
    });
    toast(`The ${noun} “${id}” is set aside.`, { action: { label: "Undo", act: undo } });
  });
  const button = h("button", {
    type: "button",
    class: "link",
    text: "Set aside",
    title: HELP,
    "aria-label": `Set aside the ${noun} ${id}`,
    on: { click: setAside },
  });
  return h("li", { class: "why", data: { toneText: "caution" } }, `${sentence} `, mayGo ? button : null);
}

/** Shows over the preview what the studio says of its database; nothing where all is well. */
export function mountStorageNotice(store) {
  const notice = byId("storage-notice");
  const sentence = h("p", {});
  const list = h("ul", { role: "list", "aria-label": "Entries that cannot be read" });
  const details = h("details", {}, h("summary", { text: "Show them" }), list);
  notice.append(sentence, details);
  store.watch(
    ({ storage }) => [storage],
    ({ storage }) => {
      const { rows = [] } = storage?.unreadable ?? {};
      notice.hidden = !storage?.sentence;
      notice.dataset.tone = storage?.damaged ? "bad" : "caution";
      setText(sentence, storage?.sentence ?? "");
      details.hidden = !rows.length;
      list.replaceChildren(...rows.map((entry) => unreadableRow(entry, () => {})));
    },
  );
}
