/** The list from which a cell's segment is chosen: by its first letters, with arrows, or with the pointer. */

import { h, setAttribute } from "../lib/dom.js";
import { choicesOf, placeBefore } from "../document/segment_sheet.js";

const matches = (name, text) =>
  name.toLowerCase().startsWith(text) || name.toLowerCase().includes(` ${text}`);

function option(choice, index) {
  const { name, segment, why } = choice;
  const way =
    segment.start === segment.end ? `waits at ${segment.start}` : `${segment.start} → ${segment.end}`;
  return h(
    "li",
    {
      role: "option",
      id: `segment-option-${index}`,
      "aria-selected": "false",
      data: { ...(segment.swing ? { swing: "" } : {}), ...(why ? { why: "" } : {}) },
      title: why
        ? `“${name}” ${why}. If you choose this segment, `
          + "you must also change the segments before or after it."
        : null,
    },
    h("b", { text: name }),
    h("span", { text: why ?? way }),
  );
}

/** @typedef {ReturnType<typeof import("../document/segment_sheet.js").segmentSheetOf>} Sheet */

/**
 * @param {Sheet} sheet
 * @param {[number, number]} place
 */
function chooserParts(sheet, [row, foot]) {
  const list = h("ul", { role: "listbox", id: "segment-options", "aria-label": "Segments" });
  const input = h("input", {
    role: "combobox",
    "aria-expanded": "true",
    "aria-controls": "segment-options",
    "aria-autocomplete": "list",
    autocomplete: "off",
    spellcheck: "false",
    "aria-label": `Segment of foot ${foot + 1}`,
    placeholder: sheet.rows[row][foot],
  });
  const before = placeBefore(sheet, row, foot);
  const place = h("p", {
    text: before
      ? `Foot ${foot + 1} is at ${before} before this segment.`
      : `This is the first segment of foot ${foot + 1}.`,
  });
  return {
    element: h("div", { class: "chooser", data: { foot: foot + 1 } }, input, place, list),
    input,
    list,
  };
}

/** Puts the chooser over a cell's box, but not beyond the window. */
function placeOver(element, box) {
  const { offsetWidth: width, offsetHeight: height } = element;
  element.style.left = `${Math.max(8, Math.min(box.left, window.innerWidth - width - 8))}px`;
  element.style.top = `${Math.max(8, Math.min(box.top, window.innerHeight - height - 8))}px`;
  element.style.setProperty("--cell-width", `${box.width}px`);
}

/** The segments that begin with what is typed, and which of them is marked. */
function mountOptions(input, list, all, present) {
  let shown = [];
  let active = 0;

  function mark(index) {
    active = Math.min(Math.max(index, 0), shown.length - 1);
    [...list.children].forEach((one, at) => one.setAttribute("aria-selected", String(at === active)));
    setAttribute(input, "aria-activedescendant", shown.length ? `segment-option-${active}` : null);
    list.children[active]?.scrollIntoView({ block: "nearest" });
  }

  function filter() {
    const typed = input.value.trim().toLowerCase();
    shown = all.filter(({ name }) => matches(name, typed));
    list.replaceChildren(...shown.map(option));
    if (!shown.length)
      list.append(h("li", { class: "none", text: `No segment begins with “${input.value.trim()}”.` }));
    mark(
      typed
        ? 0
        : Math.max(
            shown.findIndex(({ name }) => name === present),
            0,
          ),
    );
  }

  return { mark, move: (by) => mark(active + by), filter, chosen: () => shown[active] };
}

/**
 * Opens the list over a cell.
 * @param {HTMLElement} cell
 * @param {Sheet} sheet
 * @param {[number, number]} place row and foot of the cell
 * @param {{
 *   text: string,
 *   choose: (name: string, way: string|null) => void,
 *   close: (isLeft: boolean) => void,
 * }} acts `text` is what was typed; `way` is "right" after Tab, "down" after Enter; `close` follows on every
 *   end, with whether the focus went elsewhere
 */
export function openSegmentChooser(cell, sheet, place, { text, choose, close }) {
  const [row, foot] = place;
  const { element, input, list } = chooserParts(sheet, place);
  const options = mountOptions(input, list, choicesOf(sheet, row, foot), sheet.rows[row][foot]);
  let ended = false;

  function end(keepsFocus = false) {
    if (ended) return false;
    ended = true;
    element.remove();
    close(keepsFocus);
    return true;
  }

  function take(way) {
    const choice = options.chosen();
    if (!choice) return;
    end();
    choose(choice.name, way);
  }

  input.addEventListener("input", options.filter);
  input.addEventListener("keydown", (event) => {
    const moves = { ArrowDown: 1, ArrowUp: -1, PageDown: 8, PageUp: -8 };
    if (moves[event.key]) options.move(moves[event.key]);
    else if (event.key === "Enter") take("down");
    else if (event.key === "Tab") take(event.shiftKey ? "left" : "right");
    else return;
    event.preventDefault();
  });
  input.addEventListener("blur", ({ relatedTarget }) => end(relatedTarget !== null));
  list.addEventListener("pointerdown", (event) => event.preventDefault());
  list.addEventListener("click", (event) => {
    const target = /** @type {Element} */ (event.target);
    const index = [...list.children].indexOf(target.closest("[role=option]"));
    if (index < 0) return;
    options.mark(index);
    take(null);
  });

  const box = cell.getBoundingClientRect();
  document.querySelector("main").append(element);
  input.value = text;
  options.filter();
  placeOver(element, box);
  input.focus();
  if (!text) input.select();
  return { close: () => end() };
}
