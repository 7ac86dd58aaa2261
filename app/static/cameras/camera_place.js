/** Locates the platform: click points of known place; a grid over the picture shows how well they fit. */

import { h, setText, svg } from "../lib/dom.js";
import { fixed } from "../lib/format.js";
import { columnHeads } from "../lib/tables.js";
import { picturePoints } from "../pictures/picture_points.js";

const MOST_POINTS = 200;
const SQUARE = [
  [-5, -5],
  [5, -5],
  [5, 5],
  [-5, 5],
];
const ROUGH_MM = 1;
const HELP =
  "Click points on the platform whose x and y you know. From these points the studio computes "
  + "where the platform is in the picture. A magnifier helps you to aim. "
  + "The arrow keys move the selected point by one pixel.";

const PRESETS = {
  square: {
    text: "10 cm square, centred",
    places: SQUARE,
    help:
      "Click the four corners of a 10 cm square around the platform's centre. "
      + "Each corner is 5 cm from the centre along x and along y",
  },
  corner: {
    text: "10 cm square, corner",
    places: SQUARE.map(([x, y]) => [x + 5, y + 5]),
    help: "Click the four corners of a 10 cm square. The first corner is the origin, x = 0 and y = 0",
  },
  grid: {
    text: "etched 1 cm grid",
    places: null,
    help:
      "Click crossings of grid lines and type their x and y. "
      + "From the fifth point on, the studio proposes x and y",
  },
};

const written = ([x, y]) => `x ${fixed(x, 1)}, y ${fixed(y, 1)} cm`;

const presetChoice = () =>
  h(
    "select",
    { "aria-label": "Points are" },
    ...Object.entries(PRESETS).map(([value, { text, help }]) => h("option", { value, text, title: help })),
  );

/** The place that the next clicked point is likely to have. */
function proposal(preset, points, pixel) {
  const { places } = PRESETS[preset];
  if (places && points.length < places.length) return places[points.length];
  const guess = pixel && guessPlace(points, pixel);
  if (guess) return guess.map((value) => Math.round(value));
  return SQUARE[points.length % SQUARE.length];
}

function asking(preset, points) {
  const { places } = PRESETS[preset];
  if (places && points.length < places.length)
    return `Click the corner at ${written(places[points.length])}.`;
  if (points.length < 4)
    return (
      "Click a crossing of grid lines, then type its x and y into the table. "
      + `Points still needed: ${4 - points.length}.`
    );
  return "To make the fit more exact, click more points whose x and y you know.";
}

function drawGrid(drawing, { setup, answer }) {
  const polyline = (className, line) =>
    svg("polyline", { class: className, points: line.map((place) => place.join(",")).join(" ") });
  const view = answer.view;
  const lines = view?.grid
    ? view.grid.map(({ at_cm: at, line }) => polyline(at === 0 ? "camera-axis" : "camera-grid", line))
    : view
      ? [polyline("camera-axis", [...view.outline, view.outline[0]])]
      : [];
  const off = (view?.seen ?? [])
    .map((seen, index) => setup.points[index] && polyline("camera-off", [setup.points[index].pixel, seen]))
    .filter(Boolean);
  drawing.replaceChildren(...lines, ...off);
}

/** Names the ends of the axes, so that it is seen which way x and y go. */
function axisNames(picture) {
  const names = ["x", "y"].map((axis) => ({
    axis,
    place: null,
    element: h("span", { class: "camera-axis-name", text: `+${axis}`, hidden: true }),
  }));
  picture.layer.append(...names.map(({ element }) => element));
  const put = () =>
    names.forEach(({ element, place }) => {
      element.hidden = !place;
      if (!place) return;
      const [x, y] = picture.toScreen(place);
      element.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
    });
  picture.onView(put);
  return (grid) => {
    // The line y = 0 runs along x.
    for (const name of names)
      name.place = grid?.find((one) => one.axis !== name.axis && one.at_cm === 0)?.line.at(-1) ?? null;
    put();
  };
}

