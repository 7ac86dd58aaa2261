/** The list of keys and gestures, grouped by where they hold. */

import { dialogFrame, openDialog } from "../lib/dialogs.js";
import { byId, h } from "../lib/dom.js";

const GROUPS = {
  "Everywhere": [
    ["Space", "Play or pause the preview. Space never starts the robot"],
    ["Esc", "During a run: stop the robot. Otherwise: "
      + "cancel the drag or preview, close the dialog, or clear the selection"],
    ["← →", "Move the playhead by one sample; with Shift by ten"],
    ["Home, End", "Move the playhead to the first or last sample"],
    ["L", "Loop the selected samples, or all samples, while the preview plays"],
    ["+ − F", "Zoom in, zoom out, show the whole timeline"],
    ["Ctrl+Z", "Undo"],
    ["Ctrl+Y", "Redo; Ctrl+Shift+Z does the same"],
    ["Ctrl+S", "Save"],
    ["F6", "Go to the next part of the page; with Shift to the previous part. "
      + "Shift+F6 in the top bar goes to the button of the next action"],
    ["[ ]", "[ closes or opens the drawer at the left, ] the inspector at the right. "
      + "Design, Simulate, Check & approve and Run open the inspector too"],
    ["?", "This list"],
  ],
  "Cells of the timeline": [
    ["Arrows", "Move between cells; with Ctrl to the next start or end of a swing"],
    ["Home, End", "Go to the first or last cell of the row; with Ctrl, of the whole timeline"],
    ["Space, Enter", "Change the cell to swing or stance. "
      + "Space and Enter work only if you came to the cell by keyboard"],
    ["Shift+arrows", "Select cells; Shift+Home and Shift+End select to the start or end of the row"],
    ["Shift+Space", "Select the row"],
    ["Ctrl+A", "Select all"],
    ["Ctrl+C, X, V, D", "Copy, cut, paste, duplicate"],
    ["Delete", "Change the selected cells to stance"],
    ["K", "Lock the selection or the focused cell. Press K again to unlock"],
  ],
  "Pointer on the timeline": [
    ["Drag", "Use the chosen tool. "
      + "With Paint: a drag on stance draws a swing, a drag on a swing moves the swing or its end"],
    ["Alt or B + drag", "Paint, also when the drag starts on a swing. B alone chooses the tool Paint"],
    ["Shift + drag", "Lock cells. A drag that starts on a locked cell unlocks cells"],
    ["Ctrl + drag", "Select cells. Shift + click extends the selection. "
      + "A click on a row's name selects the row"],
    ["Double click", "With the tool Select: select the whole swing. "
      + "Then drag the swing to move it, or with Alt to copy it"],
    ["Ctrl + wheel", "Zoom the timeline. The wheel alone scrolls"],
  ],
  "Lists and toolbars": [
    ["↑ ↓", "In a list: go to the previous or next line. Home and End: go to the first or last line"],
    ["← →", "In a toolbar: go to the previous or next button. On the tabs: go to the previous or next tab"],
    ["Enter", "In a list: open the selected entry. On Send to robot: hold Enter for one second to send the gait"],
    ["Double click", "On a gait in the list: change its name"],
  ],
  "Touch": [
    ["Long press", "Show the explanation of a control, as a mouse pointer does"],
    ["Two fingers", "Zoom the timeline"],
  ],
  "Segment table": [
    ["Letters, Enter", "Choose a segment"],
    ["Delete", "Let the foot wait in this segment"],
    ["Ctrl+C, X, V", "Copy, cut, paste as in a spreadsheet. "
      + "Ctrl+D fills the selected cells below the first row"],
    ["Insert", "Insert a new segment after the selected segments; with Alt before them"],
    ["Ctrl+Delete", "Remove the selected segments"],
  ],
  "Parts of a sequence": [
    ["↑ ↓", "Go to the previous or next part; with Alt move the part up or down"],
    ["Enter", "Move the playhead to the start of the part"],
    ["Delete", "Remove the part from the sequence"],
  ],
  "Pattern search": [
    ["← →", "On the cursor of a gait: move by one sample; with Shift by ten. "
      + "Home and End: go to the first or last sample"],
    ["Space, Enter", "On a cell: draw the other value, which is then fixed. "
      + "On a drawn cell: the solver chooses the value again"],
    ["K", "Fix the present value of the cell"],
    ["↑ ↓", "In the list of the best patterns: show the previous or next pattern"],
  ],
  "Pictures of videos and cameras": [
    ["Wheel, + − F", "Zoom in, zoom out, show the whole picture. A drag or the arrow keys move the picture"],
    ["Arrows", "On a point: move the point by 1 px; with Shift by 10 px, with Alt by 0.1 px. "
      + "Delete removes the point"],
  ],
  "Goal and numbers": [
    ["Arrows", "On the goal in 3D: move the goal by 0.5 mm. On the knob of the goal: turn the goal by 1°. "
      + "With Shift: ten times as far. In a number field: change the number"],
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
