/** Where each foot's sole can be at the body's present height, as lines in the body's frame: outlines on the floor and above it. */

const POSTS = 6;

/** A colour's share as light: the client takes colours of line ends for that, and shows them paler otherwise. */
const asLight = (value) => Math.round(255 * (value > 10 ? ((value / 255 + 0.055) / 1.055) ** 2.4 : value / 255 / 12.92));

/** A point of a module's frame (y outwards) in the robot's. */
function inRobot(azimuth, radius, [x, y], z) {
  const [cosine, sine] = [Math.cos(azimuth), Math.sin(azimuth)];
  return [(radius + y) * cosine + x * sine, (radius + y) * sine - x * cosine, z];
}

/** Points of a layer's outline in the module's frame; null where nothing of it can be reached. */
function outline(radii) {
  if (radii.some((radius) => radius <= 0)) return null;
  return radii.map((radius, ray) => [radius * Math.cos((2 * Math.PI * ray) / radii.length), radius * Math.sin((2 * Math.PI * ray) / radii.length)]);
}

/** Index pairs [layer, ray] of the lines: round each layer, and a few posts from layer to layer. */
function* edges(rings) {
  for (let layer = 0; layer < rings.length; layer += 1) {
    if (!rings[layer]) continue;
    const rays = rings[layer].length;
    for (let ray = 0; ray < rays; ray += 1) yield [[layer, ray], [layer, (ray + 1) % rays]];
    if (!rings[layer + 1]) continue;
    for (let ray = 0; ray < rays; ray += rays / POSTS) yield [[layer, ray], [layer + 1, ray]];
  }
}

/**
 * Line pieces of every leg's reach at a sample, each in its foot's colour.
 * @param {{radii: number[][][], layers: number[], planes: number[], sole: number, azimuths: number[], radius: number, colours: number[][]}} shells
 *   radii [sample][layer][ray] and heights of layers and actuator plane over the standing feet in m, and how deep the sole is under the foot's point; `GET …/reach`
 * @returns {{points: Float32Array, colors: Uint8Array}}
 */
export function shellUpdate(shells, sample) {
  const { layers, planes, sole, azimuths, radius, colours } = shells;
  const rings = shells.radii[sample].map(outline);
  const [points, colors] = [[], []];
  const lights = colours.map((colour) => colour.map(asLight));
  azimuths.forEach((azimuth, leg) => {
    for (const ends of edges(rings)) {
      for (const [layer, ray] of ends) {
        points.push(...inRobot(azimuth, radius, rings[layer][ray], layers[layer] - planes[sample] - sole));
        colors.push(...lights[leg]);
      }
    }
  });
  if (points.length === 0) return { points: new Float32Array(6), colors: new Uint8Array(6) };
  return { points: Float32Array.from(points), colors: Uint8Array.from(colors) };
}
