/** On the floor of the 3D scene: an arrow the way the robot walks with its step in words, and a bar of 10 mm. */

import { stepLength, stepTurn, worldStep } from "../document/step.js";
import { byId, h, setText, svg } from "../lib/dom.js";
import { fixed } from "../lib/format.js";
import { floorOf } from "../preview/overlay.js";
import { goalOf } from "../preview/goal.js";
import { shownDocument } from "../state/store.js";
import { drawnPlan, greyOf } from "../state/worked_plan.js";
import { firstFree, isFree } from "./apart.js";

/** The arrow, m: from the goal's ring to its tail, its length, the head's, and half their widths. */
const ARROW = { before: 0.012, length: 0.046, head: 0.02, shaft: 0.0036, wide: 0.0105 };
/** The arrow of a gait that turns on the spot, degrees: where it begins beside the front, and how far it goes round. */
const ARC = { start: 14, span: 34, pieces: 10 };
const BAR = 0.01;
/** From the middle of what stands on the floor to the bar, in its radii, and from the line of sight to the places it may have, degrees. */
const [BAR_OUT, BAR_ASIDE] = [1.3, [50, 65, 80, 100, 125, -60, -90]];
/** A lower stage has no room for the bar, px. */
const LEAST_HEIGHT = 260;
/** Seen flatter than this, the floor shows neither. */
const FLATTEST = 0.13;
const LEAST_STEP = 5e-5;
const LEAST_TURN = 0.05;
/** What the goal's handle and its knob take, px. */
const HANDLE = 26;
/** From the tip of the arrow, and from the bar down, to the middle of what is written there, px. */
const [BEYOND, BELOW] = [6, 18];

const radians = (degrees) => (degrees * Math.PI) / 180;
const pathOf = (points) => `${points.map(([x, y], index) => `${index ? "L" : "M"}${x.toFixed(1)} ${y.toFixed(1)}`).join("")}Z`;
/** A number without a decimal that says nothing. */
const short = (value) => fixed(value).replace(/\.0$/, "");

/** What the arrow says of a gait: "Walks 19 mm a step", "Turns 15° left a step", of a sequence "Walks 50 mm in all"; "" where it stays where it is. */
export function stepText(document, isGrey) {
  const [length, turn] = [stepLength(document), stepTurn(document)];
  const walks = length > LEAST_STEP ? `${short(length * 1000)} mm` : "";
  const turns = Math.abs(turn) > LEAST_TURN ? `${short(Math.abs(turn))}° ${turn > 0 ? "left" : "right"}` : "";
  if (!walks && !turns) return "";
  const each = document.sequence ? "in all" : "a step";
  if (isGrey) return `Goal: ${[walks, turns].filter(Boolean).join(", ")} ${each}`;
  return walks ? `Walks ${walks}${turns && `, turns ${turns}`} ${each}` : `Turns ${turns} ${each}`;
}

/** Corners [x, y] in m of the arrow that goes straight on from the goal, and which of them is its tip. */
function straight({ x, y, radius }, [dx, dy]) {
  const at = (along, aside) => [x + dx * (radius + ARROW.before + along) - dy * aside, y + dy * (radius + ARROW.before + along) + dx * aside];
  const neck = ARROW.length - ARROW.head;
  const [left, right] = [[at(0, ARROW.shaft), at(neck, ARROW.shaft), at(neck, ARROW.wide)], [at(neck, -ARROW.wide), at(neck, -ARROW.shaft), at(0, -ARROW.shaft)]];
  return { corners: [...left, at(ARROW.length, 0), ...right], tip: left.length };
}

/** Corners of the arrow that goes round the robot. */
function round({ x, y, radius, front }, turn) {
  const sign = Math.sign(turn);
  const at = (part, aside) => {
    const angle = radians(front + sign * (ARC.start + ARC.span * part));
    return [x + (radius + ARROW.before + aside) * Math.cos(angle), y + (radius + ARROW.before + aside) * Math.sin(angle)];
  };
  const neck = 1 - ARROW.head / (radians(ARC.span) * radius);
  const parts = Array.from({ length: ARC.pieces + 1 }, (_, piece) => (neck * piece) / ARC.pieces);
  const side = (aside) => [...parts.map((part) => at(part, aside * ARROW.shaft)), at(neck, aside * ARROW.wide)];
  return { corners: [...side(1), at(1, 0), ...side(-1).reverse()], tip: parts.length + 1 };
}

