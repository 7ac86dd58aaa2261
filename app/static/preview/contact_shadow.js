/**
 * A soft shadow on the floor where a foot stands: discs that lie over one another and grow, all in one mesh,
 * so that it costs one part of the scene and is made anew only where another foot stands.
 */

const RADII = [0.0205, 0.018, 0.0155, 0.0135];
const CORNERS = 16;
/** Away from the lamp (app/scene/environment.py), m. */
const OFFSET = [-0.0012, 0.0024];
const GAP = 0.00006;

/**
 * @param {number[][]} feet [x, y, …] of the feet that stand, m
 * @param {number} floor its height, m
 * @returns {{vertices: Float32Array, faces: Uint32Array}} one triangle of no size where no foot stands
 */
export function contactShadow(feet, floor) {
  if (feet.length === 0) return { vertices: new Float32Array(9), faces: Uint32Array.of(0, 1, 2) };
  const [vertices, faces] = [[], []];
  // Layer by layer from below: what is drawn later must not lie under what is drawn before.
  RADII.forEach((radius, layer) => {
    for (const [x, y] of feet) {
      const first = vertices.length / 3;
      for (let corner = 0; corner < CORNERS; corner += 1) {
        const angle = (2 * Math.PI * corner) / CORNERS;
        vertices.push(
          x + OFFSET[0] + radius * Math.cos(angle),
          y + OFFSET[1] + radius * Math.sin(angle),
          floor + (layer + 1) * GAP,
        );
      }
      for (let corner = 2; corner < CORNERS; corner += 1)
        faces.push(first, first + corner - 1, first + corner);
    }
  });
  return { vertices: Float32Array.from(vertices), faces: Uint32Array.from(faces) };
}
