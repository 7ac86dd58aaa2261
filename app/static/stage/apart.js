/** Keeps labels off one another: boxes that lie over each other are moved apart the shorter way. */

const GAP = 3;
const MOST_ROUNDS = 16;

/** How far two boxes lie over each other each way, px; not at all where one is 0 or less. */
const overlap = (a, b) => [(a.width + b.width) / 2 + GAP - Math.abs(a.x - b.x), (a.height + b.height) / 2 + GAP - Math.abs(a.y - b.y)];

/** Moves the first of two boxes off the other, and with `share` below 1 the other one as well. */
function part(a, b, share) {
  const [across, along] = overlap(a, b);
  if (across <= 0 || along <= 0) return false;
  const axis = across < along ? "x" : "y";
  const by = Math.min(across, along) * (a[axis] < b[axis] ? -1 : 1);
  a[axis] += by * share;
  b[axis] -= by * (1 - share);
  return true;
}

function hold(box, { width, height }) {
  box.x = Math.min(Math.max(box.x, box.width / 2 + GAP), width - box.width / 2 - GAP);
  box.y = Math.min(Math.max(box.y, box.height / 2 + GAP), height - box.height / 2 - GAP);
}

/**
 * Moves boxes until none lies over another or over what stays where it is, inside a frame.
 * @param {{x: number, y: number, width: number, height: number}[]} boxes by their middles, px; they are changed
 * @param {{x: number, y: number, width: number, height: number}[]} fixed
 * @param {{width: number, height: number}} frame
 */
export function moveApart(boxes, fixed, frame) {
  for (let round = 0, isMoved = true; isMoved && round < MOST_ROUNDS; round += 1) {
    isMoved = false;
    boxes.forEach((box, index) => {
      for (const other of boxes.slice(index + 1)) isMoved = part(box, other, 0.5) || isMoved;
      for (const other of fixed) isMoved = part(box, other, 1) || isMoved;
      hold(box, frame);
    });
  }
  return boxes;
}
