/** Draws cells into a pattern with click, drag or key; the search then finds the other cells. */

import { cellOf, nearestCell } from "../timeline/cells.js";
import { drawnCells, withCells } from "./pattern_problem.js";
import { announce, toast } from "../lib/toasts.js";

const REFUSALS = {
  end:
    "You cannot draw in the first or last column. "
    + "To change these columns in a transition, move the cursor of gait A or B.",
  limb: "This limb is locked. To unlock the limb, click its name.",
  given:
    "This cell is locked in the open gait, or it is a painted swing. "
    + "Unlock the cell in the tab Cells, or untick “Keep the painted swings”.",
};

const DRAWN = "You drew this cell. Click the cell to let the search choose its value again.";
const FREE =
  "Click: change between swing and stance. Shift+click: fix the present value of the cell. "
  + "Drag: change several cells.";

/** Turns places on the screen into cells; measured once a drag. */
function finder(lines) {
  const [first, last] = [lines[0], lines.at(-1)].map(({ strip }) =>
    strip.parentElement.getBoundingClientRect(),
  );
  const samples = lines[0].cells.length;
  return (x, y) =>
    nearestCell(
      [
        Math.floor(((y - first.top) / (last.bottom - first.top)) * lines.length),
        Math.floor(((x - first.left) / first.width) * samples),
      ],
      lines.length,
      samples,
    );
}

/**
 * What is drawn in, and with which focus.
 * @typedef {{
 *   problem: Record<string, any>,
 *   grid: HTMLElement,
 *   lines: () => Record<string, any>[],
 *   roving: Record<string, any>,
 *   shown: () => Record<string, any>,
 * }} Parts
 */

/**
 * The cells as they are drawn: what an act does to them, and why it cannot.
 * @param {Parts} parts
 */
function drawingOf({ problem, lines, shown }) {
  const valueOf = ([foot, sample]) => (lines()[foot].cells[sample].dataset.state === "swing" ? 0 : 1);
  const isKnown = ([foot, sample]) => lines()[foot].cells[sample].dataset.state !== "free";
  const isDrawn = (cell) => cell.join(",") in drawnCells(problem.state);
  /** @param {number[]} cell */
  const refusal = ([foot, sample]) => REFUSALS[shown().fixed(foot, sample)] ?? null;

  /** What a gesture that begins at a cell does to each cell: gives it a value, or frees it (null). */
  function actFor(cell, keeps) {
    if (isDrawn(cell)) return () => null;
    if (keeps) return (one) => (isKnown(one) ? valueOf(one) : undefined);
    const value = isKnown(cell) ? 1 - valueOf(cell) : 0;
    return () => value;
  }

  function draw(cells, act) {
    const drawn = { ...drawnCells(problem.state) };
    for (const cell of cells) {
      if (refusal(cell)) continue;
      const value = act(cell);
      if (value === null) delete drawn[cell.join(",")];
      else if (value !== undefined) drawn[cell.join(",")] = value;
    }
    problem.set(withCells(problem.state, drawn));
  }

  function touch(cell, keeps) {
    const why = refusal(cell);
    if (why) return toast(why);
    draw([cell], actFor(cell, keeps));
    return announce(isDrawn(cell) ? "Fixed." : "Free.");
  }

  const helpOf = (cell) => refusal(cell) ?? (isDrawn(cell) ? DRAWN : FREE);
  return { refusal, actFor, draw, touch, helpOf };
}

/** The cells of one row from one cell to another. */
function between([, start], [foot, end]) {
  const [first, last] = start < end ? [start, end] : [end, start];
  return Array.from({ length: last - first + 1 }, (_, index) => [foot, first + index]);
}

/**
 * Draws with the pointer.
 * @param {Parts} parts
 * @param {ReturnType<typeof drawingOf>} drawing
 */
function mountDragging({ problem, grid, lines, roving }, drawing) {
  let drag = null;

  function begin(event) {
    const cell = cellOf(event.target);
    if (event.button !== 0 || drag || !cell) return;
    roving.move(cell).focus({ preventScroll: true });
    const why = drawing.refusal(cell);
    if (why) {
      toast(why);
      return;
    }
    drag = {
      pointer: event.pointerId,
      before: drawnCells(problem.state),
      act: drawing.actFor(cell, event.shiftKey),
      last: cell,
      cellAt: finder(lines()),
    };
    grid.setPointerCapture(event.pointerId);
    event.preventDefault();
    drawing.draw([cell], drag.act);
  }

  function move(event) {
    if (!drag || event.pointerId !== drag.pointer) return;
    const cell = drag.cellAt(event.clientX, event.clientY);
    if (cell[0] === drag.last[0] && cell[1] === drag.last[1]) return;
    drawing.draw(cell[0] === drag.last[0] ? between(drag.last, cell) : [cell], drag.act);
    drag.last = cell;
  }

  function cancel() {
    if (!drag) return false;
    problem.set(withCells(problem.state, drag.before));
    drag = null;
    return true;
  }

  grid.addEventListener("pointerdown", begin);
  grid.addEventListener("pointermove", move);
  grid.addEventListener("pointerup", (event) => {
    if (drag?.pointer === event.pointerId) drag = null;
  });
  grid.addEventListener("pointercancel", cancel);
  return { isOn: () => drag !== null, cancel };
}

function press(event, roving, touch) {
  const here = cellOf(event.target);
  if (!here || event.ctrlKey || event.metaKey || event.altKey) return;
  const [foot, sample] = here;
  const goals = {
    ArrowLeft: [foot, sample - 1],
    ArrowRight: [foot, sample + 1],
    ArrowUp: [foot - 1, sample],
    ArrowDown: [foot + 1, sample],
    Home: [foot, 0],
    End: [foot, Infinity],
    PageUp: [0, sample],
    PageDown: [Infinity, sample],
  };
  if (goals[event.key]) roving.focus(goals[event.key]);
  else if (event.key === " " || event.key === "Enter") touch(here, event.shiftKey);
  else if (event.key.toLowerCase() === "k") touch(here, true);
  else return;
  event.preventDefault();
  event.stopPropagation();
}

/**
 * Wires pointer and keyboard.
 * @param {Parts} parts
 * @returns {{cancel: () => boolean}} `cancel` ends a drag and takes back what it drew
 */
export function mountPatternDrawing(parts) {
  const { grid, lines, roving } = parts;
  const drawing = drawingOf(parts);
  const dragging = mountDragging(parts, drawing);
  grid.addEventListener("pointerover", (event) => {
    const cell = cellOf(event.target);
    if (cell && !dragging.isOn()) lines()[cell[0]].cells[cell[1]].title = drawing.helpOf(cell);
  });
  grid.addEventListener("keydown", (event) => press(event, roving, drawing.touch));
  grid.addEventListener("focusin", (event) => {
    if (cellOf(event.target)) roving.move(cellOf(event.target));
  });
  return { cancel: dragging.cancel };
}
