/** The tool row of the timeline: what a drag does, operations with their preview, and the zoom. */

import { byId, h, onPress, setAllowed, setAttribute } from "../lib/dom.js";
import { openAmount } from "./timeline_amount.js";
import { menuButton } from "./timeline_menu.js";
import { whyNotDrawn } from "../document/drawable.js";
import { OPERATIONS } from "../document/operations.js";
import { toast } from "../lib/toasts.js";

const TOOLS = {
  paint: [
    "Paint",
    "Paint (B): click a cell to change it. Drag to paint cells or to move a swing. "
      + "Drag with Shift to lock cells, or with Ctrl to select cells",
  ],
  select: [
    "Select",
    "Select: drag to select cells, or double-click to select a swing. "
      + "Drag selected cells to move them, or with Alt to copy them. "
      + "With every tool, Ctrl+drag selects cells",
  ],
  lock: [
    "Lock",
    "Lock: drag to lock cells, so that no edit can change them. "
      + "To unlock cells, start the drag on a locked cell. "
      + "With every tool, Shift+drag locks cells, and the key K locks the selected cells",
  ],
};

function toolGroup(store) {
  const buttons = Object.entries(TOOLS).map(([tool, [text, title]]) =>
    h("button", { text, title, "aria-pressed": "false", data: { tool } }),
  );
  buttons.forEach((button) => onPress(button, () => store.set({ tool: button.dataset.tool }), toast));
  store.watch(
    ({ view }) => [view?.document],
    ({ view }) => {
      const whyNot = whyNotDrawn(view?.document);
      buttons.forEach((button) =>
        setAllowed(button, button.dataset.tool === "select" ? null : whyNot, TOOLS[button.dataset.tool][1]),
      );
    },
  );
  store.watch(
    ({ tool }) => [tool],
    ({ tool }) => {
      buttons.forEach((button) => setAttribute(button, "aria-pressed", String(button.dataset.tool === tool)));
      byId("timeline").dataset.tool = tool;
    },
  );
  return h("div", { class: "segmented", role: "group", "aria-label": "What a drag does" }, ...buttons);
}

/** A button of an operation: shows its preview under pointer or focus, and explains why it cannot be used. */
function operationButton(store, actions, id, open) {
  const { name, help, amount } = OPERATIONS[id];
  const button = h("button", { text: amount ? `${name}…` : name, class: `op-${id}` });
  const show = () => {
    if (button.getAttribute("aria-disabled") !== "true") actions.preview(id);
  };
  if (!amount) {
    for (const type of ["pointerenter", "focus"]) button.addEventListener(type, show);
    for (const type of ["pointerleave", "blur"]) button.addEventListener(type, actions.dropPreview);
  }
  onPress(button, () => (amount ? open(id, button) : actions.act(id)), toast);
  store.watch(
    (state) => [state.view, state.pending, state.selection],
    (state) => {
      const reason = !state.view
        ? "No gait is selected."
        : amount
          ? whyNotDrawn(state.view.document)
          : actions.outcome(id).reason;
      setAllowed(button, reason, `${help}. Works on ${actions.scope()}`);
    },
  );
  return button;
}

function zoomGroup(store, zoom) {
  const button = (label, title, text, click) =>
    h("button", { class: "icon-only", "aria-label": label, title, text, on: { click } });
  const fit = h("button", { class: "fit", text: "Fit", title: "Show the whole timeline (F)" });
  onPress(fit, zoom.fit);
  store.watch(
    (state) => [state.zoom],
    (state) =>
      setAllowed(
        fit,
        state.zoom ? null : "The whole timeline is already shown.",
        "Show the whole timeline (F)",
      ),
  );
  return h(
    "div",
    { class: "segmented zoom", role: "group", "aria-label": "Zoom" },
    button("Zoom out", "Zoom out (−, or Ctrl and the mouse wheel)", "−", () => zoom.closer(false)),
    button("Zoom in", "Zoom in (+, or Ctrl and the mouse wheel)", "+", () => zoom.closer(true)),
    fit,
  );
}

/**
 * Builds the tool row.
 * @returns {{close: () => boolean}} `close` drops an open menu, popover or preview
 */
export function mountTools(store, actions, zoom, selectAll) {
  const place = byId("tools");
  let popover = null;
  const close = () => {
    const opened = popover;
    popover = null;
    opened?.close();
    return actions.dropPreview() || opened !== null;
  };
  const open = (id, anchor) => {
    close();
    popover = openAmount({ actions, id, place, anchor, close });
  };
  const menu = menuButton({
    store,
    actions,
    place,
    open,
    close,
    selectAll,
    opened: (one) => {
      popover = one;
    },
  });
  place.append(
    toolGroup(store),
    operationButton(store, actions, "mirror", open),
    operationButton(store, actions, "stretch", open),
    menu,
    zoomGroup(store, zoom),
  );
  document.addEventListener(
    "pointerdown",
    (event) => {
      const target = /** @type {Element} */ (event.target);
      if (popover && !place.contains(target) && !target.closest?.("#chart")) close();
    },
    true,
  );
  store.watch(({ selected }) => [selected], close);
  store.watch(
    (state) => [state.view, state.pending, state.selection],
    () => popover?.refresh(),
  );
  return { close };
}
