/**
 * The canvas of a strip's curves. Without a GPU, a browser needs hundreds of milliseconds for dozens of SVG
 * paths, but only a few for a canvas.
 */

import { HEIGHT, WIDTH } from "./curves.js";
import { paintFootMark } from "./foot_marks.js";
import { h } from "../lib/dom.js";

const FEET = 12;
const NAMES = {
  fine: "--good",
  broken: "--bad",
  rule: "--quiet",
  grey: "--edge",
  grid: "--line",
  text: "--ink",
  border: "--line-2",
  limit: "--bad",
  wanted: "--caution",
};
const LINE_DASHES = { limit: [4, 3], wanted: [2, 3] };
const dark = matchMedia("(prefers-color-scheme: dark)");
let palette = null;
let font = null;
const fontNow = () => (font ??= getComputedStyle(document.body).fontFamily);
dark.addEventListener("change", () => {
  palette = null;
});

function coloursNow() {
  if (palette) return palette;
  const style = getComputedStyle(document.documentElement);
  const colour = (name) => style.getPropertyValue(name).trim();
  palette = Object.fromEntries(Object.entries(NAMES).map(([tone, name]) => [tone, colour(name)]));
  for (let foot = 1; foot <= FEET; foot += 1) palette[foot] = colour(`--foot-${foot}`);
  return palette;
}

/** Path data stretched from WIDTH × HEIGHT to `width` × `height` pixels; lines keep their thickness. */
function stretched(d, { width, height }) {
  const path = new Path2D();
  path.addPath(new Path2D(d), new DOMMatrix([width / WIDTH, 0, 0, height / HEIGHT, 0, 0]));
  return path;
}

/** Paints the level lines under the curves: grid, borders between feet, limits and requested values. */
function paintLevels(pen, colours, { width, height }, { grid = [], borders = [], lines = [] }) {
  const level = (y, tone, dash, alpha = 1) => {
    const at = Math.round((y * height) / HEIGHT) + 0.5;
    [pen.strokeStyle, pen.lineWidth, pen.globalAlpha] = [colours[tone], 1, alpha];
    pen.setLineDash(dash);
    pen.beginPath();
    pen.moveTo(0, at);
    pen.lineTo(width, at);
    pen.stroke();
  };
  grid.forEach((y) => level(y, "grid", []));
  borders.forEach((y) => level(y, "border", []));
  lines.forEach(({ y, kind }) => level(y, kind, LINE_DASHES[kind], borders.length ? 0.5 : 1));
}

/** Marks of feet, px: half a mark's width, gap between its parts, margin around them, and height. */
const MARK = { half: 4, gap: 3, edge: 2, line: 12 };
const sprites = new Map();

/** Image of a foot's mark and number, painted once: text on a visible canvas forces a layout of the page. */
function sprite(foot, fill, ink, ratio) {
  const key = `${foot} ${fill} ${ink} ${ratio}`;
  if (sprites.has(key)) return sprites.get(key);
  const { half, gap, line } = MARK;
  const font = `10px ${fontNow()}`;
  const ruler = new OffscreenCanvas(1, 1).getContext("2d");
  ruler.font = font;
  const width = Math.ceil(2 * half + gap + ruler.measureText(foot + 1).width);
  const image = new OffscreenCanvas(Math.ceil(width * ratio), Math.ceil(line * ratio));
  const pen = image.getContext("2d", { willReadFrequently: true });
  pen.scale(ratio, ratio);
  [pen.font, pen.textBaseline, pen.fillStyle] = [font, "middle", fill];
  paintFootMark(pen, foot, half, line / 2, half);
  pen.fillStyle = ink;
  pen.fillText(foot + 1, 2 * half + gap, line / 2 + 0.5);
  sprites.set(key, { image, width });
  return sprites.get(key);
}

