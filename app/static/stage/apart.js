/** Keeps labels apart: overlapping boxes are moved along the axis with the smaller overlap. */

const GAP = 3;
const MOST_ROUNDS = 16;

/** Overlap of two boxes along x and y, px, GAP included; they overlap if both are above 0. */
const overlap = (a, b) => [
  (a.width + b.width) / 2 + GAP - Math.abs(a.x - b.x),
  (a.height + b.height) / 2 + GAP - Math.abs(a.y - b.y),
];

/** Moves two overlapping boxes apart, each by half the overlap. */
function part(a, b) {
  const [across, along] = overlap(a, b);
  if (across <= 0 || along <= 0) return false;
  const axis = across < along ? "x" : "y";
  const by = (Math.min(across, along) / 2) * (a[axis] < b[axis] ? -1 : 1);
  a[axis] += by;
  b[axis] -= by;
  return true;
}

/** Whether a box with this middle lies inside the frame along one axis. */
const fits = (at, size, room) => at >= size / 2 + GAP && at <= room - size / 2 - GAP;

/** Moves a box off a fixed one, by the shortest of the four moves that keep it inside the frame. */
function clear(box, other, { width, height }) {
  const [across, along] = overlap(box, other);
  if (across <= 0 || along <= 0) return false;
  const [right, below] = [
    other.x + (box.width + other.width) / 2 + GAP,
    other.y + (box.height + other.height) / 2 + GAP,
  ];
  const ways = [
    ...[right, 2 * other.x - right].filter((x) => fits(x, box.width, width)).map((x) => ({ x, y: box.y })),
    ...[below, 2 * other.y - below].filter((y) => fits(y, box.height, height)).map((y) => ({ x: box.x, y })),
  ];
  const far = (way) => Math.abs(way.x - box.x) + Math.abs(way.y - box.y);
  if (ways.length)
    Object.assign(
      box,
      ways.reduce((best, way) => (far(way) < far(best) ? way : best)),
    );
  return ways.length > 0;
}

function hold(box, { width, height }) {
  box.x = Math.min(Math.max(box.x, box.width / 2 + GAP), width - box.width / 2 - GAP);
  box.y = Math.min(Math.max(box.y, box.height / 2 + GAP), height - box.height / 2 - GAP);
}

/**
 * Moves boxes inside a frame until none overlaps another or a fixed one.
 * @param {{x: number, y: number, width: number, height: number}[]} boxes by their middles, px; changed
 * @param {{x: number, y: number, width: number, height: number}[]} fixed the most important first
 * @param {{width: number, height: number}} frame
 */
export function moveApart(boxes, fixed, frame) {
  for (let round = 0, isMoved = true; isMoved && round < MOST_ROUNDS; round += 1) {
    isMoved = false;
    boxes.forEach((box, index) => {
      for (const other of boxes.slice(index + 1)) isMoved = part(box, other) || isMoved;
      hold(box, frame);
      for (const other of fixed) isMoved = clear(box, other, frame) || isMoved;
    });
  }
  // Without room for all, labels may overlap each other, but not the fixed boxes.
  for (const box of boxes) for (const other of [...fixed].reverse()) clear(box, other, frame);
  return boxes;
}

/** Whether a box lies inside the frame and overlaps no fixed box. */
export const isFree = (box, fixed, { width, height }) =>
  fits(box.x, box.width, width)
  && fits(box.y, box.height, height)
  && !fixed.some((other) => Math.min(...overlap(box, other)) > 0);

/** The first of some places at which a box is free. If there is none, the first place, moved. */
export function firstFree(places, fixed, frame) {
  return places.find((box) => isFree(box, fixed, frame)) ?? moveApart([places[0]], fixed, frame)[0];
}
