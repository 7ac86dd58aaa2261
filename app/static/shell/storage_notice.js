/** What is wrong with the studio's database, for as long as it is so. */

import { byId, h, setText } from "../lib/dom.js";
import { unreadableRow } from "./unreadable_rows.js";

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