/** Paints the marks of feet, above their rises or at the left end of their rows, on cleared ground. */
function paintMarks(pen, colours, { width, height }, ratio, { marks = [], isGrey }) {
  const { half, gap, edge, line } = MARK;
  pen.globalAlpha = 1;
  for (const { feet, x, y } of marks) {
    const parts = feet.map((foot) =>
      sprite(foot, isGrey ? colours.grey : colours[foot + 1], colours.text, ratio),
    );
    const wide = parts.reduce((sum, part) => sum + part.width + gap, -gap) + 2 * edge;
    const middle = (y * height) / HEIGHT;
    const top = Math.round(x === null ? middle - line / 2 : Math.max(middle - half - 1 - line / 2, 1));
    let left = Math.round(x === null ? edge : (x * width) / WIDTH - wide / 2);
    pen.clearRect(left, top, wide, line);
    left += edge;
    for (const part of parts) {
      pen.drawImage(part.image, left, top, part.image.width / ratio, line);
      left += part.width + gap;
    }
  }
}

function paint(element, size, drawing) {
  const { bands = [], rules = [], curves = [], clips = [] } = drawing;
  const ratio = window.devicePixelRatio || 1;
  const [across, down] = [Math.round(size.width * ratio), Math.round(size.height * ratio)];
  if (element.width !== across || element.height !== down) [element.width, element.height] = [across, down];
  // Paint on the CPU: as smooth with a GPU, and far smoother without one.
  const pen = element.getContext("2d", { willReadFrequently: true });
  pen.reset();
  pen.scale(ratio, ratio);
  pen.lineJoin = "round";
  const colours = coloursNow();
  const sx = size.width / WIDTH;
  pen.fillStyle = colours.broken;
  pen.globalAlpha = 0.16;
  for (const { x, width } of bands) pen.fillRect(x * sx, 0, width * sx, size.height);
  pen.fillStyle = colours.rule;
  for (const { x, from } of rules) {
    pen.globalAlpha = from ? 0.55 : 0.3;
    pen.fillRect(x * sx - 0.5, from * size.height, 1, size.height);
  }
  paintLevels(pen, colours, size, drawing);
  const paths = curves.map(({ d, tone, width, alpha, dash = [], offset = 0 }) => {
    const path = stretched(d, size);
    [pen.strokeStyle, pen.lineWidth, pen.globalAlpha] = [colours[tone], width, alpha];
    pen.setLineDash(dash);
    pen.lineDashOffset = offset;
    pen.stroke(path);
    return path;
  });
  if (clips.length) paintBeyond(pen, colours, size, paths, clips);
  paintMarks(pen, colours, size, ratio, drawing);
}

/** Paints the curves again, in the colour of errors, where they pass a limit. */
function paintBeyond(pen, colours, { width, height }, paths, clips) {
  const where = new Path2D();
  for (const clip of clips) where.rect(0, (clip.y * height) / HEIGHT, width, (clip.height * height) / HEIGHT);
  pen.save();
  pen.clip(where);
  pen.setLineDash([]);
  [pen.strokeStyle, pen.lineWidth, pen.globalAlpha] = [colours.broken, 2, 1];
  paths.forEach((path) => pen.stroke(path));
  pen.restore();
}

/**
 * Builds a strip's canvas; it is painted again when the strip's size or the theme changes.
 * @returns {{element: HTMLCanvasElement, show: (drawing: Record<string, any>) => void}} a drawing has
 *   `bands` of missing values {x, width};
 *   `rules`, vertical lines {x, from}, `from` a share of the height from the top;
 *   `grid` and `borders`, heights of level lines; `lines` {y, kind ("limit", "wanted")};
 *   `curves` {d, tone (a foot's number, "fine", "grey"), width, alpha, dash, offset};
 *   `clips` {y, height}, where the curves pass a limit; `marks` {feet, x, y}, x null for the left end;
 *   `isGrey`, whether the marks are grey
 */
export function stripCanvas(strip) {
  const element = h("canvas", { "aria-hidden": "true" });
  let size = null;
  let drawing = {};
  const again = () => {
    if (size?.width > 0 && size.height > 0) paint(element, size, drawing);
  };
  new ResizeObserver(([{ contentRect }]) => {
    size = { width: contentRect.width, height: contentRect.height };
    again();
  }).observe(strip);
  dark.addEventListener("change", again);
  return {
    element,
    show(next) {
      drawing = next;
      again();
    },
  };
}
