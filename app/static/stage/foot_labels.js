/** Labels of the feet over the 3D scene: mark, number and place of each, and an arrow while it is lifted. */

import { byId, h, setText } from "../lib/dom.js";
import { sampleAt } from "../preview/overlay.js";
import { moveApart } from "./apart.js";

/** With more feet than this, labels show only mark and number. */
const MOST_PLACES = 4;
/** Where a label begins: distance outwards from the foot's middle, m, and share of the sole's depth. */
const [OUTWARDS, LOW] = [0.02, 0.5];
const BESIDE_PX = 3;
/** A measured foot above this height counts as lifted, m. */
const LIFTED = 0.001;
/** Labels move in steps of this size, so that the label of a standing foot does not move, px. */
const STEP_PX = 0.5;

/** Boxes of a pose's handle, relative to the body's place on the floor, px: its knob, and its label. */
const POSE = [
  { dx: 0, dy: 0, width: 24, height: 24 },
  { dx: 54, dy: 18, width: 88, height: 22 },
];

const UP = " ↑";

/**
 * Places on the stage of the foot and of a point beside it, away from the body; null if out of sight.
 * @param {Record<string, any>} seen
 * @param {number[]} foot place in the scene
 * @param {number[]} body
 * @param {number} floor its height
 */
function besideFoot(seen, [x, y, z], [bodyX, bodyY], floor) {
  const away = Math.hypot(x - bodyX, y - bodyY) || 1;
  const height = z + floor * LOW;
  const foot = seen.toStage([x, y, height]);
  const edge = seen.toStage([
    x + ((x - bodyX) / away) * OUTWARDS,
    y + ((y - bodyY) / away) * OUTWARDS,
    height,
  ]);
  return foot && edge ? { foot, edge } : null;
}

/** The label's box, given by its middle, px; it touches the point beside the foot. */
function boxAt({ foot, edge }, { width, height }) {
  const [dx, dy] = [edge[0] - foot[0], edge[1] - foot[1]];
  const length = Math.hypot(dx, dy) || 1;
  const reach = (Math.abs(dx) * width + Math.abs(dy) * height) / (2 * length) + BESIDE_PX;
  return { x: edge[0] + (dx / length) * reach, y: edge[1] + (dy / length) * reach, width, height };
}

/** Moves an element's middle to a place. */
function put(label, { x, y, width, height }) {
  const at = [x - width / 2, y - height / 2].map((value) => Math.round(value / STEP_PX) * STEP_PX);
  const transform = `translate(${at[0]}px, ${at[1]}px)`;
  if (transform !== label.transform) label.element.style.transform = label.transform = transform;
}

export class FootLabels {
  #layer;
  #preview;
  #labels = [];
  #sizes = new Map();
  #places = new Float64Array(0);
  #sample = -1;
  #overlay = null;
  #hasPose = false;
  #isNew = true;

  /**
   * @param {HTMLElement} layer
   * @param {import("../preview/preview.js").Preview} preview
   */
  constructor(layer, preview) {
    this.#layer = layer;
    this.#preview = preview;
  }

  /** Builds a label for each foot. */
  setRoles(roles) {
    const isMany = roles.length > MOST_PLACES;
    this.#labels = roles.map((role, foot) => {
      const text = h("span");
      const words = isMany || role === String(foot + 1) ? String(foot + 1) : `${foot + 1} ${role}`;
      const element = h(
        "div",
        { class: "foot-label", data: { foot: foot + 1 } },
        h("i", { class: "foot-dot" }),
        text,
      );
      return { words, text, node: `/robot/leg${foot + 1}_foot`, transform: "", element };
    });
    this.#layer.toggleAttribute("data-many", isMany);
    this.#layer.replaceChildren(...this.#labels.map(({ element }) => element));
    this.#places = new Float64Array(3 * roles.length);
    this.#sizes.clear();
    this.#isNew = true;
  }

  /** Whether a label may change: a foot moved, was lifted or set down, or the pose's handle came or went. */
  isChanged() {
    if (this.#layer.hidden) return false;
    const { overlay, time } = this.#preview;
    const sample = overlay ? sampleAt(overlay.times, time) : -1;
    const hasPose = !byId("pose").hidden && !byId("pose").hasAttribute("data-off");
    let isChanged =
      this.#isNew || sample !== this.#sample || overlay !== this.#overlay || hasPose !== this.#hasPose;
    [this.#sample, this.#overlay, this.#hasPose, this.#isNew] = [sample, overlay, hasPose, false];
    this.#labels.forEach(({ node }, foot) => {
      const at = this.#preview.client.position(node) ?? [NaN, NaN, NaN];
      at.forEach((value, axis) => {
        if (Object.is(value, this.#places[3 * foot + axis])) return;
        this.#places[3 * foot + axis] = value;
        isChanged = true;
      });
    });
    return isChanged;
  }

  draw(seen) {
    if (this.#layer.hidden) return;
    const body = this.#preview.client.position("/robot/body");
    const shown = [];
    this.#labels.forEach((label, foot) => {
      const at = [...this.#places.subarray(3 * foot, 3 * foot + 3)];
      const beside =
        body && this.#overlay && at.every(Number.isFinite)
          ? besideFoot(seen, at, body, this.#overlay.floor)
          : null;
      label.element.hidden = beside === null;
      if (!beside) return;
      setText(label.text, label.words + (this.#isLifted(foot) ? UP : ""));
      shown.push({ label, box: boxAt(beside, this.#sizeOf(label)) });
    });
    const pose =
      this.#hasPose && body && this.#overlay ? seen.toStage([body[0], body[1], this.#overlay.floor]) : null;
    const held = pose
      ? POSE.map(({ dx, dy, ...size }) => ({ x: pose[0] + dx, y: pose[1] + dy, ...size }))
      : [];
    moveApart(
      shown.map(({ box }) => box),
      [...seen.standing, ...seen.taken, ...held],
      seen,
    );
    for (const { label, box } of shown) put(label, box);
  }

  #isLifted(foot) {
    if (this.#preview.isMeasured) return this.#places[3 * foot + 2] > LIFTED;
    return this.#overlay.contact[this.#sample]?.[foot] === false;
  }

  /** Size of a label. Each text is measured only once, because reading a size forces a layout of the page. */
  #sizeOf({ element, text }) {
    const words = text.textContent;
    if (!this.#sizes.has(words))
      this.#sizes.set(words, { width: element.offsetWidth, height: element.offsetHeight });
    return this.#sizes.get(words);
  }
}
