/**
 * What lies on the floor under the robot, as updates of the marks that the server put into the scene.
 *
 * Floor marks: support polygon of the current sample, coloured by its margin; traces and points of the
 * centres of mass and pressure; each foot's swings and footholds. Heights in m.
 */

/** Height of the floor under a robot with shoes, m. */
const SHOD_FLOOR = -0.018;
const GAP = 0.0004;
const RING_RADIUS = 0.0125;
const RING_PIECES = 20;
/** Length of a dash of a broken edge, and of the gap behind it, m. */
const [DASH, SPACE] = [0.004, 0.003];
/** The colours of shell/base.css in each theme. */
const GOOD = { light: [11, 116, 112], dark: [79, 208, 196] };
const CAUTION = { light: [125, 90, 0], dark: [230, 198, 90] };
const BAD = { light: [179, 20, 95], dark: [255, 134, 187] };
const INK = { light: [22, 27, 34], dark: [232, 235, 240] };
const PAPER = { light: [255, 255, 255], dark: [23, 27, 33] };
const ACCENT = { light: [75, 72, 200], dark: [165, 163, 255] };
/** Of each of the discs that a contact shadow is made of. */
const SHADOW = { light: 0.12, dark: 0.26 };

/** Convex hull of [x, y] points, counter-clockwise (monotone chain). */
export function hull(points) {
  const sorted = [...points].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  if (sorted.length < 3) return sorted;
  const turn = (a, b, c) => (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  const half = (ordered) => {
    const chain = [];
    for (const point of ordered) {
      while (chain.length >= 2 && turn(chain.at(-2), chain.at(-1), point) <= 0) chain.pop();
      chain.push(point);
    }
    return chain.slice(0, -1);
  };
  return [...half(sorted), ...half(sorted.reverse())];
}

/** [x, y, z] points joined one to the next, as the n × 2 × 3 values of line pieces. */
export function pieces(points, closed = false) {
  const last = closed ? points.length : points.length - 1;
  const values = new Float32Array(Math.max(last, 1) * 6);
  for (let i = 0; i < last; i += 1) {
    values.set(points[i], 6 * i);
    values.set(points[(i + 1) % points.length], 6 * i + 3);
  }
  return values;
}

/** Index of the sample that is current at a time: the last one not after it. */
export function sampleAt(times, time) {
  let low = 0;
  let high = times.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (times[middle] <= time + 1e-6) low = middle;
    else high = middle - 1;
  }
  return low;
}

/** Line pieces round corners with gaps between them. */
function dashes(corners) {
  const parts = [];
  corners.forEach((start, index) => {
    const end = corners[(index + 1) % corners.length];
    const length = Math.hypot(...start.map((value, axis) => end[axis] - value));
    const at = (place) =>
      start.map((value, axis) => value + ((end[axis] - value) * Math.min(place, length)) / length);
    for (let place = 0; place < length; place += DASH + SPACE) parts.push(...at(place), ...at(place + DASH));
  });
  return parts.length ? Float32Array.from(parts) : new Float32Array(6);
}

/** Colours of a support polygon by its margin (m). */
function marginColour(margin, caution) {
  if (margin < 0) return BAD;
  return margin < caution ? CAUTION : GOOD;
}

/** Height of the floor, m. */
export const floorOf = (overlay) => overlay?.floor ?? SHOD_FLOOR;

/**
 * @param {Record<string, any>} overlay
 * @param {number[]} at
 * @param {number} layer how far above the floor, in gaps
 * @returns {number[]}
 */
const floorPoint = (overlay, [x, y], layer) => [x, y, floorOf(overlay) + layer * GAP];

const BALANCE = new Set(["body_torque", "margin"]);
const missing = (trouble, sample) => trouble.filter(({ first, last }) => first <= sample && sample <= last);

/** The feet that stand at a sample. */
export const standing = (overlay, sample) =>
  overlay.feet[sample].filter((_, foot) => overlay.contact[sample][foot]);

/** [node, properties] pairs of a sample's support polygon; its edge is broken where balance is lacking. */
export function polygonUpdates(overlay, sample, caution, trouble = [], theme = "light", isGrey = false) {
  const corners = hull(standing(overlay, sample).map(([x, y]) => [x, y]));
  const lacks = isGrey || missing(trouble, sample).some(({ family }) => BALANCE.has(family));
  const colour = Uint8Array.from((lacks ? BAD : marginColour(overlay.margins[sample], caution))[theme]);
  const edge = corners.map((corner) => floorPoint(overlay, corner, 2));
  const area =
    corners.length >= 3
      ? corners
      : [
          [0, 0],
          [0, 0],
          [0, 0],
        ];
  const vertices = Float32Array.from(area.flatMap((corner) => floorPoint(overlay, corner, 1)));
  const faces = new Uint32Array((area.length - 2) * 3);
  for (let i = 0; i < area.length - 2; i += 1) faces.set([0, i + 1, i + 2], 3 * i);
  return [
    ["/overlay/polygon", { vertices, faces, color: [...colour] }],
    [
      "/overlay/polygon_edge",
      { points: lacks ? dashes(edge) : pieces(edge, corners.length > 2), colors: colour },
    ],
  ];
}

