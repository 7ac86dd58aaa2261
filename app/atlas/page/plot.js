// The picture: scales with round ticks, a dot a gait, the front, and marks for the gaits that are looked at.
const TONES = 20; // colours of a key that is a range
const OPACITY = 0.72; // of a dot
const MOST_TONES = 24; // choices that have a colour each
const MARGINS = { left: 58, right: 18, top: 14, bottom: 44 }; // around the plot, px
const GAP = 72; // least distance of ticks, px
const MANY = 6000; // from so many gaits on dots are smaller
const FONT = "12px system-ui, -apple-system, 'Segoe UI', Roboto, 'DejaVu Sans', sans-serif";
const points = /** @type {HTMLCanvasElement} */ (document.getElementById("points"));
const map = /** @type {HTMLCanvasElement} */ (document.getElementById("map"));
// Painted by the processor, because the dots are blended there.
const pen = points.getContext("2d", { willReadFrequently: true });
const marks = map.getContext("2d");
let palette = readPalette();
/** What was painted last: places of the gaits on the canvas, CSS px, and the scales that led there. */
const plot = { width: 0, height: 0, across: null, up: null, places: new Float32Array(2 * atlas.count) };

/** @returns {Record<string, any>} */
function readPalette() {
  const style = getComputedStyle(document.documentElement);
  const read = (name) => style.getPropertyValue(`--${name}`).trim();
  const names = ["ink", "ink-2", "quiet", "line", "panel", "accent", "low", "high"];
  const choices = Array.from({ length: 8 }, (_, place) => read(`choice-${place + 1}`));
  return { ...Object.fromEntries(names.map((name) => [name, read(name)])), choices };
}

/** A step of 1, 2 or 5 times a power of ten that cuts a range into at most so many pieces. */
function roundStep(width, pieces) {
  const least = width / Math.max(pieces, 1);
  const power = 10 ** Math.floor(Math.log10(least));
  return power * [1, 2, 5, 10].find((times) => times * power >= least * (1 - 1e-9));
}

/**
 * A scale from the values of a key, in the unit of people, to px.
 * @param {Column} column
 * @param {number[]} gaits that it has room for
 * @param {number} from px of its low end
 * @param {number} to px of its high end
 */
function scaleOf(column, gaits, from, to) {
  let [low, high] = [Infinity, -Infinity];
  for (const gait of gaits) {
    const value = column.numbers[gait] * column.factor;
    if (value < low) low = value;
    if (value > high) high = value;
  }
  if (low > high) [low, high] = [0, 1];
  const least = Math.max(Math.abs(low) * 0.1, 0.5 * 10 ** -(column.decimals ?? 1)); // where all are alike
  const room = high > low ? (high - low) * 0.04 : least;
  [low, high] = [low >= 0 && low - room < 0 ? 0 : low - room, high + room];
  const step = roundStep(high - low, Math.floor(Math.abs(to - from) / GAP));
  const decimals = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  const first = Math.ceil(low / step - 1e-9);
  const count = Math.floor(high / step + 1e-9) - first + 1;
  const ticks = Array.from({ length: count }, (_, i) => (first + i) * step);
  const place = (value) => from + ((value - low) / (high - low)) * (to - from);
  return { place, ticks, from, to, words: (tick) => tick.toFixed(decimals).replace("-", "−") };
}

function fit(canvas) {
  const ratio = window.devicePixelRatio || 1;
  const [width, height] = [Math.round(plot.width * ratio), Math.round(plot.height * ratio)];
  if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
  const context = canvas === map ? marks : pen;
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, plot.width, plot.height);
  return ratio;
}

