/**
 * Lines drawn as plain triangles where there is no GPU, with the tone curve at their corners. Viser draws a
 * line's pieces as instances of one piece, and software drawing takes as long for each instance as for a
 * whole part of the robot; and it rounds ends and computes the tone curve pixel by pixel. The client lives in
 * a window of its own, so arrays and classes are made of those that its objects have.
 */

const CORNERS = `
  #include <tonemapping_pars_fragment>
  #include <colorspace_pars_fragment>
  uniform vec3 diffuse;
  varying vec3 plainColour;
  void main() {
    plainColour = diffuse;
    #ifdef USE_COLOR
      plainColour *= position.y < 0.5 ? instanceColorStart : instanceColorEnd;
    #endif
    plainColour = sRGBTransferOETF(vec4(ACESFilmicToneMapping(plainColour), 1.0)).rgb;`;

const PIXELS = `
  uniform float opacity;
  varying vec3 plainColour;
  void main() { gl_FragColor = vec4(plainColour, opacity); }`;

const plainMaterials = new WeakSet();

const parentOf = (type) => Object.getPrototypeOf(type);

/** Writes both ends of each piece, six values, once for each corner of the piece. */
function writePieces(values, points, corners) {
  for (let piece = 0; piece < points.length; piece += 6) {
    const value = points.subarray(piece, piece + 6);
    for (let corner = 0; corner < corners; corner += 1) values.set(value, piece * corners + corner * 6);
  }
}

/**
 * Moves the ends of a line's pieces in the buffer that is drawn from.
 * @param {Record<string, any>} geometry as the client made it, or a plain one
 * @param {Float32Array} points pieces × 2 × 3 values
 * @returns {boolean} false where it has another number of pieces; then nothing is moved
 */
export function moveEnds(geometry, points) {
  const { data } = geometry.attributes.instanceStart;
  const corners = geometry.userData.corners ?? 1;
  if (data.array.length !== points.length * corners) return false;
  writePieces(data.array, points, corners);
  data.needsUpdate = true;
  geometry.boundingSphere = geometry.boundingBox = null;
  return true;
}

/** An attribute of the one piece, again for every piece. */
function repeated({ array, itemSize, constructor }, pieces) {
  const values = new array.constructor(pieces * array.length);
  for (let piece = 0; piece < pieces; piece += 1) values.set(array, piece * array.length);
  return new constructor(values, itemSize);
}

/** Both ends' attributes, which share one buffer of six values a piece, with a copy for each corner. */
function spread(plain, { attributes }, start, end, corners) {
  const from = attributes[start];
  if (!from) return;
  const { array } = from.data;
  const buffer = new (parentOf(from.data.constructor))(new array.constructor(array.length * corners), 6);
  writePieces(buffer.array, array, corners);
  plain.setAttribute(start, new from.constructor(buffer, 3, 0));
  plain.setAttribute(end, new from.constructor(buffer, 3, 3));
}

/** The class of geometries without instances that a class of lines comes from. */
const plainType = (type) => (new type().isInstancedBufferGeometry ? plainType(parentOf(type)) : type);

/** The same lines as one geometry without instances; the client's line shader draws both alike. */
function plainGeometry(lines) {
  const { position, uv, instanceStart } = lines.attributes;
  const [corners, pieces] = [position.count, instanceStart.count];
  const plain = new (plainType(lines.constructor))();
  plain.setAttribute("position", repeated(position, pieces));
  plain.setAttribute("uv", repeated(uv, pieces));
  spread(plain, lines, "instanceStart", "instanceEnd", corners);
  spread(plain, lines, "instanceColorStart", "instanceColorEnd", corners);
  plain.setIndex(
    Array.from({ length: pieces }, (_, piece) =>
      Array.from(lines.index.array, (corner) => corner + piece * corners),
    ).flat(),
  );
  plain.userData.corners = corners;
  lines.addEventListener("dispose", () => plain.dispose());
  return plain;
}

/** Gives a line's material the plain shading, once; broken lines keep the client's. */
function shadePlainly(material) {
  if (plainMaterials.has(material) || material.dashed) return;
  plainMaterials.add(material);
  material.onBeforeCompile = (shader) =>
    Object.assign(shader, {
      vertexShader: shader.vertexShader.replace("void main() {", CORNERS),
      fragmentShader: PIXELS,
    });
  material.customProgramCacheKey = () => "plain line";
  material.needsUpdate = true;
}

/** Makes a line plain that the client draws as instances; anything else is left alone. */
export function drawLinePlainly(part) {
  if (!part.isLineSegments2) return;
  shadePlainly(part.material);
  if (!part.geometry.isInstancedBufferGeometry) return;
  part.geometry = plainGeometry(part.geometry);
  // The visible box of a geometry follows from its positions, which are those of the one piece here.
  part.frustumCulled = false;
}
