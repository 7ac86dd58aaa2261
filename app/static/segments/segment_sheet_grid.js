/** The segment table's ARIA grid: a row a segment, a column a foot. Only cells that changed are touched. */

import { h, setAttribute, setText } from "../lib/dom.js";

const FEW_FEET = 4;
const LINK =
  "Between two iterations, the gait uses the link "
  + "instead of the segments before and after the repeating part";
const REPEATED = "Every iteration of the gait contains this segment once";
const FIRST = "The gait contains this segment only once, at the beginning";
const LAST = "The gait contains this segment only once, at the end";
const WAYS = { true: "in the air", false: "on the ground" };

function headRow(legs, roles) {
  return h(
    "div",
    { role: "row" },
    h("div", { role: "columnheader", title: "Segment", text: "#" }),
    ...Array.from({ length: legs }, (_, foot) =>
      h(
        "div",
        {
          role: "columnheader",
          "aria-colindex": foot + 2,
          title: `Foot ${foot + 1}${roles[foot] ? ` (${roles[foot]})` : ""}`,
          data: { foot: foot + 1 },
        },
        h("i", { class: "foot-dot" }),
        h("span", { text: String(foot + 1) }),
        legs <= FEW_FEET && roles[foot],
      ),
    ),
  );
}

function bodyRow(sheet, row) {
  const inLink = row >= sheet.count;
  const number = inLink ? `L${row - sheet.count + 1}` : String(row + 1);
  const head = h("div", { role: "rowheader", text: number });
  const cells = Array.from({ length: sheet.legs }, (_, foot) =>
    h("div", {
      role: "gridcell",
      tabindex: "-1",
      "aria-colindex": foot + 2,
      "aria-selected": "false",
      data: { foot: foot + 1 },
    }),
  );
  const name = inLink ? `Link segment ${row - sheet.count + 1}` : `Segment ${row + 1}`;
  const element = h(
    "div",
    { role: "row", "aria-label": name, data: inLink ? { link: "" } : {} },
    head,
    ...cells,
  );
  return { element, head, cells };
}

const wayOf = ({ start, end, swing }) =>
  `${start === end ? `waits at ${start}` : `${start} → ${end}`}, ${WAYS[swing]}`;

function drawCell(cell, sheet, row, foot, error) {
  const name = sheet.rows[row][foot];
  const segment = sheet.words.segments[name];
  setText(cell, name);
  setAttribute(
    cell,
    "title",
    error
      ? `Foot ${foot + 1}: ${error.sentence}`
      : `${name}: ${segment ? wayOf(segment) : "no such segment"}`,
  );
  setAttribute(cell, "aria-invalid", error ? "true" : null);
  setAttribute(cell, "data-doubt", error && !error.stops ? "" : null);
  cell.toggleAttribute("data-swing", Boolean(segment?.swing));
}

/** The row between the table and its link. */
function linkHead(isLinked, addLink) {
  const add = h("button", {
    class: "link",
    text: "Add",
    title: "Add a segment that connects one iteration with the next iteration",
    on: { click: addLink },
  });
  const words = h("span", { text: isLinked ? "connects two iterations" : "none" });
  return h(
    "div",
    { role: "row", class: "bridge" },
    h("div", { role: "rowheader", title: LINK }, "Link", words, isLinked ? null : add),
  );
}

/** When a gait contains a row's segment. */
function placeText({ count, from, to }, row) {
  if (row >= count) return "Between two iterations";
  if (row < from - 1) return FIRST;
  return row < to ? REPEATED : LAST;
}

/**
 * @param {HTMLElement} grid
 * @param {() => void} addLink makes the first row of a link
 */
export function createSegmentSheetGrid(grid, addLink) {
  let parts = [];
  let shape = "";

  function rebuild(sheet, roles) {
    parts = sheet.rows.map((_, row) => bodyRow(sheet, row));
    const elements = parts.map(({ element }) => element);
    elements.splice(sheet.count, 0, linkHead(sheet.rows.length > sheet.count, addLink));
    grid.replaceChildren(headRow(sheet.legs, roles), ...elements);
    grid.style.setProperty("--feet", sheet.legs);
    grid.toggleAttribute("data-many", sheet.legs > FEW_FEET);
    grid.setAttribute("aria-rowcount", sheet.rows.length + 2);
    grid.setAttribute("aria-colcount", sheet.legs + 1);
  }

  return {
    /** Draws a sheet; true where the cells are new. */
    draw(sheet, roles, errors) {
      const now = JSON.stringify([sheet.legs, sheet.count, sheet.rows.length, roles]);
      const isNew = now !== shape;
      if (isNew) rebuild(sheet, roles);
      shape = now;
      const found = new Map(errors.map((error) => [`${error.row},${error.foot}`, error]));
      parts.forEach(({ element, head, cells }, row) => {
        element.toggleAttribute("data-repeats", row >= sheet.from - 1 && row < sheet.to);
        setAttribute(head, "title", placeText(sheet, row));
        cells.forEach((cell, foot) => drawCell(cell, sheet, row, foot, found.get(`${row},${foot}`)));
      });
      return isNew;
    },
    cell: ([row, foot]) => parts[row]?.cells[foot] ?? null,
    /** Row and foot of an element, or null. */
    placeOf(target) {
      const cell = target.closest?.("[role=gridcell]");
      const row = parts.findIndex(({ cells }) => cells.includes(cell));
      return row < 0 ? null : [row, parts[row].cells.indexOf(cell)];
    },
    /** The row that a row header belongs to, or null. */
    rowOf(target) {
      const row = parts.findIndex(({ head }) => head === target);
      return row < 0 ? null : row;
    },
    select({ rows, feet }) {
      parts.forEach(({ cells }, row) =>
        cells.forEach((cell, foot) => {
          const isInside = row >= rows[0] && row <= rows[1] && foot >= feet[0] && foot <= feet[1];
          setAttribute(cell, "aria-selected", String(isInside));
        }),
      );
    },
    forget() {
      parts = [];
      shape = "";
    },
  };
}
