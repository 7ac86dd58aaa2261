/** Moving a part of the sequence with the pointer: it goes where the line shows when it is let go. */

const SLACK_PX = 4;

/**
 * @param {HTMLElement} grid that holds the rows
 * @param {() => Array} rows each with its `element` and `name`
 * @param {(from: number, to: number) => void} move
 * @param {(index: number) => void} tap a press without a drag
 */
export function mountReordering(grid, rows, move, tap) {
  let drag = null;

  /** How many rows have their middle above the pointer. */
  const placeAt = (y) => rows().filter(({ element }) => {
    const { top, bottom } = element.getBoundingClientRect();
    return y > (top + bottom) / 2;
  }).length;

  function mark() {
    rows().forEach(({ element }, index) => {
      element.toggleAttribute("data-dragged", Boolean(drag?.on) && index === drag.from);
      element.toggleAttribute("data-before", Boolean(drag?.on) && index === drag.gap);
      element.toggleAttribute("data-after", Boolean(drag?.on) && index === rows().length - 1 && drag.gap === rows().length);
    });
  }

  function end() {
    const done = drag;
    drag = null;
    mark();
    return done;
  }

  grid.addEventListener("pointerdown", (event) => {
    const from = rows().findIndex(({ name }) => name.contains(event.target));
    if (event.button !== 0 || from < 0) return;
    drag = { from, y: event.clientY, on: false, gap: from };
    grid.setPointerCapture(event.pointerId);
    event.preventDefault();
    rows()[from].name.focus();
  });
  grid.addEventListener("pointermove", (event) => {
    if (!drag) return;
    drag.on ||= Math.abs(event.clientY - drag.y) > SLACK_PX;
    drag.gap = placeAt(event.clientY);
    mark();
  });
  grid.addEventListener("pointerup", () => {
    const done = end();
    if (!done) return;
    if (!done.on) tap(done.from);
    else move(done.from, done.gap > done.from ? done.gap - 1 : done.gap);
  });
  grid.addEventListener("pointercancel", end);
  return { cancel: () => Boolean(drag && end()?.on) };
}