function paintAxes(x, y) {
  const { across, up } = plot;
  pen.fillStyle = palette.panel;
  pen.fillRect(0, 0, plot.width, plot.height);
  pen.font = FONT;
  pen.lineWidth = 1;
  pen.strokeStyle = palette.line;
  pen.fillStyle = palette["ink-2"];
  pen.beginPath();
  pen.textAlign = "center";
  pen.textBaseline = "top";
  for (const tick of across.ticks) {
    const at = Math.round(across.place(tick)) + 0.5;
    pen.moveTo(at, up.to);
    pen.lineTo(at, up.from);
    pen.fillText(across.words(tick), at, up.from + 6);
  }
  pen.textAlign = "right";
  pen.textBaseline = "middle";
  for (const tick of up.ticks) {
    const at = Math.round(up.place(tick)) + 0.5;
    pen.moveTo(across.from, at);
    pen.lineTo(across.to, at);
    pen.fillText(up.words(tick), across.from - 8, at);
  }
  pen.stroke();
  pen.fillStyle = palette.ink;
  pen.font = `600 ${FONT}`;
  pen.textAlign = "center";
  pen.textBaseline = "bottom";
  pen.fillText(titled(x), (across.from + across.to) / 2, plot.height - 4);
  pen.save();
  pen.translate(13, (up.from + up.to) / 2);
  pen.rotate(-Math.PI / 2);
  pen.textBaseline = "middle";
  pen.fillText(titled(y), 0, 0);
  pen.restore();
}

function channels(colour) {
  return [1, 3, 5].map((start) => parseInt(colour.slice(start, start + 2), 16));
}

/** The colours of a key: one a choice, or steps from low to high. */
function tonesOf(column) {
  if (column.choices === null || column.choices.length > MOST_TONES) {
    const [low, high] = [channels(palette.low), channels(palette.high)];
    const between = (part) => low.map((value, i) => value + (high[i] - value) * part);
    return Array.from({ length: TONES }, (_, i) => hex(between(i / (TONES - 1))));
  }
  const { length } = column.choices;
  return column.choices.map((_, place) => (length <= 8 ? palette.choices[place] : hue(place / length)));
}

function hex(parts) {
  return `#${parts.map((part) => Math.round(part).toString(16).padStart(2, "0")).join("")}`;
}

/** A colour of the circle of hues, at a place from 0 to 1. */
function hue(place) {
  return hex([0, 1, 2].map((part) => 135 + 75 * Math.cos(2 * Math.PI * (place - part / 3))));
}

/** A function from a gait to the place of its colour. */
function toneFinder(column, gaits) {
  if (column.choices !== null && column.choices.length <= MOST_TONES) return (gait) => column.places[gait];
  const [low, high] = rangeOf(column, gaits);
  const values = column.isNumber ? column.numbers : column.places;
  const part = (gait) => (high > low ? (values[gait] - low) / (high - low) : 0.5);
  return (gait) => Math.min(Math.floor((part(gait) || 0) * TONES), TONES - 1);
}

/** Least and largest value of a key among some gaits, SI, or places of choices that are no numbers. */
function rangeOf(column, gaits) {
  const values = column.isNumber ? column.numbers : column.places;
  let [low, high] = [Infinity, -Infinity];
  for (const gait of gaits) {
    if (values[gait] < low) low = values[gait];
    if (values[gait] > high) high = values[gait];
  }
  return [low, high];
}

/** How much of each pixel around its middle a dot covers: places in the picture's bytes, and shares. */
function dotOf(radius, bytesPerRow) {
  const [places, shares] = [[], []];
  const reach = Math.ceil(radius);
  for (let down = -reach; down <= reach; down += 1) {
    for (let right = -reach; right <= reach; right += 1) {
      const share = OPACITY * Math.min(Math.max(radius + 0.5 - Math.hypot(right, down), 0), 1);
      if (share === 0) continue;
      places.push(down * bytesPerRow + 4 * right);
      shares.push(share);
    }
  }
  return { places: Int32Array.from(places), shares: Float32Array.from(shares) };
}

/** Lays a dot over a picture without gaps. */
function blend(bytes, middle, { places, shares }, [red, green, blue]) {
  for (let i = 0; i < places.length; i += 1) {
    const at = middle + places[i];
    const share = shares[i];
    bytes[at] += (red - bytes[at]) * share;
    bytes[at + 1] += (green - bytes[at + 1]) * share;
    bytes[at + 2] += (blue - bytes[at + 2]) * share;
  }
}

