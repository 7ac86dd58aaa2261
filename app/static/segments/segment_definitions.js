/** The definitions of a segment table: add, change, rename and delete its named positions and segments. */

import { capital, counted } from "../lib/format.js";
import { h, onPress, setAllowed } from "../lib/dom.js";

const NAME = /^[^\t\r\n,;"]{1,40}$/;

/** Why a name cannot be taken; null where it can. */
function nameReason(name, taken, what, withoutDash) {
  if (!NAME.test(name))
    return (
      `The name of a ${what} must have 1 to 40 characters. `
      + `Tabs, commas, semicolons and quotes are not allowed.`
    );
  if (withoutDash && name.includes("-"))
    return (
      `The name “${name}” must not contain a hyphen. `
      + `A hyphen separates place and height in the name of a position, such as Home-Base.`
    );
  if (taken.some((one) => one.toLowerCase() === name.toLowerCase()))
    return `A ${what} “${name}” already exists. Choose another name.`;
  return null;
}

const renamedKey = (map, from, to) =>
  Object.fromEntries(Object.entries(map).map(([name, value]) => [name === from ? to : name, value]));
const withDefinitions = (words) => (sheet) => ({
  ...sheet,
  words: { ...sheet.words, ...words(sheet.words) },
});

function renamedPosition(segments, axis, from, to) {
  const moved = (position) => {
    const [xy, ...z] = position.split("-");
    return axis === "xy"
      ? xy === from
        ? [to, ...z].join("-")
        : position
      : z.join("-") === from
        ? `${xy}-${to}`
        : position;
  };
  return Object.fromEntries(
    Object.entries(segments).map(([name, s]) => [name, { ...s, start: moved(s.start), end: moved(s.end) }]),
  );
}

const renameSegment = (from, to) => (sheet) => ({
  ...sheet,
  rows: sheet.rows.map((row) => row.map((name) => (name === from ? to : name))),
  words: { ...sheet.words, segments: renamedKey(sheet.words.segments, from, to) },
});

const without = (map, name) => Object.fromEntries(Object.entries(map).filter(([one]) => one !== name));

/**
 * A text field that is read on change; a wrong text is refused and the value restored.
 * @param {{
 *   label: string,
 *   value: string,
 *   unit?: string,
 *   read: (text: string) => string|null|undefined,
 *   refuse: (reason: string) => void,
 * }} what `read` returns why it refuses a text
 */
function field({ label, value, unit, read, refuse }) {
  const input = h("input", {
    value,
    "aria-label": label,
    title: label,
    autocomplete: "off",
    spellcheck: "false",
    class: unit === undefined ? "" : "number",
  });
  const finish = () => {
    if (input.value === value) return;
    const reason = read(input.value.trim());
    if (!reason) {
      input.defaultValue = input.value;
      return;
    }
    refuse(reason);
    input.value = value;
  };
  input.addEventListener("change", finish);
  input.addEventListener("focus", () => input.select());
  input.addEventListener("mousedown", (event) => {
    if (input === document.activeElement) return;
    event.preventDefault();
    input.focus();
  });
  input.addEventListener("keydown", (event) => {
    if (event.key !== "Escape") return;
    input.value = value;
    event.stopPropagation();
  });
  return unit ? h("span", { class: "box", data: { unit } }, input) : input;
}

function choice({ label, value, options, read }) {
  const select = h(
    "select",
    { "aria-label": label, title: label },
    ...options.map((one) => h("option", { value: one, text: one })),
  );
  select.value = value;
  select.addEventListener("change", () => read(select.value));
  return select;
}

function deletion(label, reason, act, refuse) {
  const button = h("button", { class: "plain icon-only", "aria-label": label, text: "×" });
  setAllowed(button, reason, label);
  onPress(button, act, refuse);
  return button;
}

/** Reads a number with point or comma; NaN where there is none. */
const numberOf = (text) => (text === "" ? NaN : Number(text.replace(",", ".").replace("\u2212", "-")));

const AXES = {
  xy: {
    title: "Places",
    what: "place",
    unit: "×",
    help: "Foot position as a multiple of the step",
    shown: String,
    stored: (value) => value,
    least: -10,
    most: 10,
    fresh: 0.5,
    uses: (position) => position.split("-")[0],
  },
  z: {
    title: "Heights",
    what: "height",
    unit: "mm",
    help: "Stroke of each motor when the foot is in its middle position",
    shown: (value) => String(Number((value * 1000).toFixed(4))),
    stored: (value) => value / 1000,
    least: 0.5,
    most: 19.5,
    fresh: 0.006,
    uses: (position) => position.split("-").slice(1).join("-"),
  },
};

const freshName = (taken, stem) => {
  let number = 1;
  while (taken.some((name) => name.toLowerCase() === `${stem} ${number}`.toLowerCase())) number += 1;
  return `${stem} ${number}`;
};

/** Why a number cannot be a place or a height, which the robot's motors have to reach; null where it can. */
function numberReason(name, number, unit, [least, most]) {
  if (number >= least && number <= most) return null;
  if (unit !== "mm" || Number.isNaN(number))
    return (
      `“${name}” needs a number between ${least} and ${most}${unit === "mm" ? " mm" : ""}. `
      + `The old number stays.`
    );
  return (
    `“${name}” cannot be ${number} mm. The robot's motors reach ${least} to ${most} mm. `
    + `Type a height in this range.`
  );
}

const withAxis = (axis, change) => withDefinitions((words) => ({ [axis]: change(words[axis]) }));

const renamedOnAxis = (axis, from, to) =>
  withDefinitions((words) => ({
    [axis]: renamedKey(words[axis], from, to),
    segments: renamedPosition(words.segments, axis, from, to),
  }));

/** Why a name of an axis cannot be deleted; null where it can. */
function whyNotDeleted(sheet, axis, name) {
  const { what, uses } = AXES[axis];
  const user = Object.entries(sheet.words.segments).find(
    ([, { start, end }]) => uses(start) === name || uses(end) === name,
  )?.[0];
  if (user)
    return (
      `The segment “${user}” uses “${name}”. `
      + `Change or delete that segment before you delete the ${what}.`
    );
  return Object.keys(sheet.words[axis]).length === 1 ? `A segment table needs at least one ${what}.` : null;
}

/** A named place or height. */
function axisRow(sheet, axis, name, { run, refuse, strokes }) {
  const { what, unit, help, shown, stored, least, most } = AXES[axis];
  const range = (axis === "z" && strokes()) || [least, most];
  const map = sheet.words[axis];

  function readName(text) {
    return (
      nameReason(text, Object.keys(without(map, name)), what, axis === "xy")
      ?? run({ change: renamedOnAxis(axis, name, text), label: `Rename ${what} ${name} to ${text}` })
    );
  }

  function readNumber(text) {
    const number = numberOf(text);
    return (
      numberReason(name, number, unit, range)
      ?? run({
        change: withAxis(axis, (values) => ({ ...values, [name]: stored(number) })),
        label: `${name} to ${number}${unit === "mm" ? " mm" : " × the step"}`,
      })
    );
  }

  return h(
    "div",
    { class: "word" },
    field({ label: `Name of the ${what} ${name}`, value: name, refuse, read: readName }),
    field({
      label: `${help} at ${name}${unit === "×" ? "" : `, ${unit}`}`,
      value: shown(map[name]),
      unit,
      refuse,
      read: readNumber,
    }),
    deletion(
      `Delete the ${what} ${name}`,
      whyNotDeleted(sheet, axis, name),
      () =>
        run({ change: withAxis(axis, (values) => without(values, name)), label: `Delete ${what} ${name}` }),
      refuse,
    ),
  );
}

/** One axis of the named positions: its names and values. */
function axisPart(sheet, axis, actions) {
  const { title, what, help, fresh } = AXES[axis];
  const names = Object.keys(sheet.words[axis]);
  const add = () => {
    const name = freshName(names, capital(what));
    actions.run({
      change: withAxis(axis, (values) => ({ ...values, [name]: fresh })),
      label: `Add ${what} ${name}`,
    });
  };
  return h(
    "div",
    { class: "axis", role: "group", "aria-label": title },
    h("h3", { text: title, title: help }),
    ...names.map((name) => axisRow(sheet, axis, name, actions)),
    h("button", { class: "link", text: `Add a ${what}`, on: { click: add } }),
  );
}

function segmentRow(sheet, name, { run, refuse }) {
  const segment = sheet.words.segments[name];
  const positions = Object.keys(sheet.words.xy).flatMap((xy) =>
    Object.keys(sheet.words.z).map((z) => `${xy}-${z}`),
  );
  const uses = sheet.rows.flat().filter((one) => one === name).length;
  const set = (part, label) =>
    run({
      change: withDefinitions((words) => ({
        segments: { ...words.segments, [name]: { ...words.segments[name], ...part } },
      })),
      label,
    });
  const air = h("input", { type: "checkbox", "aria-label": `${name} is in the air`, title: "In the air" });
  air.checked = segment.swing;
  air.addEventListener("change", () =>
    set({ swing: air.checked }, `${name} ${air.checked ? "in the air" : "on the ground"}`),
  );
  return h(
    "div",
    { class: "word segment" },
    field({
      label: `Name of the segment ${name}`,
      value: name,
      refuse,
      read: (text) =>
        nameReason(text, Object.keys(without(sheet.words.segments, name)), "segment", false)
        ?? run({ change: renameSegment(name, text), label: `Rename ${name} to ${text}` }),
    }),
    choice({
      label: `Start of ${name}`,
      value: segment.start,
      options: positions,
      read: (start) => set({ start }, `${name} starts at ${start}`),
    }),
    choice({
      label: `End of ${name}`,
      value: segment.end,
      options: positions,
      read: (end) => set({ end }, `${name} ends at ${end}`),
    }),
    air,
    deletion(
      `Delete the segment ${name}`,
      uses
        ? `The table uses “${name}” in ${counted(uses, "cell")}. Replace “${name}” in the table first.`
        : Object.keys(sheet.words.segments).length === 1
          ? "A segment table needs at least one segment."
          : null,
      () =>
        run({
          change: withDefinitions((words) => ({ segments: without(words.segments, name) })),
          label: `Delete segment ${name}`,
        }),
      refuse,
    ),
  );
}

function segmentPart(sheet, actions) {
  const names = Object.keys(sheet.words.segments);
  const add = h("button", {
    class: "link",
    text: "Add a segment",
    on: {
      click: () => {
        const name = freshName(names, "Segment");
        const { end: place } = sheet.words.segments[names.at(-1)];
        actions.run({
          change: withDefinitions((words) => ({
            segments: { ...words.segments, [name]: { start: place, end: place, swing: false } },
          })),
          label: `Add segment ${name}`,
        });
      },
    },
  });
  return h(
    "div",
    { class: "axis", role: "group", "aria-label": "Segments" },
    h("h3", { text: "Segments" }),
    h(
      "div",
      { class: "word segment head" },
      h("span", { text: "from" }),
      h("span", { text: "to" }),
      h("span", { text: "air", title: "In the air" }),
      h("span"),
    ),
    ...names.map((name) => segmentRow(sheet, name, actions)),
    add,
  );
}

/** Whether a name or number is being typed. */
export const isTyped = (control) =>
  control?.matches("input:not([type=checkbox])") && control.value !== control.defaultValue;

/**
 * Fills the panel with a sheet's vocabulary where that changed; the control that had the focus keeps it, and
 * a name or number that is being typed waits for its end. It is filled anew after the key or click at hand,
 * which may take the focus on.
 */
export function createDefinitions(panel, actions) {
  let shown = "";
  let latest = null;
  let awaited = false;
  const controls = () => [...panel.querySelectorAll("input, select, button")];
  function draw() {
    const sheet = latest;
    awaited = false;
    const text = JSON.stringify([sheet.words, sheet.rows]);
    const focused = panel.contains(document.activeElement) ? document.activeElement : null;
    if (shown === text || isTyped(focused)) return;
    const place = controls().indexOf(focused);
    shown = text;
    panel.replaceChildren(
      axisPart(sheet, "xy", actions),
      axisPart(sheet, "z", actions),
      segmentPart(sheet, actions),
    );
    if (place >= 0) controls()[place]?.focus();
  }
  function soon() {
    if (!awaited) setTimeout(draw);
    awaited = true;
  }
  panel.addEventListener("focusout", () => {
    if (latest) soon();
  });
  return (sheet) => {
    latest = sheet;
    soon();
  };
}
