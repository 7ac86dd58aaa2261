/**
 * Surfaces lit at their corners where there is no GPU: the client's own shading computes a light model and a tone curve
 * for every pixel, which takes software drawing longer than all else in the scene together.
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
  material.onBeforeCompile = (shader) => Object.assign(shader, { vertexShader: CORNERS, fragmentShader: PIXELS });
  material.customProgramCacheKey = () => "plain surface";
  material.needsUpdate = true;
}

/** Leaves out the client's picture behind the scene where there is none: it runs over every pixel to draw nothing. */
export function leaveOutNoPicture(part) {
  const { enabled, colorMap } = part.material?.uniforms ?? {};
  if (colorMap && enabled?.value === false) part.visible = false;
}