/** Paints a dot a gait. Twenty thousand are blended here in a tenth of the time that a canvas takes. */
function paintGaits(gaits, x, y, colour, ratio) {
  const picture = pen.getImageData(0, 0, points.width, points.height);
  const radius = gaits.length > MANY ? 2 : gaits.length > MANY / 6 ? 2.8 : 3.8;
  const dot = dotOf(radius * ratio, 4 * picture.width);
  const [tones, find] = [tonesOf(colour).map(channels), toneFinder(colour, gaits)];
  for (const gait of gaits) {
    const left = plot.across.place(x.numbers[gait] * x.factor);
    const top = plot.up.place(y.numbers[gait] * y.factor);
    plot.places[2 * gait] = left;
    plot.places[2 * gait + 1] = top;
    const pixel = Math.floor(top * ratio) * picture.width + Math.floor(left * ratio);
    blend(picture.data, 4 * pixel, dot, tones[find(gait)]);
  }
  pen.putImageData(picture, 0, 0);
}

function placeOf(gait) {
  return [plot.places[2 * gait], plot.places[2 * gait + 1]];
}

/** The line of the front: the border of what its gaits beat. */
function paintFrontLine(front, x, y) {
  const { across, up } = plot;
  const worse = (column, scale) => (column.better > 0 ? scale.from : scale.to);
  const [firstX, firstY] = placeOf(front[0]);
  pen.beginPath();
  pen.moveTo(worse(x, across), firstY);
  pen.lineTo(firstX, firstY);
  front.slice(1).forEach((gait, i) => {
    const [left, top] = placeOf(gait);
    pen.lineTo(placeOf(front[i])[0], top);
    pen.lineTo(left, top);
  });
  pen.lineTo(placeOf(front.at(-1))[0], worse(y, up));
  pen.stroke();
}

function paintFront(front, x, y) {
  if (front.length === 0) return;
  pen.strokeStyle = palette.ink;
  pen.lineWidth = 1.5;
  if (x.better !== 0 && y.better !== 0) paintFrontLine(front, x, y);
  pen.fillStyle = palette.panel;
  for (const gait of front) ring(pen, gait, 5.5);
}

function ring(context, gait, radius) {
  const [left, top] = placeOf(gait);
  context.beginPath();
  context.arc(left, top, radius, 0, 2 * Math.PI);
  context.stroke();
}

/** Paints everything but the marks. */
function paintMap({ gaits, front, x, y, colour }) {
  plot.width = points.clientWidth;
  plot.height = points.clientHeight;
  if (plot.width === 0 || plot.height === 0) return; // nobody sees it
  const ratio = fit(points);
  plot.across = scaleOf(x, gaits, MARGINS.left, plot.width - MARGINS.right);
  plot.up = scaleOf(y, gaits, plot.height - MARGINS.bottom, MARGINS.top);
  paintAxes(x, y);
  paintGaits(gaits, x, y, colour, ratio);
  paintFront(front, x, y);
}

/** Marks the gait that is pointed at and the one that is chosen; null for none. */
function paintMarks(pointed, chosen) {
  fit(map);
  marks.lineWidth = 2;
  for (const [gait, radius, tone] of [
    [pointed, 7, palette.ink],
    [chosen, 9, palette.accent],
  ]) {
    if (gait === null) continue;
    marks.strokeStyle = palette.panel;
    marks.lineWidth = 5;
    ring(marks, gait, radius);
    marks.strokeStyle = tone;
    marks.lineWidth = 2.5;
    ring(marks, gait, radius);
  }
}

/** The gait nearest to a place on the canvas, or null if none is as near as `reach`, px. */
function nearest(gaits, left, top, reach) {
  let [found, least] = [null, reach * reach];
  for (const gait of gaits) {
    const distance = (plot.places[2 * gait] - left) ** 2 + (plot.places[2 * gait + 1] - top) ** 2;
    if (distance <= least) [found, least] = [gait, distance];
  }
  return found;
}
