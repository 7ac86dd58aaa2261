/** The menu of operations on the selection; the entry under pointer or focus shows its preview. */

import { fitAbove } from "./timeline_amount.js";
import { h, onPress, setAllowed, setAttribute, setText } from "../lib/dom.js";
import { OPERATIONS } from "../document/operations.js";

const COLUMNS = [
  [
    ["Clipboard", ["copy", "cut", "paste", "duplicate", "stance"]],
    ["Cells", ["lock", "unlock", "all", "loop"]],
  ],
  [
    ["Shape", ["mirror", "reverse", "shift", "stretch", "rotate", "repeat"]],
    ["Samples", ["insert", "remove"]],
  ],
];
const HELP =
  "Opens the commands for the selected cells: copy, reverse, shift, insert and others. "
  + "Without a selection, the commands change the whole timeline";
const KEYS = {
  copy: "Ctrl+C",
  cut: "Ctrl+X",
  paste: "Ctrl+V",
  duplicate: "Ctrl+D",
  stance: "Delete",
  lock: "K",
  all: "Ctrl+A",
  loop: "L",
};

/** Further entries of the menu. */
function plainItems(actions, selectAll) {
  return {
    copy: {
      name: "Copy",
      help: "Copies the cells to the clipboard, as rows of 1 (stance) and 0 (swing)",
      act: actions.copyNow,
    },
    cut: { name: "Cut", help: "Copies the cells, then changes them to stance", act: actions.cutNow },
    paste: {
      name: "Paste",
      help:
        "Pastes the copied cells, starting at the first selected cell. "
        + "Without a selection, starts at the focused cell",
      act: actions.pasteNow,
    },
    all: { name: "Select all", help: "Selects all samples of all feet", act: selectAll },
    loop: {
      name: "Loop",
      help: "Repeats the selected samples during playback. Choose Loop again to end the loop",
      act: actions.loop,
    },
  };
}

function itemOf(id, plain, actions) {
  const operation = OPERATIONS[id];
  const { name, help } = operation ?? plain[id];
  const item = h(
    "button",
    { type: "button", role: "menuitem", tabindex: "-1", title: help, data: { id } },
    h("span", { text: operation?.amount ? `${name}…` : name }),
    KEYS[id] && h("kbd", { text: KEYS[id], "aria-hidden": "true" }),
  );
  const start = operation?.amount?.start;
  const reason = () => (operation && !start ? actions.outcome(id).reason : null);
  return { id, item, help, operation, reason };
}

/** Up and down go through the items, Home and End to the ends. */
function roam(event, items, close) {
  if (event.key === "Tab") close();
  const here = items.findIndex(({ item }) => item === document.activeElement);
  const goals = { ArrowDown: here + 1, ArrowUp: here - 1, Home: 0, End: items.length - 1 };
  if (goals[event.key] === undefined) return;
  items[(goals[event.key] + items.length) % items.length].item.focus();
  event.preventDefault();
  event.stopPropagation();
}

function buildMenu({ actions, plain, choose, close }) {
  const note = h("p", { class: "note", role: "status" });
  const scope = h("p", { class: "scope" });
  const items = [];
  const show = (one) => {
    const reason = one.reason();
    const outcome = one.operation && !one.operation.amount && !reason ? actions.preview(one.id) : null;
    setText(note, reason ?? outcome?.note ?? one.help);
    note.dataset.toneText = reason ? "caution" : "";
  };
  const hide = () => actions.dropPreview();
  const groupOf = ([title, ids]) =>
    h(
      "div",
      { class: "op-group", role: "group", "aria-label": title },
      h("h3", { text: title, "aria-hidden": "true" }),
      ...ids.map((id) => {
        const one = itemOf(id, plain, actions);
        items.push(one);
        for (const type of ["pointerenter", "focus"]) one.item.addEventListener(type, () => show(one));
        for (const type of ["pointerleave", "blur"]) one.item.addEventListener(type, hide);
        one.item.addEventListener("click", () => choose(one));
        return one.item;
      }),
    );
  const columns = COLUMNS.map((groups) => h("div", { role: "presentation" }, ...groups.map(groupOf)));
  const refresh = () => {
    setText(scope, `Works on ${actions.scope()}.`);
    for (const one of items) {
      const reason = one.reason();
      setAttribute(one.item, "aria-disabled", reason ? "true" : null);
      setAttribute(one.item, "aria-description", reason ?? one.help);
    }
    setText(note, "Point at a command to see its result on the timeline.");
  };
  // The list may scroll: its first item is in the order of Tab.
  items[0].item.tabIndex = 0;
  const menu = h(
    "div",
    { class: "op-popover edit", role: "presentation" },
    scope,
    note,
    h("div", { class: "op-menu", role: "menu", "aria-label": "Edit the timeline" }, ...columns),
  );
  menu.addEventListener("keydown", (event) => roam(event, items, close));
  refresh();
  return { menu, items, refresh };
}

/**
 * The button that opens the menu.
 * @param {Record<string, any>} page `place` holds the menu, `open` a number's popover;
 *   `opened` gets what is open
 */
export function menuButton({ store, actions, place, open, close, selectAll, opened }) {
  const button = h("button", {
    text: "Edit",
    class: "edit-button",
    "aria-haspopup": "menu",
    "aria-expanded": "false",
  });
  const plain = plainItems(actions, selectAll);

  function choose({ id, operation, reason }) {
    if (reason()) return;
    close();
    if (operation?.amount) return open(id, button);
    button.focus();
    if (operation) actions.act(id);
    else plain[id].act();
  }

  store.watch(
    ({ view }) => [view === null],
    ({ view }) => setAllowed(button, view ? null : "No gait is selected.", HELP),
  );
  onPress(button, () => {
    const wasOpen = button.getAttribute("aria-expanded") === "true";
    close();
    if (wasOpen) return;
    const { menu, items, refresh } = buildMenu({ actions, plain, choose, close });
    fitAbove(place, menu);
    button.setAttribute("aria-expanded", "true");
    const back = () => {
      if (menu.contains(document.activeElement)) button.focus();
      menu.remove();
      button.setAttribute("aria-expanded", "false");
    };
    opened({ close: back, refresh });
    items[0].item.focus();
  });
  return button;
}
