/**
 * The camera over the scene: views by name, a distance from which the whole way is seen, and a floor that it
 * stays above. Places are m in the scene, whose z points up.
 */

import { cameraMessages } from "./viser_client.js";

/** Height that is looked at, m: the middle between floor and board. */
const MIDDLE = 0.048;
/** From the floor to the robot's board, m, and the floor under the robot's middle. */
const [TOP, FLOOR] = [0.128, -0.018];
/** Half the field of view upwards (app/scene/environment.py), as a slope. */
const SLOPE = Math.tan((16 * Math.PI) / 180);
/** What stands over the scene, px: above and below, and labels beside the robot; at most this share of it. */
const [TAKEN, ASIDE, MOST_TAKEN] = [32, 76, 0.55];
/** Corners of the circle that the robot fills. */
const CORNERS = 12;
/** A robot that stands still reaches this far, m, and what is drawn around its nodes goes farther. */
const [LEAST_REACH, AROUND] = [0.053, 0.027];
/** The view counts as moved by hand from here on, as a share of its distance. */
const MOVED = 0.01;

const LEVEL = 0.06;
const around = (front, turn) => [
  Math.cos(((front + turn) * Math.PI) / 180),
  Math.sin(((front + turn) * Math.PI) / 180),
  LEVEL,
];

/** From the robot to the camera, by the name of the view and the way that the robot looks, degrees. */
const DIRECTIONS = {
  perspective: () => [0.363, -0.865, 0.346],
  top: () => [0, -0.02, 1],
  front: (front) => around(front, 0),
  left: (front) => around(front, 90),
  back: (front) => around(front, 180),
  right: (front) => around(front, -90),
};

const apart = (a, b) => Math.hypot(...a.map((value, axis) => value - b[axis]));

/**
 * What is to be in view: the middle of the body's way over the plan, and how far from it the robot reaches.
 * @param {import("./viser_client.js").ViserClient} client
 * @param {{com: number[][], feet: number[][][]}|null} overlay of the plan
 * @param {string[]} nodes of the robot
 * @param {string} bodyName
 */
export function wayOf(client, overlay, nodes, bodyName) {
  const body = client.position(bodyName) ?? [0, 0, 0];
  const places = [...(overlay?.com ?? []), body];
  const ends = [0, 1].map((axis) => [
    Math.min(...places.map((at) => at[axis])),
    Math.max(...places.map((at) => at[axis])),
  ]);
  const flat = (at, middle) => Math.hypot(at[0] - middle[0], at[1] - middle[1]);
  // In a scene that has just opened the nodes are not in their places yet; the plan knows those of the feet.
  const feet = (overlay?.feet[0] ?? []).map((at) => flat(at, overlay.com[0]));
  const reaches = [...nodes.map((name) => flat(client.position(name) ?? body, body)), ...feet];
  return {
    middle: ends.map(([low, high]) => (low + high) / 2),
    radius:
      Math.max(LEAST_REACH, ...reaches) + AROUND + Math.hypot(...ends.map(([low, high]) => (high - low) / 2)),
  };
}

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (a) => a.map((value) => value / Math.hypot(...a));

/** The least distance from which all in a circle, from floor to top, is seen in the free part of a stage. */
function distanceFor(direction, radius, { width, height }) {
  const back = unit(direction);
  const right = unit(cross([0, 0, 1], back));
  const up = cross(back, right);
  const free = (taken, size) => 1 - Math.min((2 * taken) / size, MOST_TAKEN);
  const [across, along] = [(SLOPE * free(ASIDE, width) * width) / height, SLOPE * free(TAKEN, height)];
  const needed = (at) =>
    dot(at, back) + Math.max(Math.abs(dot(at, right)) / across, Math.abs(dot(at, up)) / along);
  const angles = Array.from({ length: CORNERS }, (_, corner) => (2 * Math.PI * corner) / CORNERS);
  const rim = angles.map((angle) => [radius * Math.cos(angle), radius * Math.sin(angle)]);
  return Math.max(...rim.flatMap((at) => [FLOOR, TOP].map((z) => needed([...at, z - MIDDLE]))));
}

export class Camera {
  #client;
  #direction = DIRECTIONS.perspective();
  #fitted = null;
  #size = null;

  /** @param {import("./viser_client.js").ViserClient} client */
  constructor(client) {
    this.#client = client;
  }

  /**
   * Looks at a way by the name of a view.
   * @param {string} name of the view
   * @param {number} front the way that the robot looks, degrees
   * @param {{middle: number[], radius: number}} way
   */
  view(name, front, way) {
    this.#direction = (DIRECTIONS[name] ?? DIRECTIONS.perspective)(front);
    this.#fit(way);
  }

  /** After another size of the stage: fits the view again; one that was moved by hand keeps what it shows. */
  refit(way) {
    const now = this.#client.cameraPose();
    const [before, size] = [this.#size, this.#client.visibleSize];
    if (!now || !(size.height > 0)) return;
    if (!before || !this.#isMoved(now)) {
      this.#fit(way);
      return;
    }
    this.#size = size;
    const [from, to] = [before, size].map((one) => distanceFor(this.#direction, way.radius, one));
    const position = now.target.map((value, axis) => value + ((now.position[axis] - value) * to) / from);
    this.#client.push(cameraMessages(position, now.target));
  }

  #fit({ middle, radius }) {
    this.#size = this.#client.visibleSize;
    if (!(this.#size.height > 0)) return;
    const target = [...middle, MIDDLE];
    const distance = distanceFor(this.#direction, radius, this.#size);
    const back = unit(this.#direction);
    const position = target.map((value, axis) => value + distance * back[axis]);
    this.#fitted = { position, target };
    this.#client.push(cameraMessages(position, target));
  }

  #isMoved({ position, target }) {
    if (!this.#fitted) return false;
    const near = MOVED * apart(position, target);
    return apart(position, this.#fitted.position) > near || apart(target, this.#fitted.target) > near;
  }
}