/** The update that marks an infeasible sample: the polygon's edge, and where the foot could be. */
export function troubleUpdates(overlay, sample, trouble, theme = "light") {
  const at = (foot) => floorPoint(overlay, overlay.feet[sample][foot], 4);
  const lines = [];
  for (const { first, feet, rings, places } of missing(trouble, sample)) {
    const [ring, place] = [rings?.[sample - first], places?.[sample - first]];
    if (ring)
      lines.push(
        ...pieces(
          ring.map((corner) => floorPoint(overlay, corner, 4)),
          true,
        ),
        ...cross(place ? floorPoint(overlay, place, 4) : at(feet[0])),
      );
    else if (feet.length === 2) lines.push(...pieces(feet.map(at)));
  }
  return [
    "/overlay/trouble",
    {
      points: lines.length ? Float32Array.from(lines) : new Float32Array(6),
      colors: Uint8Array.from(BAD[theme]),
    },
  ];
}

/** Line pieces of several drawings. */
const joined = (parts) => Float32Array.from(parts.flatMap((part) => [...part]));

/** @param {number[]} at */
function cross([x, y, z], arm = 0.004) {
  return [
    ...pieces([
      [x - arm, y - arm, z],
      [x + arm, y + arm, z],
    ]),
    ...pieces([
      [x - arm, y + arm, z],
      [x + arm, y - arm, z],
    ]),
  ];
}

/** Where the centre of pressure is at a time, linear between samples; null where it is not known. */
export function pressureAt(overlay, time) {
  const { cop, times } = overlay;
  if (!cop) return null;
  const at = sampleAt(times, time);
  const next = Math.min(at + 1, times.length - 1);
  const part = next > at ? Math.min(Math.max((time - times[at]) / (times[next] - times[at]), 0), 1) : 0;
  return floorPoint(
    overlay,
    [0, 1].map((axis) => cop[at][axis] * (1 - part) + cop[next][axis] * part),
    5,
  );
}

/** Updates for everything that stays the same all through a plan: [node, properties] pairs. */
export function planUpdates(overlay, theme) {
  const ink = Uint8Array.from(INK[theme]);
  const trace = overlay.com.map((point) => floorPoint(overlay, point, 3));
  /** @type {[string, Record<string, any>][]} */
  const updates = [
    [
      "/overlay/com_trace",
      {
        points: joined([pieces(trace), ...(overlay.stops ?? []).map((at) => cross(trace[at], 0.0022))]),
        colors: ink,
      },
    ],
    ["/overlay/com", { color: [...ink] }],
    ["/overlay/com/quarters", { color: PAPER[theme] }],
    ["/overlay/contact_shadow", { opacity: SHADOW[theme] }],
  ];
  if (overlay.cop) {
    const accent = Uint8Array.from(ACCENT[theme]);
    updates.push(
      [
        "/overlay/cop_trace",
        { points: pieces(overlay.cop.map((point) => floorPoint(overlay, point, 4))), colors: accent },
      ],
      ["/overlay/cop", { color: [...accent] }],
    );
  }
  for (let foot = 0; foot < overlay.feet[0].length; foot += 1) {
    updates.push([`/overlay/swing${foot + 1}`, { points: swings(overlay, foot) }]);
    updates.push([`/overlay/foothold${foot + 1}`, { points: footholds(overlay, foot) }]);
  }
  return updates;
}

/** A foot's sole while it swings, from the knot where it leaves to the knot where it lands. */
function swings(overlay, foot) {
  const parts = [];
  for (let i = 0; i + 1 < overlay.times.length; i += 1) {
    if (overlay.contact[i][foot] && overlay.contact[i + 1][foot]) continue;
    for (const [x, y, z] of [overlay.feet[i][foot], overlay.feet[i + 1][foot]]) {
      parts.push(x, y, z + floorOf(overlay) + 2 * GAP);
    }
  }
  return parts.length ? Float32Array.from(parts) : new Float32Array(6);
}

/** A ring at each place where a foot comes to stand after a swing. */
function footholds(overlay, foot) {
  const rings = [];
  for (let i = 1; i < overlay.times.length; i += 1) {
    if (!overlay.contact[i][foot] || overlay.contact[i - 1][foot]) continue;
    const [x, y] = overlay.feet[i][foot];
    const ring = Array.from({ length: RING_PIECES }, (_, piece) => {
      const angle = (2 * Math.PI * piece) / RING_PIECES;
      return floorPoint(overlay, [x + RING_RADIUS * Math.cos(angle), y + RING_RADIUS * Math.sin(angle)], 2);
    });
    rings.push(...pieces(ring, true));
  }
  return rings.length ? Float32Array.from(rings) : new Float32Array(6);
}
