/**
 * Questions to the user. A dialog locks the page but for Stop, which lies over its scrim and can be reached by Tab.
 */

import { byId, h, setInert } from "./dom.js";

/** Everything beside the dialog and Stop. */
const others = () =>
  [...document.body.children]
    .filter(({ id }) => !["dialogs", "announcer"].includes(id))
    .flatMap((part) =>
      part.contains(byId("stop")) ? [...part.children].filter(({ id }) => id !== "stop") : [part],
    );

let locked = [];

function lock() {
  if (locked.length) return;
  locked = others();
  locked.forEach((part) => setInert(part, "dialog", true));
}

function unlock() {
  locked.forEach((part) => setInert(part, "dialog", false));
  locked = [];
}

/**
 * Opens what `build(close)` makes; resolves to what `close` is given, or to null after Escape.
 * @param {(close: (value: any) => void) => HTMLElement} build
 * @param {() => void} [opened] called once it is open
 */
export function openDialog(build, opened = () => {}) {
  return new Promise((resolve) => {
    const before = document.activeElement;
    const close = (value) => {
      byId("dialogs").replaceChildren();
      unlock();
      before?.focus?.();
      resolve(value);
    };
    const dialog = build(close);
    dialog.addEventListener("keydown", (event) => {
      if (event.key !== "Escape") return;
      event.preventDefault();
      close(null);
    });
    byId("dialogs").replaceChildren(h("div", { class: "scrim", "aria-hidden": "true" }), dialog);
    lock();
    (dialog.querySelector("input") ?? dialog.querySelector("button")).focus();
    opened();
  });
}

/** A dialog's frame: its title, and a form that `accept` takes. */
export function dialogFrame(title, close, accept, ...content) {
  const id = "dialog-title";
  const submit = (event) => {
    event.preventDefault();
    accept();
  };
  return h(
    "div",
    { class: "dialog", role: "dialog", "aria-modal": "true", "aria-labelledby": id },
    h("form", { on: { submit } }, h("h3", { id, text: title }), ...content),
  );
}

/** Asks for a name; resolves to it, or to null where the user thought better of it. */
export function askName(title, sentence, value = "") {
  return openDialog((close) => {
    const input = h("input", {
      "aria-label": "Your name",
      placeholder: "Your name",
      maxlength: "60",
      autocomplete: "name",
      required: true,
      value,
    });
    const accept = () => {
      if (input.value.trim()) close(input.value.trim());
    };
    return dialogFrame(
      title,
      close,
      accept,
      h("p", { class: "quiet", text: sentence }),
      input,
      h(
        "div",
        { class: "buttons" },
        h("button", { type: "button", text: "Cancel", on: { click: () => close(null) } }),
        h("button", { type: "submit", class: "primary", text: "Continue" }),
      ),
    );
  });
}

/** Asks before something that moves the robot; resolves to true or null. */
export function confirmAction(title, sentence, label) {
  return openDialog((close) =>
    dialogFrame(
      title,
      close,
      () => close(true),
      h("p", { text: sentence }),
      h(
        "div",
        { class: "buttons" },
        h("button", { type: "button", text: "Cancel", on: { click: () => close(null) } }),
        h("button", { type: "submit", class: "primary", "data-robot": true, text: label }),
      ),
    ),
  );
}

/** Closes whatever dialog is open; true if there was one. */
export function dialogOpen() {
  return byId("dialogs").childElementCount > 0;
}