function fitText({ view }, count) {
  if (!view)
    return count < 4
      ? ""
      : "The studio cannot compute the place of the platform from these points. Move one of the points.";
  const scale = `One pixel shows ${fixed(view.mm_per_pixel, 2)} mm of the platform.`;
  const fourth = "Four points always fit exactly. To see the error of the fit, click a fifth point.";
  if (count === 4) return `${fourth} ${scale}`;
  return `The largest error of a point is ${fixed(view.worst_mm, 2)} mm. ${scale}`;
}

/** A point's row; it is kept while the figures in it change. */
function pointRow(index, { change, remove, choose }) {
  const inputs = ["x", "y"].map((axis, at) => {
    const input = h("input", {
      type: "number",
      step: "any",
      min: "-500",
      max: "500",
      required: true,
      "aria-label": `Point ${index + 1}, ${axis}, cm`,
    });
    input.addEventListener("change", () => {
      if (input.checkValidity()) change(index, at, input.valueAsNumber);
    });
    input.addEventListener("focus", () => choose(index));
    return input;
  });
  const off = h("td", { class: "number" });
  const out = h("button", {
    type: "button",
    class: "link",
    text: "Remove",
    "aria-label": `Remove point ${index + 1}`,
    on: { click: () => remove(index) },
  });
  const element = h(
    "tr",
    {},
    h("th", { scope: "row", text: String(index + 1) }),
    ...inputs.map((input) => h("td", {}, input)),
    off,
    h("td", {}, out),
  );
  return {
    element,
    inputs,
    show(place, error) {
      inputs.forEach((input, at) => {
        if (input !== document.activeElement || input.validity.valid) input.value = String(place[at]);
      });
      setText(off, error === undefined ? "–" : fixed(error, 2));
      off.toggleAttribute("data-rough", error > ROUGH_MM);
    },
  };
}

/** The points as a table with editable places. */
function pointTable(actions) {
  const body = h("tbody");
  const element = h(
    "table",
    { class: "run-table camera-points", hidden: true },
    h("caption", { text: "Points" }),
    h("thead", {}, h("tr", {}, ...columnHeads(["", "x, cm", "y, cm", "off, mm", ""]))),
    body,
  );
  const rows = [];

  return {
    element,
    show(points, offs) {
      element.hidden = points.length === 0;
      while (rows.length > points.length) rows.pop().element.remove();
      points.forEach(({ place_cm: place }, index) => {
        if (!rows[index]) body.append((rows[index] = pointRow(index, actions)).element);
        rows[index].show(place, offs?.[index]);
      });
    },
    focus: (index) => rows[index]?.inputs[0].select(),
    mark: (index) => rows.forEach(({ element: one }, at) => one.toggleAttribute("data-shown", at === index)),
  };
}

const rounded = (pixel) => pixel.map((value) => Number(value.toFixed(2)));

/** The draft's points, and what can be done to them. */
function draftPoints(draft, picture) {
  const all = () => draft.state.setup.points;
  function put(points, last = true) {
    const size = [picture.size.width, picture.size.height];
    draft.change({ points, ...(points.length ? { size } : {}) }, last);
    if (!last) draft.check();
  }
  const replace = (index, patch, last = true) =>
    put(
      all().map((one, at) => (at === index ? { ...one, ...patch } : one)),
      last,
    );
  return {
    all,
    add: (pixel, place) => put([...all(), { pixel: rounded(pixel), place_cm: place }]),
    move: (index, pixel, last) => replace(index, { pixel: rounded(pixel) }, last),
    place: (index, axis, value) =>
      replace(index, { place_cm: all()[index].place_cm.map((one, at) => (at === axis ? value : one)) }),
    remove: (index) => put(all().filter((_, at) => at !== index)),
    clear: () => draft.change({ points: [] }),
  };
}

const clearButton = (points) =>
  h("button", { type: "button", class: "link", text: "Remove all points", on: { click: points.clear } });

/**
 * Builds the part.
 * @param {Record<string, any>} draft of `setupDraft`
 * @param {Record<string, any>} stage of `openStage`
 * @returns {{element: HTMLElement, enter: () => void, leave: () => void}}
 */
