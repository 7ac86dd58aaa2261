/**
 * Surfaces lit at their corners where there is no GPU: the client's own shading computes a light model and a
 * tone curve for every pixel, which takes software drawing longer than all else in the scene together. And
 * surfaces in grey: they get other colours once, so that no frame costs more.
 */

const CORNERS = `
  uniform vec3 diffuse;
  varying vec3 lit;
  void main() {
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
    float towardsLamp = dot(normalize(normalMatrix * normal), vec3(0.29, 0.77, 0.57));
    float light = 0.72 + 0.5 * max(towardsLamp, 0.0) - 0.16 * max(-towardsLamp, 0.0);
    lit = pow(min(diffuse * light + 0.012 * light, 1.0), vec3(1.0 / 2.2));
  }`;

const PIXELS = `
  uniform float opacity;
  varying vec3 lit;
  void main() { gl_FragColor = vec4(lit, opacity); }`;

const plain = new WeakSet();

/** Gives a surface the plain shading, once; anything else is left alone. */
export function drawSurfacePlainly({ isMesh, material }) {
  if (!isMesh || material.type !== "MeshStandardMaterial" || plain.has(material)) return;
  plain.add(material);
  material.onBeforeCompile = (shader) =>
    Object.assign(shader, { vertexShader: CORNERS, fragmentShader: PIXELS });
  material.customProgramCacheKey = () => "plain surface";
  material.needsUpdate = true;
}

/** Leaves out the client's empty picture behind the scene: it runs over every pixel to draw nothing. */
export function leaveOutNoPicture(part) {
  const { enabled, colorMap } = part.material?.uniforms ?? {};
  if (colorMap && enabled?.value === false) part.visible = false;
}

/** Shades of grey: the darkest, and how much lighter white is. */
const DARKEST = 0.22;
const SPREAD = 0.4;
/** Of the light in the dark theme, whose lamp is as bright. */
const DIMMED = 0.45;

const ownColours = new WeakMap();
const lightness = ({ r, g, b }) => 0.21 * r + 0.72 * g + 0.07 * b;

/** Paints all surfaces under a node of the scene in grey, or in their own colours again. */
export function paintGrey(node, isGrey, isDark) {
  node?.traverse(({ isMesh, material }) => {
    if (!isMesh || material.type !== "MeshStandardMaterial") return;
    if (!ownColours.has(material)) ownColours.set(material, material.color.clone());
    const colour = ownColours.get(material);
    if (isGrey) material.color.setScalar((DARKEST + SPREAD * lightness(colour)) * (isDark ? DIMMED : 1));
    else material.color.copy(colour);
  });
}
