/** Guides on the floor of the 3D scene: an arrow that tells way and length of a step, and a bar of 10 mm. */

import { stepLength, stepTurn, worldStep } from "../document/step.js";
import { byId, h, setText, svg } from "../lib/dom.js";
import { fixed } from "../lib/format.js";
import { floorOf } from "../preview/overlay.js";
import { goalOf } from "../preview/goal.js";
import { previewedDocument } from "../state/store.js";
import { drawnPlan, greyOf } from "../state/worked_plan.js";
import { firstFree, isFree } from "./apart.js";

/** The arrow, m: gap to the goal's ring, length, length of the head, half widths of shaft and head. */
const ARROW = { before: 0.012, length: 0.046, head: 0.02, shaft: 0.0036, wide: 0.0105 };
/** The arrow of a gait that turns on the spot: start beside the robot's front and span, degrees. */
const ARC = { start: 14, span: 34, pieces: 10 };
const BAR = 0.01;
/**
 * Places of the bar around the circle that encloses robot and goal: distance from its middle in radii, and
 * angles to the line of sight in the order in which they are tried, degrees.
 */
const [BAR_OUT, BAR_ASIDE] = [1.3, [50, 65, 80, 100, 125, -60, -90]];
/** Below this height the stage has no room for the bar, px. */
const LEAST_HEIGHT = 260;
/** If the camera's axis has a smaller vertical part, the floor looks too flat for arrow and bar. */
const FLATTEST = 0.13;
const LEAST_STEP = 5e-5;
const LEAST_TURN = 0.05;
/** Size of the goal's handle and of its knob, px. */
const HANDLE = 26;
/** Gap between the arrow and its text, and distance of the scale's text below the bar, px. */
const [BEYOND, BELOW] = [6, 18];

const radians = (degrees) => (degrees * Math.PI) / 180;
const pathOf = (points) =>
  `${points.map(([x, y], index) => `${index ? "L" : "M"}${x.toFixed(1)} ${y.toFixed(1)}`).join("")}Z`;
/** A number as text, without a trailing “.0”. */
const short = (value) => fixed(value).replace(/\.0$/, "");

/**
 * The arrow's text: "Walks 19 mm a step", "Turns 15° left a step", for a sequence "Walks 50 mm in all"; ""
 * for a gait that neither walks nor turns.
 */
export function stepText(document, isGrey) {
  const [length, turn] = [stepLength(document), stepTurn(document)];
  const walks = length > LEAST_STEP ? `${short(length * 1000)} mm` : "";
  const turns = Math.abs(turn) > LEAST_TURN ? `${short(Math.abs(turn))}° ${turn > 0 ? "left" : "right"}` : "";
  if (!walks && !turns) return "";
  const each = document.sequence ? "in all" : "a step";
  if (isGrey) return `Goal: ${[walks, turns].filter(Boolean).join(", ")} ${each}`;
  return walks ? `Walks ${walks}${turns && `, turns ${turns}`} ${each}` : `Turns ${turns} ${each}`;
}

/** Corners [x, y] of the arrow straight on from the goal, m, and the index of its tip. */
function straight({ x, y, radius }, [dx, dy]) {
  const at = (along, aside) => {
    const ahead = radius + ARROW.before + along;
    return [x + dx * ahead - dy * aside, y + dy * ahead + dx * aside];
  };
  const neck = ARROW.length - ARROW.head;
  const left = [at(0, ARROW.shaft), at(neck, ARROW.shaft), at(neck, ARROW.wide)];
  const right = [at(neck, -ARROW.wide), at(neck, -ARROW.shaft), at(0, -ARROW.shaft)];
  return { corners: [...left, at(ARROW.length, 0), ...right], tip: left.length };
}

/** Corners of the arrow round the robot, m, and the index of its tip. */
function round({ x, y, radius, front }, turn) {
  const sign = Math.sign(turn);
  const at = (part, aside) => {
    const angle = radians(front + sign * (ARC.start + ARC.span * part));
    return [
      x + (radius + ARROW.before + aside) * Math.cos(angle),
      y + (radius + ARROW.before + aside) * Math.sin(angle),
    ];
  };
  const neck = 1 - ARROW.head / (radians(ARC.span) * radius);
  const parts = Array.from({ length: ARC.pieces + 1 }, (_, piece) => (neck * piece) / ARC.pieces);
  const side = (aside) => [
    ...parts.map((part) => at(part, aside * ARROW.shaft)),
    at(neck, aside * ARROW.wide),
  ];
  return { corners: [...side(1), at(1, 0), ...side(-1).reverse()], tip: parts.length + 1 };
}

