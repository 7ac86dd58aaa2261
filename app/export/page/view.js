// The view: a camera that looks at the robot from above, and shapes painted from back to front.
const data = JSON.parse(document.getElementById("motion").textContent);
const canvas = /** @type {HTMLCanvasElement} */ (document.getElementById("stage"));
// Painted by the processor: as smooth with a graphics card, and far smoother without one.
const pen = canvas.getContext("2d", { willReadFrequently: true });
const LIGHT = unit([0.45, -0.75, 1.9]);
const FIELD_OF_VIEW = (32 * Math.PI) / 180;
const LOWEST_PITCH = 0.28; // from here on the eye is above every part, as the order of painting needs
const camera = {
  yaw: 0,
  pitch: 0,
  distance: 1,
  target: [0, 0, 0],
  eye: [0, 0, 0],
  axes: [],
  focal: 1,
  centre: [0, 0],
  showsBody: true,
};
let palette = readPalette();

function unit(v) {
  const length = Math.hypot(...v) || 1;
  return v.map((part) => part / length);
}

function cross(a, b) {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

function dot(a, b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

function mix(a, b, part) {
  return a + (b - a) * part;
}

function readPalette() {
  const style = getComputedStyle(document.documentElement);
  const names = ["ink", "quiet", "line", "good", "caution", "bad", "sky", "ground", "grid", "panel"];
  return Object.fromEntries(names.map((name) => [name, style.getPropertyValue(`--${name}`).trim()]));
}

/** Sets the camera's axes for a canvas of this size, CSS px. */
function aim(width, height) {
  const { yaw, pitch, distance, target } = camera;
  const back = [Math.cos(yaw) * Math.cos(pitch), Math.sin(yaw) * Math.cos(pitch), Math.sin(pitch)];
  camera.eye = target.map((part, axis) => part + distance * back[axis]);
  const right = [-Math.sin(yaw), Math.cos(yaw), 0];
  camera.axes = [right, cross(back, right), back];
  camera.focal = (0.5 * Math.min(height, width * 0.75)) / Math.tan(FIELD_OF_VIEW / 2);
  camera.centre = [width / 2, height / 2];
}

/** [x, y, depth]: place on the canvas in CSS px, and distance along the view. */
function project(point) {
  const [right, up, back] = camera.axes;
  const from = [point[0] - camera.target[0], point[1] - camera.target[1], point[2] - camera.target[2]];
  const depth = Math.max(camera.distance - dot(from, back), 0.01);
  const scale = camera.focal / depth;
  return [camera.centre[0] + dot(from, right) * scale, camera.centre[1] - dot(from, up) * scale, depth];
}

function rgb(colour) {
  return [1, 3, 5].map((start) => parseInt(colour.slice(start, start + 2), 16));
}

/** A colour in the light that falls on a face, 0 dark to 1 as it is. */
function lit(colour, normal) {
  const light = 0.58 + 0.42 * Math.max(0, dot(normal, LIGHT));
  return `rgb(${rgb(colour)
    .map((part) => Math.round(part * light))
    .join(" ")})`;
}

function blended(colour, other, part) {
  const [a, b] = [rgb(colour), rgb(other)];
  return `#${a
    .map((v, i) =>
      Math.round(mix(v, b[i], part))
        .toString(16)
        .padStart(2, "0"),
    )
    .join("")}`;
}

function outline(points, closed = true) {
  pen.beginPath();
  points.forEach((point, index) => {
    const [x, y] = project(point);
    if (index === 0) pen.moveTo(x, y);
    else pen.lineTo(x, y);
  });
  if (closed) pen.closePath();
}

function fillFace(points, fill, edge = null, alpha = 1) {
  outline(points);
  pen.globalAlpha = alpha;
  pen.fillStyle = fill;
  pen.fill();
  pen.globalAlpha = 1;
  if (edge !== null) {
    pen.strokeStyle = edge;
    pen.lineWidth = 1;
    pen.stroke();
  }
}

/** An upright prism over a convex outline that runs counter-clockwise; seen from above. */
function prism(outlineXY, low, high, colour) {
  const count = outlineXY.length;
  for (let i = 0; i < count; i += 1) {
    const [a, b] = [outlineXY[i], outlineXY[(i + 1) % count]];
    const normal = unit([b[1] - a[1], a[0] - b[0], 0]);
    const towards = [camera.eye[0] - a[0], camera.eye[1] - a[1], 0];
    if (dot(normal, towards) <= 0) continue;
    const shade = lit(colour, normal);
    fillFace(
      [
        [...a, low],
        [...b, low],
        [...b, high],
        [...a, high],
      ],
      shade,
      shade,
    );
  }
  const top = lit(colour, [0, 0, 1]);
  fillFace(
    outlineXY.map((point) => [...point, high]),
    top,
    top,
  );
}

/** A round bar between two points; width in m. */
function bar(a, b, width, colour) {
  const [p, q] = [project(a), project(b)];
  const pixels = Math.max((width * camera.focal) / ((p[2] + q[2]) / 2), 1.2);
  pen.lineCap = "round";
  for (const [extra, shade] of [
    [1.4, blended(colour, "#10151c", 0.45)],
    [0, colour],
  ]) {
    pen.strokeStyle = shade;
    pen.lineWidth = pixels + extra;
    pen.beginPath();
    pen.moveTo(p[0], p[1]);
    pen.lineTo(q[0], q[1]);
    pen.stroke();
  }
}

function circle(centre, radius, corners = 20, start = 0) {
  return Array.from({ length: corners }, (_, i) => {
    const angle = start + (2 * Math.PI * i) / corners;
    return [centre[0] + radius * Math.cos(angle), centre[1] + radius * Math.sin(angle)];
  });
}

function line(points, colour, width, alpha = 1, dash = []) {
  if (points.length < 2) return;
  outline(points, false);
  pen.globalAlpha = alpha;
  pen.strokeStyle = colour;
  pen.lineWidth = width;
  pen.lineJoin = "round";
  pen.setLineDash(dash);
  pen.stroke();
  pen.setLineDash([]);
  pen.globalAlpha = 1;
}
