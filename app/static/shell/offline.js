/** Without the studio all but Stop and looking is off, and the page says why; unsent edits are kept. */

import { byId, setInert, setText } from "../lib/dom.js";

/** A studio that is back within this time was only out of breath. */
const PATIENCE_MS = 1000;
const PARTS = [
  "#drawers",
  ".rail",
  ".inspector-head",
  "#sections",
  ".inspector-foot",
  ".pattern-panel",
  "#tools",
  "#timeline",
  "#parts",
  "#segments",
  ".pattern-view",
  ".gait-pill",
  ".history",
  "#operator",
  "#goal",
  "#pose",
  "#file-notice",
];
const SENTENCE =
  "No connection to the studio. Until the connection is back, "
  + "you can only watch the preview and press Stop. Stop might not reach the robot.";

function sentence({ pending, left }) {
  const unsent = pending.length + left.length;
  if (!unsent) return SENTENCE;
  const [edits, them] = unsent === 1 ? ["one unsent edit", "it"] : [`${unsent} unsent edits`, "them"];
  return `${SENTENCE} This page keeps ${edits}, and sends ${them} when the connection is back.`;
}

/** Switches the parts off while the studio does not answer, and says so. */
export function mountOffline(store) {
  const banner = byId("banner");
  let timer = null;
  const setOff = (isOff) => {
    document.body.toggleAttribute("data-offline", isOff);
    const parts = /** @type {NodeListOf<HTMLElement>} */ (document.querySelectorAll(PARTS.join()));
    for (const part of parts) setInert(part, "offline", isOff);
  };
  store.watch(
    ({ connected, greeted, pending, left }) => [connected, greeted, pending.length, left.length],
    (state) => {
      const isLost = !state.connected && state.greeted;
      banner.hidden = !isLost;
      setText(banner, isLost ? sentence(state) : "");
      if (isLost) timer ??= setTimeout(() => setOff(true), PATIENCE_MS);
      else {
        clearTimeout(timer);
        timer = null;
        setOff(false);
      }
    },
  );
}
