/** A gait's file that was changed outside the studio: what happened, and the two ways out of it. */

import { api } from "../api/gaits.js";
import { byId, h } from "../lib/dom.js";
import { attempt } from "../lib/toasts.js";
import { acceptView } from "../state/store.js";

const USE_FILE =
  "Replace this gait with the content of the changed file. Undo brings back the gait that you see now";
const KEEP_MINE =
  "Write the gait to its file again, as the studio last saved it. "
  + "The studio moves the changed file to the folder set-aside";

/**
 * Shows over the preview that the shown gait's file was changed, for as long as it is so.
 * @param {import("../state/store.js").Store} store
 * @param {{settled: () => Promise<void>}} edits what was done before is kept, whichever document is taken
 */
export function mountFileNotice(store, edits) {
  const settle = (keep) =>
    attempt(async () => {
      const { selected } = store.state;
      await edits.settled();
      acceptView(store, await api.settleFile(selected, keep));
    });
  const sentence = h("p", {});
  const notice = byId("file-notice");
  notice.append(
    sentence,
    h(
      "div",
      { class: "buttons" },
      h("button", { text: "Use the file", title: USE_FILE, on: { click: settle("file") } }),
      h("button", { text: "Keep mine", title: KEEP_MINE, on: { click: settle("mine") } }),
    ),
  );
  store.watch(
    ({ view, selected }) => [view?.outside, view?.id === selected],
    ({ view, selected }) => {
      const outside = view?.id === selected ? view.outside : null;
      notice.hidden = !outside;
      sentence.textContent = outside ?? "";
    },
  );
}
