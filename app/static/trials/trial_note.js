/** The note of a trial, with a choice where somebody else has changed it meanwhile. */

import { h, setText } from "../lib/dom.js";

/**
 * Builds the note's field, which stays while the rest of a trial is drawn again.
 * @param {(note: string) => Promise<*>} keep
 * @returns {{element: HTMLElement, show: (note: string) => void, offer: () => void}} `show` tells what is
 *   kept now; what was typed stays, and `offer` lets it be kept once more
 */
export function notePart(keep) {
  const area = h("textarea", {
    "aria-label": "Note",
    rows: "2",
    maxlength: "4000",
    placeholder: "Note: floor, cable, observations",
  });
  const words = h("span");
  const mine = h("button", { class: "link", text: "Save what I typed" });
  const theirs = h("button", { class: "link", text: "Use the saved note" });
  const choice = h(
    "p",
    { class: "why", role: "group", "aria-label": "Two notes", hidden: true },
    words,
    " ",
    mine,
    " · ",
    theirs,
  );
  let known = "";

  const typed = () => area.value.trim();

  function offer() {
    choice.hidden = typed() === known;
    setText(words, known ? `The saved note is “${known}”.` : "The saved note is empty.");
  }

  area.addEventListener("change", () => {
    if (choice.hidden && typed() !== known) keep(typed());
  });
  mine.addEventListener("click", () => {
    choice.hidden = true;
    keep(typed());
  });
  theirs.addEventListener("click", () => {
    area.value = known;
    choice.hidden = true;
  });
  return {
    element: h("div", { class: "trial-note" }, area, choice),
    offer,
    show(note) {
      const isTyped = typed() !== known;
      const isOther = note !== known;
      known = note;
      if (!isTyped) area.value = note;
      else if (isOther || !choice.hidden) offer();
    },
  };
}
