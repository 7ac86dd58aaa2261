/**
 * The camera over the scene: views by name, a distance from which the whole way is seen, and a floor that it stays above.
 * Places are m in the scene, whose z points up.
 */

import { cameraMessages } from "./viser_client.js";

/** Height that is looked at, m: the middle between soles and board. */
const MIDDLE = 0.034;
/** Of the camera, in radii of what is looked at, where nothing stands over the scene. */
const DISTANCE = 3.55;
/** What stands over the scene at its upper and lower edge takes as much of its height, px. */
const TAKEN = 64;
/** Width of the stage over its height below which the width decides how far away the camera stands. */
const NARROW = 1.1;
/** A robot that stands still reaches this far, m, and what is drawn around its nodes goes farther. */
const [LEAST_REACH, AROUND] = [0.053, 0.027];
/** The view counts as moved by hand from here on, as a share of its distance. */
const MOVED = 0.01;

const LEVEL = 0.06;
const around = (front, turn) => [Math.cos(((front + turn) * Math.PI) / 180), Math.sin(((front + turn) * Math.PI) / 180), LEVEL];

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
 * What is to be in view: the middle of the body's way over the plan, and how far from there the robot reaches.
 * @param {import("./viser_client.js").ViserClient} client
 * @param {{com: number[][], feet: number[][][]}|null} overlay of the plan
 * @param {string[]} nodes of the robot
 * @param {string} bodyName
 */
export function wayOf(client, overlay, nodes, bodyName) {
  const body = client.position(bodyName) ?? [0, 0, 0];
  const places = [...(overlay?.com ?? []), body];
  const ends = [0, 1].map((axis) => [Math.min(...places.map((at) => at[axis])), Math.max(...places.map((at) => at[axis]))]);
  const flat = (at, middle) => Math.hypot(at[0] - middle[0], at[1] - middle[1]);
  // In a scene that has just opened the nodes are not in their places yet; the plan knows where the feet stand.
  const reaches = [...nodes.map((name) => flat(client.position(name) ?? body, body)), ...(overlay?.feet[0] ?? []).map((at) => flat(at, overlay.com[0]))];
  return {
    middle: ends.map(([low, high]) => (low + high) / 2),
    radius: Math.max(LEAST_REACH, ...reaches) + AROUND + Math.hypot(...ends.map(([low, high]) => (high - low) / 2)),
  };
}

export class Camera {
  #client;
  #direction = DIRECTIONS.perspective();
  #fitted = null;
  #share = 1;

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
    if (!now) return;
    if (!this.#isMoved(now)) {
      this.#fit(way);
      return;
    }
    const before = this.#share;
    this.#share = this.#smallness();
    const farther = this.#share / before;
    const position = now.target.map((value, axis) => value + (now.position[axis] - value) * farther);
    if (Math.abs(farther - 1) > 1e-3) this.#client.push(cameraMessages(position, now.target));
  }

  #fit({ middle, radius }) {
    this.#share = this.#smallness();
    const target = [...middle, MIDDLE];
    const distance = (radius * DISTANCE * this.#share) / Math.hypot(...this.#direction);
    const position = target.map((value, axis) => value + distance * this.#direction[axis]);
    this.#fitted = { position, target };
    this.#client.push(cameraMessages(position, target));
  }

  #isMoved({ position, target }) {
    if (!this.#fitted) return false;
    const near = MOVED * apart(position, target);
    return apart(position, this.#fitted.position) > near || apart(target, this.#fitted.target) > near;
  }

  /** How much farther away the camera has to stand where the stage is low or narrow. */
  #smallness() {
    const { width, height } = this.#client.visibleSize;
    return width > 0 && height > 2 * TAKEN ? Math.max(height / (height - TAKEN), (NARROW * height) / width) : 1;
  }
}
