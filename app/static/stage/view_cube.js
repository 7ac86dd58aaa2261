/** The cube at the stage's top right: it turns with the camera, and a click on a face looks from there. */

import { byId, h } from "../lib/dom.js";
import { shownDocument } from "../state/store.js";

/** Half an edge, px, and the middle of the cube in its box. */
const [HALF, MIDDLE] = [21, 38];
/** Faces seen flatter than this count as turned away. */
const TURNED_AWAY = 0.12;

/** Faces by the way out of them, in the robot's frame: x to its front, y to its left, z up. */
const FACES = [
  { view: "top", text: "Top", out: [0, 0, 1] },
  { view: "front", text: "Front", out: [1, 0, 0] },
  { view: "right", text: "Right", out: [0, -1, 0] },
  { view: "back", text: "Back", out: [-1, 0, 0] },
  { view: "left", text: "Left", out: [0, 1, 0] },
];
const CORNERS = [[1, 1, 1], [1, -1, 1], [-1, 1, 1], [-1, -1, 1]];
const UP = [0, 0, 1];
const MOVES = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 };

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

/** The way that the robot of a gait looks at its start, degrees. */
export const frontOf = (document) => (document?.orientation === "FB" ? 45 : 0) + 90 * ((document?.direction ?? 1) - 1);

/** Which way the words on a face run: level, or on the top as level as they can. */
function alongWords(out, right) {
  if (out[2] === 0) return cross(UP, out);
  const ways = [[1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0]];
  return ways.reduce((best, way) => (dot(way, right) > dot(best, right) ? way : best));
}

function placeFace({ out, button }, { right, up, back }) {
  const along = alongWords(out, right);
  const upwards = cross(out, along);
  const onScreen = (way) => [dot(right, way), -dot(up, way)];
  const [a, b, c] = [along, upwards, out].map(onScreen);
  const matrix = [a[0], a[1], -b[0], -b[1], MIDDLE + HALF * c[0], MIDDLE + HALF * c[1]];
  const facing = dot(back, out);
  button.toggleAttribute("data-away", facing < TURNED_AWAY);
  button.style.transform = `matrix(${matrix.map((value) => value.toFixed(3)).join()})`;
  button.style.setProperty("--facing", facing.toFixed(2));
}

/** Builds a group of buttons of which one is in the order of tabs; arrow keys go on from there. */
function roving(group, buttons) {
  const enter = (button) => buttons.forEach((other) => { other.tabIndex = other === button ? 0 : -1; });
  enter(buttons[0]);
  group.addEventListener("focusin", ({ target }) => enter(target));
  group.addEventListener("keydown", (event) => {
    const move = MOVES[event.key];
    if (!move) return;
    event.preventDefault();
    buttons[(buttons.indexOf(document.activeElement) + move + buttons.length) % buttons.length].focus({ preventScroll: true });
  });
}

export class ViewCube {
  #store;
  #front = null;
  #faces;
  #corner = h("button", { class: "cube-corner", "aria-label": "Perspective view", title: "Look from above at an angle" });

  /**
   * @param {object} store
   * @param {(view: string) => void} look
   */
  constructor(store, look) {
    this.#store = store;
    this.#faces = FACES.map((face) => ({
      ...face,
      button: h("button", { class: "cube-face", "aria-label": `${face.text} view`, title: face.view === "top" ? "Look from above" : `Look at the robot's ${face.view}`, data: { view: face.view }, text: face.text }),
    }));
    this.#faces.forEach(({ view, button }) => button.addEventListener("click", () => look(view)));
    this.#corner.addEventListener("click", () => look("perspective"));
    const buttons = [...this.#faces.map(({ button }) => button), this.#corner];
    byId("view-cube").replaceChildren(...buttons);
    roving(byId("view-cube"), buttons);
  }

  /** Whether the robot looks another way. */
  isChanged() {
    const front = frontOf(shownDocument(this.#store.state));
    if (front === this.#front) return false;
    this.#front = front;
    return true;
  }

  draw({ right, up, back }) {
    const [cosine, sine] = [Math.cos((this.#front * Math.PI) / 180), Math.sin((this.#front * Math.PI) / 180)];
    const inRobot = ([x, y, z]) => [cosine * x + sine * y, cosine * y - sine * x, z];
    const axes = { right: inRobot(right), up: inRobot(up), back: inRobot(back) };
    for (const face of this.#faces) placeFace(face, axes);
    const nearest = CORNERS.reduce((best, corner) => (dot(corner, axes.back) > dot(best, axes.back) ? corner : best));
    const at = [dot(axes.right, nearest), -dot(axes.up, nearest)].map((value) => MIDDLE + HALF * value);
    this.#corner.style.transform = `translate(${at[0].toFixed(1)}px, ${at[1].toFixed(1)}px)`;
  }
}
