/** The list of keys and gestures, grouped by where they hold. */

import { dialogFrame, openDialog } from "../lib/dialogs.js";
import { byId, h } from "../lib/dom.js";

const GROUPS = {
  Everywhere: [
    ["Space", "Play or pause the preview. Space never starts the robot"],
    [
      "Esc",
      "During a run: stop the robot. Otherwise: "
        + "cancel the drag or preview, close the dialog, or clear the selection",
    ],
    ["← →", "Move the playhead by one sample. With Shift, move it by ten samples"],
    ["Home, End", "Move the playhead to the first or last sample"],
    ["L", "Loop the selected samples, or all samples, while the preview plays"],
    ["+ − F", "Zoom in, zoom out, show the whole timeline"],
    ["Ctrl+Z", "Undo"],
    ["Ctrl+Y", "Redo; Ctrl+Shift+Z does the same"],
    ["Ctrl+S", "Save"],
    [
      "F6",
      "Go to the next part of the page. Shift+F6 goes to the previous part. "
        + "From the top bar, Shift+F6 goes to the button for the next action",
    ],
    [
      "[ ]",
      "[ opens or closes the drawer at the left. ] opens or closes the inspector at the right. "
        + "The tabs Design, Simulate, Check & approve and Run also open the inspector",
    ],
    ["?", "This list"],
  ],
  "Cells of the timeline": [
    ["Arrows", "Go to the neighbouring cell. With Ctrl, go to the next start or end of a swing"],
    [
      "Home, End",
      "Go to the first or last cell of the row. "
        + "With Ctrl, go to the first or last cell of the whole timeline",
    ],
    [
      "Space, Enter",
      "Change the cell from stance to swing, or from swing to stance. "
        + "Space and Enter work only if you went to the cell with the keyboard",
    ],
    [
      "Shift+arrows",
      "Select cells. Shift+Home selects up to the start of the row, Shift+End up to the end of the row",
    ],
    ["Shift+Space", "Select the row"],
    ["Ctrl+A", "Select all"],
    ["Ctrl+C, X, V, D", "Copy, cut, paste, duplicate"],
    ["Delete", "Change the selected cells to stance"],
    ["K", "Lock the selection or the focused cell. Press K again to unlock"],
  ],
  "Pointer on the timeline": [
    [
      "Drag",
      "Use the chosen tool. "
        + "With the tool Paint, a drag on stance draws a swing. A drag on a swing moves the swing or its end",
    ],
    [
      "Alt or B + drag",
      "With the tool Paint: draw stance if the drag starts on a swing. "
        + "B without a drag chooses the tool Paint",
    ],
    ["Shift + drag", "Lock cells. A drag that starts on a locked cell unlocks cells"],
    [
      "Ctrl + drag",
      "Select cells. Shift + click extends the selection. A click on a row's name selects the row",
    ],
    [
      "Double click",
      "With the tool Select: select the whole swing. "
        + "Then drag the swing to move it, or hold Alt and drag to copy it",
    ],
    ["Ctrl + wheel", "Zoom the timeline. The wheel alone scrolls"],
  ],
  "Lists and toolbars": [
    ["↑ ↓", "In a list: go to the previous or next line. Home and End: go to the first or last line"],
    ["← →", "In a toolbar: go to the previous or next button. On the tabs: go to the previous or next tab"],
    [
      "Enter",
      "In a list: open the selected entry. On Send to robot: hold Enter for one second to send the gait",
    ],
    ["Double click", "On a gait in the list: change its name"],
  ],
  Touch: [
    ["Long press", "Show the help text of a control"],
    ["Two fingers", "Zoom the timeline"],
  ],
  "Segment table": [
    ["Letters, Enter", "Choose a segment"],
    ["Delete", "Let the foot wait in this segment"],
    [
      "Ctrl+C, X, V",
      "Copy, cut, paste as in a spreadsheet. "
        + "Ctrl+D copies the first selected row into the selected rows below it",
    ],
    [
      "Insert",
      "Insert a new segment after the selected segments. "
        + "Alt+Insert inserts it before the selected segments",
    ],
    ["Ctrl+Delete", "Remove the selected segments"],
  ],
  "Parts of a sequence": [
    ["↑ ↓", "Go to the previous or next part. With Alt, move the part up or down"],
    ["Enter", "Move the playhead to the start of the part"],
    ["Delete", "Remove the part from the sequence"],
  ],
  "Pattern search": [
    [
      "← →",
      "On the cursor of a gait: move the cursor by one sample. With Shift: by ten samples. "
        + "Home and End: go to the first or last sample",
    ],
    [
      "Space, Enter",
      "Change the cell between swing and stance, and fix its value. "
        + "On a cell that you have fixed: let the solver choose the value again",
    ],
    ["K", "Fix the present value of the cell"],
    ["↑ ↓", "In the list of the best patterns: show the previous or next pattern"],
  ],
  "Pictures of videos and cameras": [
    ["Wheel, + − F", "Zoom in, zoom out, show the whole picture. A drag or the arrow keys move the picture"],
    [
      "Arrows",
      "On a point: move the point by 1 px. With Shift: by 10 px. With Alt: by 0.1 px. "
        + "Delete removes the point",
    ],
  ],
  "Drive by keys": [
    [
      "1 … =, Q … ]",
      "In the region Drive by keys of the Run step, after a click: "
        + "move motors 1 to 12 up, or down with the row below. The place of a key counts, not its letter",
    ],
    ["A S D F, G", "Choose foot 1 to 4, or the body, for the arrows"],
    ["Arrows, Page Up, Page Down", "Move the foot or the body forwards, back, left, right, up and down"],
    ["Tab, Esc", "Leave the region. During a step, Esc stops the robot"],
  ],
  "Goal and numbers": [
    [
      "Arrows",
      "On the goal in 3D: move the goal by 0.5 mm. On the knob of the goal: turn the goal by 1°. "
        + "With Shift: ten times as far. In a number field: change the number",
    ],
  ],
};

function groupOf([title, keys]) {
  return h(
    "section",
    {},
    h("h4", { text: title }),
    h(
      "dl",
      {},
      ...keys.flatMap(([key, does]) => [h("dt", {}, h("kbd", { text: key })), h("dd", { text: does })]),
    ),
  );
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
    const dialog = dialogFrame(
      "Keyboard",
      close,
      () => close(null),
      h("div", { class: "key-groups" }, ...Object.entries(GROUPS).map(groupOf)),
      h(
        "div",
        { class: "buttons" },
        ...helps.map((entry) => helpButton(entry, close)),
        h("button", { type: "submit", text: "Close" }),
      ),
    );
    dialog.classList.add("keys");
    return dialog;
  });
  byId("dialogs").querySelector(".dialog").scrollTop = 0;
}
