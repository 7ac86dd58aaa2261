/** Estimates where a clicked pixel lies on the platform, from the points set so far. The server computes the real fit. */

const UNKNOWNS = 8;
const LEAST_POINTS = 4;
const SINGULAR = 1e-12;

/** Solves A x = b by elimination with pivots; null where A tells no x. */
function solved(matrix, right) {
  const rows = matrix.map((row, index) => [...row, right[index]]);
  const size = rows.length;
  for (let column = 0; column < size; column += 1) {
    const pivot = rows.slice(column).reduce((best, row, index) => (Math.abs(row[column]) > Math.abs(rows[best][column]) ? index + column : best), column);
    [rows[column], rows[pivot]] = [rows[pivot], rows[column]];
    if (Math.abs(rows[column][column]) < SINGULAR) return null;
    for (let other = 0; other < size; other += 1) {
      if (other === column) continue;
      const factor = rows[other][column] / rows[column][column];
      rows[other] = rows[other].map((value, index) => value - factor * rows[column][index]);
    }
  }
  return rows.map((row, index) => row[size] / row[index]);
}

/** Two equations a point of the homography's eight numbers: x (g u + h v + 1) = a u + b v + c, and so for y. */
function equations(points, scale) {
  return points.flatMap(({ pixel, place_cm: [x, y] }) => {
    const [u, v] = pixel.map((value) => value / scale);
    return [{ row: [u, v, 1, 0, 0, 0, -x * u, -x * v], value: x }, { row: [0, 0, 0, u, v, 1, -y * u, -y * v], value: y }];
  });
}

/**
 * The place of a pixel by least squares over the points.
 * @param {{pixel: number[], place_cm: number[]}[]} points
 * @param {number[]} pixel
 * @returns {number[]|null} cm; null where fewer than four points, or points on a line, tell nothing
 */
export function guessPlace(points, pixel) {
  if (points.length < LEAST_POINTS) return null;
  const scale = Math.max(...points.flatMap((one) => one.pixel.map(Math.abs)), 1);
  const all = equations(points, scale);
  const indices = Array.from({ length: UNKNOWNS }, (_, index) => index);
  const normal = indices.map((i) => indices.map((j) => all.reduce((sum, { row }) => sum + row[i] * row[j], 0)));
  const view = solved(normal, indices.map((i) => all.reduce((sum, { row, value }) => sum + row[i] * value, 0)));
  if (!view) return null;
  const [a, b, c, d, e, f, g, k] = view;
  const [u, v] = pixel.map((value) => value / scale);
  const depth = g * u + k * v + 1;
  return [(a * u + b * v + c) / depth, (d * u + e * v + f) / depth];
}
