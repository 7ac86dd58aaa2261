/** The marks of the feet, as elsewhere on the page (base.css): disc, square, triangle, diamond. */

const CORNERS = [
  null,
  [
    [-0.9, -0.9],
    [0.9, -0.9],
    [0.9, 0.9],
    [-0.9, 0.9],
  ],
  [
    [0, -1],
    [1, 0.9],
    [-1, 0.9],
  ],
  [
    [0, -1.15],
    [1.15, 0],
    [0, 1.15],
    [-1.15, 0],
  ],
];

/** Corners of a foot's mark around [x, y] with half width `r`; null for a disc. */
const cornersAt = (foot, x, y, r) =>
  CORNERS[foot % CORNERS.length]?.map(([dx, dy]) => [x + r * dx, y + r * dy]) ?? null;

/** A foot's mark as SVG text. */
export function footMark(foot, x, y, fill, r = 4.5) {
  const corners = cornersAt(foot, x, y, r);
  if (!corners) return `<circle cx="${x.toFixed(1)}" cy="${y.toFixed(1)}" r="${r}" fill="${fill}"/>`;
  const points = corners.map((at) => at.map((value) => value.toFixed(1)).join(",")).join(" ");
  return `<polygon points="${points}" fill="${fill}"/>`;
}

/** Fills a foot's mark on a canvas. */
export function paintFootMark(pen, foot, x, y, r) {
  pen.beginPath();
  const corners = cornersAt(foot, x, y, r);
  if (corners) corners.forEach((at) => pen.lineTo(...at));
  else pen.arc(x, y, r, 0, 2 * Math.PI);
  pen.fill();
}
