/** What is wrong with the studio's database, for as long as it is so. */

import { byId, setText } from "../lib/dom.js";

/** Shows over the preview what the studio says of its database; nothing where all is well. */
export function mountStorageNotice(store) {
  store.watch(
    ({ storage }) => [storage?.sentence, storage?.damaged],
    ({ storage }) => {
      const notice = byId("storage-notice");
      notice.hidden = !storage?.sentence;
      notice.dataset.tone = storage?.damaged ? "bad" : "caution";
      setText(notice, storage?.sentence ?? "");
    },
  );
}
