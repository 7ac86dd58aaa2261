/** The picture of the keys that drive the robot. */

import { h, setAttribute, setText } from "../lib/dom.js";
import { AXIS_KEYS, CHOICE_KEYS, markOf, MOTOR_ROWS } from "./drive_keys.js";

const MEANINGS = { x: ["back", "ahead"], y: ["right", "left"], z: ["down", "up"] };

/** Builds the picture; `show` marks the key that is held and what the arrows move. */
export function keyMap() {
  const marks = new Map();
  const key = (code, title) => {
    const mark = h("kbd", { text: markOf(code), title, data: { code } });
    marks.set(code, mark);
    return mark;
  };
  const motorRow = (name, codes) =>
    h(
      "div",
      { class: "drive-row", data: { row: name } },
      h("span", { class: "quiet", text: name }),
      ...codes.map((code, index) => key(code, `Motor ${index + 1} ${name}`)),
    );
  const numbers = h(
    "div",
    { class: "drive-row drive-numbers" },
    h("span", { text: "motor" }),
    ...MOTOR_ROWS.up.map((_, index) => h("span", { text: String(index + 1) })),
  );
  const named = (code, text) => h("span", { class: "drive-key" }, key(code, text), h("span", { text }));
  const choices = Object.entries(CHOICE_KEYS).map(([code, foot]) =>
    named(code, foot ? `foot ${foot}` : "body"),
  );
  const arrows = Object.entries(AXIS_KEYS).map(([code, [axis, sign]]) =>
    named(code, MEANINGS[axis][sign > 0 ? 1 : 0]),
  );
  const mover = h("span", { class: "quiet" });
  const element = h(
    "div",
    { class: "drive-map", "aria-hidden": "true" },
    numbers,
    motorRow("up", MOTOR_ROWS.up),
    motorRow("down", MOTOR_ROWS.down),
    h(
      "div",
      { class: "drive-others" },
      h("span", { class: "quiet", text: "choose" }),
      h("div", {}, ...choices),
    ),
    h("div", { class: "drive-others" }, mover, h("div", {}, ...arrows)),
  );
  // Only some browsers tell the layout; the others show the marks of a US keyboard.
  /** @type {any} */ (navigator).keyboard
    ?.getLayoutMap?.()
    .then((layout) => marks.forEach((mark, code) => setText(mark, markOf(code, layout))));
  return {
    element,
    show: (held, chosen) => {
      marks.forEach((mark, code) => {
        setAttribute(mark, "data-held", code === held);
        setAttribute(mark, "data-chosen", CHOICE_KEYS[code] === chosen);
      });
      setText(mover, chosen ? `foot ${chosen}` : "body");
    },
  };
}