/** Both ends of the bar: so far aside before the robot, at the left or, below 0, at the right, along that axis of the floor that lies more level in the picture. */
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
   * @param {object} store
   * @param {import("../preview/preview.js").Preview} preview
   */
  constructor(layer, store, preview) {
    [this.#layer, this.#store, this.#preview] = [layer, store, preview];
    layer.append(svg("svg", { "aria-hidden": "true" }, this.#arrow, this.#bar), this.#words, this.#scale);
  }

  /** Whether the goal, its words or the plan's place is another one. */
  isChanged() {
    const { state } = this.#store;
    const document = shownDocument(state);
    const [plan, goalHidden] = [drawnPlan(state), byId("goal").hidden];
    const key = [this.#layer.hidden, document?.step, document?.direction, document?.orientation, document?.iterations, plan?.hash, greyOf(state), goalHidden].join();
    if (key === this.#key) return false;
    this.#key = key;
    return true;
  }

  draw(seen) {
    const { state } = this.#store;
    const document = shownDocument(state);
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
    const { corners, tip } = length > LEAST_STEP ? straight(goal, [dx / length, dy / length]) : round(goal, stepTurn(document));
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
    this.#put(seen, this.#words, [first, { x, y: y + away }, { x, y: y - away }, { x: x - size.width / 2, y: y + away }, { x: x - size.width / 2, y: y - away }]);
  }

  #drawBar(seen, goal) {
    const [[x, y], radius] = [[goal.x / 2, goal.y / 2], goal.radius + Math.hypot(goal.x, goal.y) / 2];
    this.#scale.hidden = false;
    const size = this.#sizeOf(this.#scale);
    const written = (ends) => ({ x: (ends[0][0] + ends[1][0]) / 2, y: Math.max(ends[0][1], ends[1][1]) + BELOW, ...size });
    const isClear = (ends) => ends && [boxOf(ends), written(ends)].every((box) => isFree(box, [...seen.standing, ...this.boxes], seen));
    const ends = seen.height < LEAST_HEIGHT ? undefined : BAR_ASIDE.map((aside) => this.#onStage(seen, barEnds(seen, { x, y, radius }, aside))).find(isClear);
    // Where nothing of the floor is free there is no room for a scale.
    this.#scale.hidden = !ends;
    this.#bar.setAttribute("d", ends ? barPath(ends) : "");
    if (!ends) return;
    this.#put(seen, this.#scale, [written(ends)]);
    this.boxes.push(boxOf(ends));
  }

  /** Puts what is written to the first of some places where it is free. */
  #put(seen, element, places) {
    const size = this.#sizeOf(element);
    const box = firstFree(places.map((at) => ({ ...at, ...size })), [...seen.standing, ...this.boxes], seen);
    element.style.transform = `translate(${Math.round(box.x - box.width / 2)}px, ${Math.round(box.y - box.height / 2)}px)`;
    this.boxes.push(box);
  }

  /** What the goal's handles cover. */
  #goalBoxes(seen, { x, y, heading, radius }) {
    const layer = byId("goal");
    if (layer.hidden || layer.hasAttribute("data-off")) return [];
    const [place, knob] = [[x, y], [x + radius * Math.cos(radians(heading)), y + radius * Math.sin(radians(heading))]].map((at) => this.#onStage(seen, [at])?.[0]);
    const square = (at) => at && { x: at[0], y: at[1], width: HANDLE, height: HANDLE };
    return [square(place), square(knob)].filter(Boolean);
  }

  #sizeOf(element) {
    const words = element.textContent;
    if (!this.#sizes.has(words)) this.#sizes.set(words, { width: element.offsetWidth, height: element.offsetHeight });
    return this.#sizes.get(words);
  }
}

/** The box round places on the stage. */
function boxOf(places) {
  const [[left, right], [top, bottom]] = [0, 1].map((axis) => places.map((at) => at[axis])).map((values) => [Math.min(...values), Math.max(...values)]);
  return { x: (left + right) / 2, y: (top + bottom) / 2, width: right - left, height: bottom - top };
}

/** The middle of a box that touches the tip of an arrow from beyond it. */
function beyond(tip, tail, { width, height }) {
  const [dx, dy] = [tip[0] - tail[0], tip[1] - tail[1]];
  const length = Math.hypot(dx, dy) || 1;
  const out = (Math.abs(dx) * width + Math.abs(dy) * height) / (2 * length) + BEYOND;
  return { x: tip[0] + (dx / length) * out, y: tip[1] + (dy / length) * out };
}

/** A line with a stroke across each end. */
function barPath([[ax, ay], [bx, by]]) {
  const length = Math.hypot(bx - ax, by - ay) || 1;
  const [nx, ny] = [(-(by - ay) / length) * 4, ((bx - ax) / length) * 4];
  const line = (x1, y1, x2, y2) => `M${x1.toFixed(1)} ${y1.toFixed(1)}L${x2.toFixed(1)} ${y2.toFixed(1)}`;
  return line(ax, ay, bx, by) + line(ax - nx, ay - ny, ax + nx, ay + ny) + line(bx - nx, by - ny, bx + nx, by + ny);
}
