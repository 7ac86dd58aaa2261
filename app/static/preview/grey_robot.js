/** The robot in shades of grey: its surfaces get other colours, once, so that no frame costs more. */

const DARKEST = 0.22;
const SPREAD = 0.4;
/** Of the light in the dark theme, whose lamp is as bright. */
const DIMMED = 0.45;

const own = new WeakMap();
const lightness = ({ r, g, b }) => 0.21 * r + 0.72 * g + 0.07 * b;

/** Paints all surfaces under a node of the scene in grey, or in their own colours again. */
export function paintGrey(node, isGrey, isDark) {
  node?.traverse(({ isMesh, material }) => {
    if (!isMesh || material.type !== "MeshStandardMaterial") return;
    if (!own.has(material)) own.set(material, material.color.clone());
    const colour = own.get(material);
    if (isGrey) material.color.setScalar((DARKEST + SPREAD * lightness(colour)) * (isDark ? DIMMED : 1));
    else material.color.copy(colour);
  });
}
