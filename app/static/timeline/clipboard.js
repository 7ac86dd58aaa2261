/**
 * Cells of the timeline on the clipboard: text, a line a foot, 1 stance and 0 swing, for any editor.
 *
 * The system's clipboard is used where the browser allows it; otherwise one of the page's own.
 */

import { byId, isShown } from "../lib/dom.js";

let own = null;

/** The text of a block. */
export const textOf = (block) => block.join("\n");

/**
 * Rows of 1 and 0 from text; blanks, commas, semicolons and tabs between them are passed over.
 * @returns {{block?: string[], reason?: string}} one of the two
 */
export function blockFrom(text) {
  const lines = text
    .split(/\r?\n/)
    .map((line) => line.replace(/[\s,;]/g, ""))
    .filter(Boolean);
  if (lines.length === 0) return { reason: "The clipboard is empty. Copy cells of the timeline first." };
  const wrong = lines.findIndex((line) => /[^01]/.test(line));
  if (wrong >= 0)
    return {
      reason:
        "The clipboard has no timeline cells. "
        + `Line ${wrong + 1} may contain only 1 (stance) and 0 (swing).`,
    };
  const uneven = lines.findIndex((line) => line.length !== lines[0].length);
  if (uneven >= 0)
    return {
      reason:
        `Line ${uneven + 1} of the clipboard has ${lines[uneven].length} samples, `
        + `but line 1 has ${lines[0].length}. All lines must have the same length.`,
    };
  return { block: lines };
}

/** Keeps a block on both clipboards; a browser that refuses its own leaves the page's. */
export async function putBlock(block) {
  own = textOf(block);
  try {
    await navigator.clipboard?.writeText(own);
  } catch (error) {
    if (!(error instanceof DOMException)) throw error;
  }
}

/** What lies on the system's clipboard, or on the page's where that may not be read. */
export async function clipboardText() {
  try {
    return (await navigator.clipboard.readText()) || (own ?? "");
  } catch (error) {
    if (!(error instanceof DOMException) && !(error instanceof TypeError)) throw error;
    return own ?? "";
  }
}

/** Whether copy, cut and paste mean something else: text that is marked or typed, other tables. */
const isElsewhere = (event) => {
  if (!isShown(byId("timeline"))) return true;
  const place = event.target instanceof Element ? event.target : document.activeElement;
  if (
    place?.closest(
      "input, textarea, select, [contenteditable], [role=dialog], #segments, [role=grid]:not(#timeline)",
    )
  )
    return true;
  return event.type !== "paste" && !document.getSelection().isCollapsed;
};

/**
 * Listens to Ctrl+C, Ctrl+X and Ctrl+V.
 * @param {{copy: () => string[]|null, cut: () => string[]|null, paste: (text: string) => void}} actions
 *   `copy` and `cut` give the block to be kept, or null where there is nothing
 */
export function mountClipboard(actions) {
  for (const type of ["copy", "cut"]) {
    document.addEventListener(type, (/** @type {ClipboardEvent} */ event) => {
      const block = isElsewhere(event) ? null : actions[type]();
      if (!block) return;
      own = textOf(block);
      event.clipboardData.setData("text/plain", own);
      event.preventDefault();
    });
  }
  document.addEventListener("paste", (event) => {
    if (isElsewhere(event)) return;
    actions.paste(event.clipboardData.getData("text/plain") || (own ?? ""));
    event.preventDefault();
  });
}
