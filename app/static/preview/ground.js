/** The floor as a camera sees it: a projective map between places on it and pixels; and places over it. */

/** Product of two 4 × 4 matrices given by columns. */
function product(a, b) {
  const out = new Array(16).fill(0);
  for (let column = 0; column < 4; column += 1) {
    for (let row = 0; row < 4; row += 1) {
      for (let i = 0; i < 4; i += 1) out[4 * column + row] += a[4 * i + row] * b[4 * column + i];
    }
  }
  return out;
}

/**
 * What a camera sees of the scene.
 * @param {number[][]} matrices projection, view and the scene's root, each 4 × 4 by columns
 * @param {{width: number, height: number}} size of the canvas, pixels
 * @returns {{toScreen: (at: number[]) => number[]|null, right: number[], up: number[], back: number[],
 *   eye: number[], key: string}} `toScreen` maps [x, y, z] in m to pixels of the canvas, null for what lies
 *   behind the camera; the camera's axes and place in the scene; `key` changes with the camera and the size
 */
export function spaceView([projection, view, root], { width, height }) {
  const inCamera = product(view, root);
  const m = product(projection, inCamera);
  const row = (of, index) => [of[index], of[4 + index], of[8 + index]];
  const [right, up, back] = [0, 1, 2].map((index) => row(inCamera, index));
  const eye = right.map(
    (_, axis) => -(right[axis] * inCamera[12] + up[axis] * inCamera[13] + back[axis] * inCamera[14]),
  );
  const along = (index, [x, y, z]) => m[index] * x + m[4 + index] * y + m[8 + index] * z + m[12 + index];
  const toScreen = (at) => {
    const depth = along(3, at);
    return depth > 0
      ? [(width / 2) * (1 + along(0, at) / depth), (height / 2) * (1 - along(1, at) / depth)]
      : null;
  };
  return {
    toScreen,
    right,
    up,
    back,
    eye,
    key: `${width} ${height} ${m.map((value) => value.toFixed(5)).join()}`,
  };
}

/**
 * Inverse of a 3 × 3 matrix, up to its scale.
 * @param {number[]} matrix given by rows
 */
function adjugate([a, b, c, d, e, f, g, h, i]) {
  return [
    e * i - f * h,
    c * h - b * i,
    b * f - c * e,
    f * g - d * i,
    a * i - c * g,
    c * d - a * f,
    d * h - e * g,
    b * g - a * h,
    a * e - b * d,
  ];
}

/**
 * @param {number[]} m projective map, 3 × 3 by rows
 * @param {number[]} at
 */
function apply(m, [x, y]) {
  const w = m[6] * x + m[7] * y + m[8];
  return [(m[0] * x + m[1] * y + m[2]) / w, (m[3] * x + m[4] * y + m[5]) / w];
}

/**
 * @param {number[][]} matrices projection, view and the scene's root, each 4 × 4 by columns
 * @param {number} height of the plane in the scene, m
 * @param {{left: number, top: number, width: number, height: number}} box of the canvas, pixels
 * @returns {{toScreen: (at: number[]) => number[]|null, toGround: (at: number[]) => number[], key: string}}
 *   `toScreen` gives null for what lies behind the camera; `key` changes with the camera
 */
export function groundView([projection, view, root], height, box) {
  const m = product(product(projection, view), root);
  // Columns x, y and 1 of the plane; rows x, y and w of what is seen.
  const row = (index) => [m[index], m[4 + index], m[8 + index] * height + m[12 + index]];
  const [x, y, w] = [row(0), row(1), row(3)];
  const seen = [
    ...x.map((value, i) => box.left * w[i] + (box.width / 2) * (value + w[i])),
    ...y.map((value, i) => box.top * w[i] + (box.height / 2) * (w[i] - value)),
    ...w,
  ];
  const back = adjugate(seen);
  /** @param {number[]} at */
  const before = ([a, b]) => w[0] * a + w[1] * b + w[2] > 0;
  return {
    toScreen: (at) => (before(at) ? apply(seen, at) : null),
    toGround: (at) => apply(back, at),
    key: seen.map((value) => value.toFixed(5)).join(),
  };
}