/**
 * Both ends of the bar, m. Its middle lies `aside` degrees to the left of the line of sight, to the right if
 * negative. It is parallel to the axis of the floor that looks more level in the picture.
 */
function barEnds({ right, back }, { x, y, radius }, aside) {
  const angle = Math.atan2(back[1], back[0]) - radians(aside);
  const out = BAR_OUT * radius;
  const axis = Math.abs(right[0]) >= Math.abs(right[1]) ? [Math.sign(right[0]), 0] : [0, Math.sign(right[1])];
  const middle = [x + out * Math.cos(angle), y + out * Math.sin(angle)];
  return [-0.5, 0.5].map((part) => middle.map((value, index) => value + part * BAR * axis[index]));
}

export class FloorGuides {
  #store;
  #preview;
  #layer;
  #arrow = svg("path", { class: "walk-arrow" });
  #bar = svg("path", { class: "scale-bar" });
  #words = h("div", { class: "guide-text walk-text" });
  #scale = h("div", { class: "guide-text scale-text", text: "10 mm" });
  #key = null;
  #sizes = new Map();
  boxes = [];

  /**
   * @param {HTMLElement} layer
   * @param {import("../state/store.js").Store} store
   * @param {import("../preview/preview.js").Preview} preview
   */
  constructor(layer, store, preview) {
    [this.#layer, this.#store, this.#preview] = [layer, store, preview];
    layer.append(svg("svg", { "aria-hidden": "true" }, this.#arrow, this.#bar), this.#words, this.#scale);
  }

  /** Whether anything that the guides show has changed. */
  isChanged() {
    const { state } = this.#store;
    const document = previewedDocument(state);
    const [plan, goalHidden] = [drawnPlan(state), byId("goal").hidden];
    const key = [
      this.#layer.hidden,
      document?.step,
      document?.direction,
      document?.orientation,
      document?.iterations,
      plan?.hash,
      greyOf(state),
      goalHidden,
    ].join();
    if (key === this.#key) return false;
    this.#key = key;
    return true;
  }

  draw(seen) {
    const { state } = this.#store;
    const document = previewedDocument(state);
    const isFlat = seen.back[2] < FLATTEST;
    const goal = document && goalOf(document, drawnPlan(state));
    this.boxes = [];
    const isOff = this.#layer.hidden || isFlat || !goal;
    this.#layer.toggleAttribute("data-off", isOff);
    if (!isFlat && goal) this.boxes.push(...this.#goalBoxes(seen, goal));
    if (isOff) return;
    this.#drawArrow(seen, goal, document, greyOf(state) !== null);
    this.#drawBar(seen, goal);
  }

  #onStage(seen, points) {
    const height = floorOf(this.#preview.overlay);
    const places = points.map(([x, y]) => seen.toStage([x, y, height]));
    return places.includes(null) ? null : places;
  }

  #drawArrow(seen, goal, document, isGrey) {
    const [dx, dy] = worldStep(document);
    const length = Math.hypot(dx, dy);
    const text = stepText(document, isGrey);
    const { corners, tip } =
      length > LEAST_STEP ? straight(goal, [dx / length, dy / length]) : round(goal, stepTurn(document));
    const places = text ? this.#onStage(seen, corners) : null;
    this.#arrow.setAttribute("d", places ? pathOf(places) : "");
    this.#layer.toggleAttribute("data-grey", isGrey);
    setText(this.#words, places ? text : "");
    this.#words.hidden = !places;
    if (!places) return;
    this.boxes.push(boxOf(places));
    const neck = places[tip - 1].map((value, axis) => (value + places[tip + 1][axis]) / 2);
    const size = this.#sizeOf(this.#words);
    const [first, { x, y, height }] = [beyond(places[tip], neck, size), this.boxes.at(-1)];
    const away = (height + size.height) / 2 + BEYOND;
    const [below, above, left] = [y + away, y - away, x - size.width / 2];
    const others = [
      { x, y: below },
      { x, y: above },
      { x: left, y: below },
      { x: left, y: above },
    ];
    this.#put(seen, this.#words, [first, ...others]);
  }

  #drawBar(seen, goal) {
    const [[x, y], radius] = [[goal.x / 2, goal.y / 2], goal.radius + Math.hypot(goal.x, goal.y) / 2];
    this.#scale.hidden = false;
    const size = this.#sizeOf(this.#scale);
    const written = (ends) => ({
      x: (ends[0][0] + ends[1][0]) / 2,
      y: Math.max(ends[0][1], ends[1][1]) + BELOW,
      ...size,
    });
    const taken = [...seen.standing, ...this.boxes];
    const isClear = (ends) => ends && [boxOf(ends), written(ends)].every((box) => isFree(box, taken, seen));
    const endsAt = (aside) => this.#onStage(seen, barEnds(seen, { x, y, radius }, aside));
    const ends = seen.height < LEAST_HEIGHT ? undefined : BAR_ASIDE.map(endsAt).find(isClear);
    // Without a free place on the floor there is no scale.
    this.#scale.hidden = !ends;
    this.#bar.setAttribute("d", ends ? barPath(ends) : "");
    if (!ends) return;
    this.#put(seen, this.#scale, [written(ends)]);
    this.boxes.push(boxOf(ends));
  }

  /** Puts a text at the first of some places that is free. */
  #put(seen, element, places) {
    const size = this.#sizeOf(element);
    const box = firstFree(
      places.map((at) => ({ ...at, ...size })),
      [...seen.standing, ...this.boxes],
      seen,
    );
    const [left, top] = [box.x - box.width / 2, box.y - box.height / 2].map(Math.round);
    element.style.transform = `translate(${left}px, ${top}px)`;
    this.boxes.push(box);
  }

  /** Boxes of the goal's handles on the stage. */
  #goalBoxes(seen, { x, y, heading, radius }) {
    const layer = byId("goal");
    if (layer.hidden || layer.hasAttribute("data-off")) return [];
    const angle = radians(heading);
    const onFloor = [
      [x, y],
      [x + radius * Math.cos(angle), y + radius * Math.sin(angle)],
    ];
    const [place, knob] = onFloor.map((at) => this.#onStage(seen, [at])?.[0]);
    const square = (at) => at && { x: at[0], y: at[1], width: HANDLE, height: HANDLE };
    return [square(place), square(knob)].filter(Boolean);
  }

  #sizeOf(element) {
    const words = element.textContent;
    if (!this.#sizes.has(words))
      this.#sizes.set(words, { width: element.offsetWidth, height: element.offsetHeight });
    return this.#sizes.get(words);
  }
}

/** The smallest box around places on the stage. */
function boxOf(places) {
  const [xs, ys] = [0, 1].map((axis) => places.map((at) => at[axis]));
  const [left, right, top, bottom] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
  return { x: (left + right) / 2, y: (top + bottom) / 2, width: right - left, height: bottom - top };
}

/** The middle of a text's box just beyond the tip of an arrow. */
function beyond(tip, tail, { width, height }) {
  const [dx, dy] = [tip[0] - tail[0], tip[1] - tail[1]];
  const length = Math.hypot(dx, dy) || 1;
  const out = (Math.abs(dx) * width + Math.abs(dy) * height) / (2 * length) + BEYOND;
  return { x: tip[0] + (dx / length) * out, y: tip[1] + (dy / length) * out };
}

/** A line with a short stroke across each end. */
function barPath([[ax, ay], [bx, by]]) {
  const length = Math.hypot(bx - ax, by - ay) || 1;
  const [nx, ny] = [(-(by - ay) / length) * 4, ((bx - ax) / length) * 4];
  const line = (x1, y1, x2, y2) => `M${x1.toFixed(1)} ${y1.toFixed(1)}L${x2.toFixed(1)} ${y2.toFixed(1)}`;
  return (
    line(ax, ay, bx, by) + line(ax - nx, ay - ny, ax + nx, ay + ny) + line(bx - nx, by - ny, bx + nx, by + ny)
  );
}