export function placePart(draft, stage) {
  const points = draftPoints(draft, stage.picture);
  const preset = presetChoice();
  const ask = h("p", { class: "camera-ask", role: "status" });
  const fit = h("p", { class: "quiet", role: "status" });
  const clear = clearButton(points);
  const showAxes = axisNames(stage.picture);
  let isOn = false;

  const table = pointTable({
    change: points.place,
    remove: points.remove,
    choose: (index) => table.mark(index),
  });
  const marks = picturePoints(stage.picture, {
    add(pixel) {
      if (points.all().length >= MOST_POINTS) return;
      points.add(pixel, proposal(preset.value, points.all(), pixel));
      if (preset.value === "grid") queueMicrotask(() => table.focus(points.all().length - 1));
    },
    move: points.move,
    remove: points.remove,
    chosen: (index) => table.mark(index),
  });

  function show({ setup, answer }) {
    if (!isOn) return;
    marks.show(setup.points.map(({ pixel }) => pixel));
    table.show(setup.points, answer.view?.off_mm);
    drawGrid(stage.picture.drawing, draft.state);
    showAxes(answer.view?.grid);
    setText(ask, asking(preset.value, setup.points));
    setText(fit, fitText(answer, setup.points.length));
    clear.hidden = setup.points.length === 0;
  }

  preset.addEventListener("change", () => show(draft.state));
  draft.watch(({ setup, answer }) => [setup, answer], show);
  return {
    element: h(
      "div",
      { class: "camera-part" },
      h("p", { class: "quiet", text: HELP }),
      h("label", {}, h("span", { text: "Points are" }), preset),
      ask,
      table.element,
      fit,
      clear,
    ),
    enter() {
      isOn = true;
      marks.allow(true);
      show(draft.state);
    },
    leave() {
      isOn = false;
      marks.allow(false);
      marks.show([]);
      showAxes(null);
      stage.picture.drawing.replaceChildren();
    },
  };
}

const UNKNOWNS = 8;
const LEAST_POINTS = 4;
const SINGULAR = 1e-12;

/** Solves A x = b by elimination with pivots; null if A is singular. */
function solved(matrix, right) {
  const rows = matrix.map((row, index) => [...row, right[index]]);
  const size = rows.length;
  for (let column = 0; column < size; column += 1) {
    const pivot = rows
      .slice(column)
      .reduce(
        (best, row, index) => (Math.abs(row[column]) > Math.abs(rows[best][column]) ? index + column : best),
        column,
      );
    [rows[column], rows[pivot]] = [rows[pivot], rows[column]];
    if (Math.abs(rows[column][column]) < SINGULAR) return null;
    for (let other = 0; other < size; other += 1) {
      if (other === column) continue;
      const factor = rows[other][column] / rows[column][column];
      rows[other] = rows[other].map((value, index) => value - factor * rows[column][index]);
    }
  }
  return rows.map((row, index) => row[size] / row[index]);
}

/** Two equations a point for the homography's eight numbers: x (g u + h v + 1) = a u + b v + c, and for y. */
function equations(points, scale) {
  return points.flatMap(({ pixel, place_cm: [x, y] }) => {
    const [u, v] = pixel.map((value) => value / scale);
    return [
      { row: [u, v, 1, 0, 0, 0, -x * u, -x * v], value: x },
      { row: [0, 0, 0, u, v, 1, -y * u, -y * v], value: y },
    ];
  });
}

/**
 * The place of a pixel by least squares over the points.
 * @param {{pixel: number[], place_cm: number[]}[]} points
 * @param {number[]} pixel
 * @returns {number[]|null} cm; null where fewer than four points, or points on a line, tell nothing
 */
export function guessPlace(points, pixel) {
  if (points.length < LEAST_POINTS) return null;
  const scale = Math.max(...points.flatMap((one) => one.pixel.map(Math.abs)), 1);
  const all = equations(points, scale);
  const indices = Array.from({ length: UNKNOWNS }, (_, index) => index);
  const normal = indices.map((i) =>
    indices.map((j) => all.reduce((sum, { row }) => sum + row[i] * row[j], 0)),
  );
  const view = solved(
    normal,
    indices.map((i) => all.reduce((sum, { row, value }) => sum + row[i] * value, 0)),
  );
  if (!view) return null;
  const [a, b, c, d, e, f, g, k] = view;
  const [u, v] = pixel.map((value) => value / scale);
  const depth = g * u + k * v + 1;
  return [(a * u + b * v + c) / depth, (d * u + e * v + f) / depth];
}
