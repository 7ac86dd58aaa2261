/** A strip plot as a file: a picture with axes (SVG, PNG), or the values (CSV). */

import { MOTORS } from "../lib/format.js";
import { h } from "../lib/dom.js";
import { robotSecondsAt } from "../state/robot_seconds.js";
import { fractionAt, labelEvery } from "../state/time_axis.js";
import { HEIGHT, WIDTH } from "./curves.js";
import { footMark } from "./foot_marks.js";
import { lineNames } from "./strip_picture.js";

const SIZE = { width: 960, height: 260, left: 70, right: 90, top: 44, bottom: 44 };
const PNG_SCALE = 2;
/** Colours of the picture: light for print, also when the page is dark. */
const INK = {
  text: "#161b22",
  quiet: "#5f6978",
  grid: "#e2e5ea",
  border: "#8a929f",
  fine: "#0b7470",
  limit: "#b3145f",
  wanted: "#7d5a00",
  grey: "#8a929f",
};
const SHEET = "#ffffff";
/** The page's own colours of feet (see base.css). */
const footColours = () => {
  const style = getComputedStyle(document.documentElement);
  return (foot) => style.getPropertyValue(`--foot-${foot}`).trim();
};

const escaped = (text) =>
  String(text).replace(
    /[&<>"]/g,
    (mark) => ({ "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" })[mark],
  );
const text = (x, y, words, { anchor = "start", fill = INK.text, size = 12, weight = 400 } = {}) =>
  `<text x="${x.toFixed(1)}" y="${y.toFixed(1)}" text-anchor="${anchor}" fill="${fill}" `
  + `font-size="${size}" font-weight="${weight}">${escaped(words)}</text>`;
const rule = (x1, y1, x2, y2, stroke, dash = "") =>
  `<line x1="${x1.toFixed(1)}" y1="${y1.toFixed(1)}" x2="${x2.toFixed(1)}" y2="${y2.toFixed(1)}" `
  + `stroke="${stroke}"${dash && ` stroke-dasharray="${dash}"`}/>`;

function axisLabels(axis, width, bottom) {
  const every = labelEvery(axis, width);
  const labels = [];
  for (let count = 0; count * every <= axis.duration + 1e-9; count += 1) {
    const share = fractionAt(axis, count * every);
    if (share < -1e-9 || share > 1 + 1e-9) continue;
    const x = SIZE.left + share * width;
    labels.push(
      rule(x, bottom, x, bottom + 4, INK.border),
      text(x, bottom + 17, Math.round(count * every * 10) / 10, {
        anchor: "middle",
        fill: INK.quiet,
        size: 11,
      }),
    );
  }
  return labels;
}

/** The curves as a drawing that is stretched over the plot; lines keep their thickness. */
function curveLayer({ curves }, width, height, colour) {
  const path = ({ d, tone, width: line, dash, offset = 0 }) => {
    if (!d) return d;
    const dashes = dash?.length ? ` stroke-dasharray="${dash.join(" ")}" stroke-dashoffset="${offset}"` : "";
    return (
      `<path d="${d}" fill="none" stroke="${colour(tone)}" stroke-width="${line}" `
      + `vector-effect="non-scaling-stroke"${dashes}/>`
    );
  };
  return (
    `<svg x="${SIZE.left}" y="${SIZE.top}" width="${width}" height="${height}" `
    + `viewBox="0 0 ${WIDTH} ${HEIGHT}" preserveAspectRatio="none">${curves.map(path).join("")}</svg>`
  );
}

function legend(names) {
  let x = SIZE.width - SIZE.right;
  return names
    .toReversed()
    .map(({ word, dash }) => {
      x -= word.length * 6.6 + 44;
      return rule(x, 26, x + 26, 26, INK.text, dash.join(" ")) + text(x + 32, 30, word, { fill: INK.quiet });
    })
    .join("");
}

/** Marks of the feet: beside their bands, else at the peaks of their curves. */
function feetMarks({ bands, peaks }, { place, width, footColour }) {
  const { left } = SIZE;
  if (bands.length <= 1)
    return peaks.map(({ foot, x, y }) =>
      footMark(foot, left + (x / WIDTH) * width, place(y) - 8, footColour(foot + 1)),
    );
  return bands.map(({ foot, top, bottom }) => {
    const middle = place((top + bottom) / 2);
    return (
      footMark(foot, left + 8, middle, footColour(foot + 1))
      + text(left + 16, middle + 4, foot + 1, { size: 11 })
    );
  });
}

/** The row below the plot that names the feet. */
const feetKey = (feet, bottom, footColour) =>
  Array.from({ length: feet }, (_, foot) => {
    const x = SIZE.left + 12 + foot * 34;
    return (
      footMark(foot, x, bottom + 34, footColour(foot + 1)) + text(x + 9, bottom + 38, foot + 1, { size: 11 })
    );
  });

/** The plot as SVG text. */
export function plotSvg({ kind, picture, axis, overs, grey, isUnder, gait, feet }) {
  const { width: whole, left, right, top, bottom: foot } = SIZE;
  const height = SIZE.height - top - foot + (picture.bands.length > 1 ? 24 * (picture.bands.length - 3) : 0);
  const [width, bottom] = [whole - left - right, top + height];
  const place = (y) => top + (y / HEIGHT) * height;
  const footColour = footColours();
  const colour = (tone) => INK[tone] ?? footColour(tone);
  const { drawing } = picture;
  const parts = [
    text(left, 20, kind.title, { weight: 600, size: 14 }),
    text(left, 36, gait, { fill: INK.quiet }),
    legend(lineNames(grey, overs, isUnder)),
    ...drawing.grid.map((y) => rule(left, place(y), left + width, place(y), INK.grid)),
    ...drawing.borders.map((y) => rule(left, place(y), left + width, place(y), INK.border)),
    ...drawing.lines.map(({ y, kind: name }) =>
      rule(left, place(y), left + width, place(y), INK[name], "4 3"),
    ),
    ...picture.ticks.map(({ value, y }) =>
      text(left - 6, place(y) + 4, Number(value.toFixed(3)), { anchor: "end", fill: INK.quiet, size: 11 }),
    ),
    ...picture.named.map(({ value, name, kind: tone, y }) =>
      text(
        left + width + 6,
        Math.min(Math.max(place(y) + 4, top + 8), bottom),
        `${name} ${Number(value.toFixed(2))}`,
        { fill: INK[tone], size: 11 },
      ),
    ),
    curveLayer(drawing, width, height, colour),
    ...feetMarks(picture, { place, width, footColour }),
    rule(left, bottom, left + width, bottom, INK.border),
    ...axisLabels(axis, width, bottom),
    text(left + width, bottom + 36, "plan, s", { anchor: "end", fill: INK.quiet, size: 11 }),
    ...(feet > 1 && kind.key !== "margin" ? feetKey(feet, bottom, footColour) : []),
  ];
  const tall = bottom + foot;
  return (
    `<svg xmlns="http://www.w3.org/2000/svg" width="${whole}" height="${tall}" `
    + `viewBox="0 0 ${whole} ${tall}" font-family="system-ui, sans-serif">`
    + `<title>${escaped(`${kind.name} of ${gait}`)}</title>`
    + `<rect width="100%" height="100%" fill="${SHEET}"/>${parts.join("")}</svg>`
  );
}

/** The picture as a PNG file. */
async function png(source) {
  const address = URL.createObjectURL(new Blob([source], { type: "image/svg+xml" }));
  try {
    const image = new Image();
    image.src = address;
    await image.decode();
    const canvas = h("canvas", {
      width: image.naturalWidth * PNG_SCALE,
      height: image.naturalHeight * PNG_SCALE,
    });
    canvas.getContext("2d").drawImage(image, 0, 0, canvas.width, canvas.height);
    return await new Promise((done) => {
      canvas.toBlob(done, "image/png");
    });
  } finally {
    URL.revokeObjectURL(address);
  }
}

const columnName = ({ unit }, { foot, motor }) =>
  [foot === null ? "value" : `foot ${foot + 1}`, motor === null ? "" : `motor ${motor + 1}`]
    .filter(Boolean)
    .join(" ") + `, ${unit}`;
const number = (value) =>
  (value ?? null) === null || !Number.isFinite(value) ? "" : String(Number(value.toFixed(6)));

/** Every value of the strip, a row per sample: planned values, then the simulated and the measured ones. */
export function plotCsv({ kind, content, plan, overs }) {
  const { series } = content;
  const lines = [
    ["curve", "plan_s", "robot_s", ...series.map((one) => columnName(kind, one))]
      .map((name) => (name.includes(",") ? `"${name}"` : name))
      .join(","),
  ];
  plan.times.forEach((time, index) =>
    lines.push(
      [
        "planned",
        number(time),
        number(robotSecondsAt(plan, time)),
        ...series.map(({ valueAt }) => number(valueAt(index))),
      ].join(","),
    ),
  );
  for (const { word, laps, aFoot } of overs) {
    const at = ({ foot, motor }) => (aFoot === MOTORS ? foot * MOTORS + motor : (foot ?? 0));
    for (const { times, rows } of laps) {
      times.forEach((time, index) =>
        lines.push([word, number(time), "", ...series.map((one) => number(rows[index][at(one)]))].join(",")),
      );
    }
  }
  return `${lines.join("\n")}\n`;
}

const FORMS = {
  SVG: (drawn) => new Blob([plotSvg(drawn)], { type: "image/svg+xml" }),
  PNG: (drawn) => png(plotSvg(drawn)),
  CSV: (drawn) => new Blob([plotCsv(drawn)], { type: "text/csv" }),
};

async function save(form, drawn) {
  const address = URL.createObjectURL(await FORMS[form](drawn));
  h("a", {
    href: address,
    download: `${drawn.gait} ${drawn.kind.name.toLowerCase()}.${form.toLowerCase()}`,
  }).click();
  // By then the download has begun.
  setTimeout(() => URL.revokeObjectURL(address), 1000);
}

/** Buttons that save a plot, one per format; `drawn()` gives what `plotSvg` and `plotCsv` take, or null. */
export function saveButtons(kind, drawn) {
  const help = {
    SVG: "Saves the plot as an SVG picture, for papers",
    PNG: "Saves the plot as a PNG picture, for slides",
    CSV: "Saves all values of the plot as a CSV file, one row per sample",
  };
  return h(
    "div",
    { class: "plot-save", role: "group", "aria-label": `Save ${kind.name}` },
    ...Object.keys(FORMS).map((form) =>
      h("button", {
        class: "link",
        text: form,
        "aria-label": `Save ${kind.name} as ${form}`,
        title: help[form],
        on: {
          click: () => {
            const now = drawn();
            if (now) save(form, now);
          },
        },
      }),
    ),
  );
}
