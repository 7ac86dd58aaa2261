/** The list of keys and gestures, grouped by where they hold. */

import { dialogFrame, openDialog } from "../lib/dialogs.js";
import { byId, h } from "../lib/dom.js";

const GROUPS = {
  "Everywhere": [
    ["Space", "Play or pause the preview. Never starts the robot"],
    ["Esc", "Stop the robot while a run is on; otherwise leave the drag, preview, dialog or selection"],
    ["← →", "One sample; with Shift ten"],
    ["Home, End", "First and last sample"],
    ["L", "Loop the selected samples, or all"],
    ["+ − F", "Zoom in, zoom out, show the whole timeline"],
    ["Ctrl+Z", "Undo"],
    ["Ctrl+Y", "Redo; Ctrl+Shift+Z as well"],
    ["Ctrl+S", "Save"],
    ["F6", "The next part of the page; with Shift the one before. Before the top bar comes the button of the next act"],
    ["[ ]", "[ folds the drawer, ] the inspector; the same key opens it again. Design, Simulate, Check & approve and Run open the inspector too"],
    ["?", "This list"],
  ],
  "Cells of the timeline": [
    ["Arrows", "Move between cells; with Ctrl to the next border of a swing"],
    ["Home, End", "To the row's ends; with Ctrl to the first or last cell of all"],
    ["Space, Enter", "Swing or stance, where the keyboard led to the cell"],
    ["Shift+arrows", "Select; with Home and End to the row's ends"],
    ["Shift+Space", "Select the row"],
    ["Ctrl+A", "Select all"],
    ["Ctrl+C, X, V, D", "Copy, cut, paste, duplicate"],
    ["Delete", "To stance"],
    ["K", "Lock the selection or the cell; again unlocks"],
  ],
  "Pointer on the timeline": [
    ["Drag", "What the tool says. Paint: from stance it paints, a swing or its end is moved"],
    ["Alt or B + drag", "Paint over swings too; B alone chooses Paint"],
    ["Shift + drag", "Lock; from a locked cell on unlock"],
    ["Ctrl + drag", "Select cells; Shift + click extends the selection, a click on a row's name selects the row"],
    ["Double click", "With Select: the whole swing; its drag moves it, with Alt a copy"],
    ["Ctrl + wheel", "Zoom; two fingers as well. The wheel alone scrolls"],
  ],
  "Lists and toolbars": [
    ["↑ ↓", "In a list: another line. Home and End: the first and the last one"],
    ["← →", "In a toolbar: the next or previous button. On the tabs: the next or previous tab"],
    ["Enter", "Open it; on Send to robot, held for a second, send it"],
    ["Double click", "A gait's name, to write another one"],
  ],
  "Touch": [
    ["Long press", "What something means: the same words as under the pointer"],
    ["Two fingers", "Zoom the timeline"],
  ],
  "Segment table": [
    ["Letters, Enter", "Choose a segment"],
    ["Delete", "Wait"],
    ["Ctrl+C, X, V", "As in a spreadsheet; Ctrl+D fills down"],
    ["Insert", "A new segment after the selected ones, with Alt before"],
    ["Ctrl+Delete", "Remove the selected segments"],
  ],
  "Parts of a sequence": [
    ["↑ ↓", "Another part; with Alt the part itself moves"],
    ["Enter", "Where the part begins"],
    ["Delete", "Take the part out"],
  ],
  "Pattern search": [
    ["← →", "On a gait's cursor: its sample; with Shift ten, Home and End"],
    ["Space, Enter", "On a cell: draw the other value; on a drawn cell free it"],
    ["K", "Fix the cell as it is"],
    ["↑ ↓", "In the best patterns: another one"],
  ],
  "Pictures of videos and cameras": [
    ["Wheel, + − F", "Zoom in, zoom out, show the whole picture; a drag or the arrows move it"],
    ["Arrows", "On a point: 1 px; with Shift 10, with Alt 0.1. Delete removes it"],
  ],
  "Goal and numbers": [
    ["Arrows", "Goal in 3D: 0.5 mm, on its knob 1°; with Shift ten times as far. In a number: one step"],
  ],
};

function groupOf([title, keys]) {
  return h("section", {}, h("h4", { text: title }),
    h("dl", {}, ...keys.flatMap(([key, does]) => [h("dt", {}, h("kbd", { text: key })), h("dd", { text: does })])));
}

const helps = [];

function helpButton({ text, help, act }, close) {
  const press = () => {
    close(null);
    act();
  };
  return h("button", { type: "button", text, title: help, on: { click: press } });
}

/**
 * Adds a button to the list of keys, which closes the list and acts.
 * @param {{text: string, help: string, act: () => void}} entry
 */
export function addHelp(entry) {
  helps.push(entry);
}

/** Shows the keys. */
export function showKeys() {
  if (byId("dialogs").firstElementChild) return;
  openDialog((close) => {
    const dialog = dialogFrame("Keyboard", close, () => close(null),
      h("div", { class: "key-groups" }, ...Object.entries(GROUPS).map(groupOf)),
      h("div", { class: "buttons" }, ...helps.map((entry) => helpButton(entry, close)), h("button", { type: "submit", text: "Close" })));
    dialog.classList.add("keys");
    return dialog;
  });
  byId("dialogs").querySelector(".dialog").scrollTop = 0;
}
