/**
 * Questions to the user. They float and do not lock the page, because Stop must stay within reach.
 */

import { byId, h } from "./dom.js";

function open(build) {
  return new Promise((resolve) => {
    const before = document.activeElement;
    const close = (value) => {
      dialog.remove();
      before?.focus?.();
      resolve(value);
    };
    const dialog = build(close);
    dialog.addEventListener("keydown", (event) => {
      if (event.key !== "Escape") return;
      event.preventDefault();
      close(null);
    });
    byId("dialogs").replaceChildren(dialog);
    (dialog.querySelector("input") ?? dialog.querySelector("button")).focus();
  });
}

function frame(title, close, accept, ...content) {
  const id = "dialog-title";
  const submit = (event) => { event.preventDefault(); accept(); };
  return h("div", { class: "dialog", role: "dialog", "aria-labelledby": id },
    h("form", { on: { submit } }, h("h3", { id, text: title }), ...content));
}

/** Asks for a name; resolves to it, or to null where the user thought better of it. */
export function askName(title, sentence, value = "") {
  return open((close) => {
    const input = h("input", { "aria-label": "Your name", placeholder: "Your name", maxlength: "60", autocomplete: "name", required: true, value });
    const accept = () => { if (input.value.trim()) close(input.value.trim()); };
    return frame(title, close, accept, h("p", { class: "quiet", text: sentence }), input,
      h("div", { class: "buttons" },
        h("button", { type: "button", text: "Not now", on: { click: () => close(null) } }),
        h("button", { type: "submit", class: "primary", text: "Continue" })));
  });
}

/** Asks before something that moves the robot; resolves to true or null. */
export function confirmAct(title, sentence, label) {
  return open((close) => frame(title, close, () => close(true), h("p", { text: sentence }),
    h("div", { class: "buttons" },
      h("button", { type: "button", text: "Leave it", on: { click: () => close(null) } }),
      h("button", { type: "submit", class: "primary", "data-robot": true, text: label }))));
}

const KEYS = [
  ["Space", "Play or pause the preview. Never starts the robot."],
  ["Esc", "Stop the robot while a run is on; otherwise leave the drag or dialog"],
  ["Left, Right", "One sample; with Shift ten"],
  ["Home, End", "First and last sample"],
  ["L", "Loop"],
  ["Ctrl+Z", "Undo"],
  ["Ctrl+Shift+Z, Ctrl+Y", "Redo"],
  ["Ctrl+S", "Save"],
  ["Arrows, Space", "In the timeline: move between cells, toggle the cell"],
  ["?", "This list"],
];

/** Shows the keyboard. */
export function showKeys() {
  if (byId("dialogs").firstElementChild) return;
  open((close) => frame("Keyboard", close, () => close(null),
    h("dl", {}, ...KEYS.flatMap(([key, does]) => [h("dt", {}, h("kbd", { text: key })), h("dd", { text: does })])),
    h("div", { class: "buttons" }, h("button", { type: "submit", text: "Close" }))));
}

/** Closes whatever dialog is open; true if there was one. */
export function dialogOpen() {
  return byId("dialogs").childElementCount > 0;
}
