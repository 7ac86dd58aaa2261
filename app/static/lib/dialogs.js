/**
 * Questions to the user. A dialog locks the page but for Stop, which lies over its scrim and can be reached
 * by Tab.
 */

import { byId, h, setInert } from "./dom.js";

/** Everything beside the dialog and Stop. */
const others = () =>
  /** @type {HTMLElement[]} */ ([...document.body.children])
    .filter(({ id }) => !["dialogs", "announcer"].includes(id))
    .flatMap((part) =>
      part.contains(byId("stop"))
        ? /** @type {HTMLElement[]} */ ([...part.children]).filter(({ id }) => id !== "stop")
        : [part],
    );

/** @type {HTMLElement[]} */
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
 * @returns {Promise<any>}
 */
export function openDialog(build, opened = () => {}) {
  return new Promise((resolve) => {
    const before = /** @type {HTMLElement|null} */ (document.activeElement);
    /** @param {any} value */
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
    (dialog.querySelector("input") ?? dialog.querySelector("button"))?.focus();
    opened();
  });
}

/**
 * A dialog's frame: its title, and a form that `accept` takes.
 * @param {string} title
 * @param {(value: any) => void} close
 * @param {() => void} accept
 * @param {...(Node|string|null|false|undefined)} content
 */
export function dialogFrame(title, close, accept, ...content) {
  const id = "dialog-title";
  const submit = (/** @type {Event} */ event) => {
    event.preventDefault();
    accept();
  };
  return h(
    "div",
    { class: "dialog", role: "dialog", "aria-modal": "true", "aria-labelledby": id },
    h("form", { on: { submit } }, h("h3", { id, text: title }), ...content),
  );
}

/**
 * Asks for a name; resolves to it, or to null where the user thought better of it.
 * @param {string} title
 * @param {string} sentence
 * @param {string} [value]
 * @returns {Promise<string|null>}
 */
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

/**
 * Asks before something that moves the robot; resolves to true or null.
 * @param {string} title
 * @param {string} sentence
 * @param {string} label
 * @returns {Promise<true|null>}
 */
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
