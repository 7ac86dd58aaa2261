/** The cube at the top right of the stage: it turns with the camera; a click on a face selects that view. */

import { byId, h } from "../lib/dom.js";
import { shownDocument } from "../state/store.js";

/** Half an edge, and the middle of the cube in its box, px. */
const [HALF, MIDDLE] = [21, 38];
/** Faces whose normal has a smaller cosine to the camera's axis count as turned away. */
const TURNED_AWAY = 0.12;

/** Faces with their outward normals in the robot's frame: x to its front, y to its left, z up. */
const FACES = [
  { view: "top", text: "Top", out: [0, 0, 1] },
  { view: "front", text: "Front", out: [1, 0, 0] },
  { view: "right", text: "Right", out: [0, -1, 0] },
  { view: "back", text: "Back", out: [-1, 0, 0] },
  { view: "left", text: "Left", out: [0, 1, 0] },
];
const CORNERS = [
  [1, 1, 1],
  [1, -1, 1],
  [-1, 1, 1],
  [-1, -1, 1],
];
const UP = [0, 0, 1];
const MOVES = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 };

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

/** Direction in which the robot of a gait faces at the start, degrees. */
export const frontOf = (document) =>
  (document?.orientation === "FB" ? 45 : 0) + 90 * ((document?.direction ?? 1) - 1);

/** Direction of the text on a face: level; on the top face, the axis nearest to the camera's right. */
function alongWords(out, right) {
  if (out[2] === 0) return cross(UP, out);
  const ways = [
    [1, 0, 0],
    [0, 1, 0],
    [-1, 0, 0],
    [0, -1, 0],
  ];
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

/** Makes a group of buttons one stop of the Tab key; arrow keys move the focus inside it. */
function roving(group, buttons) {
  const enter = (button) =>
    buttons.forEach((other) => {
      other.tabIndex = other === button ? 0 : -1;
    });
  enter(buttons[0]);
  group.addEventListener("focusin", ({ target }) => enter(target));
  group.addEventListener("keydown", (event) => {
    const move = MOVES[event.key];
    if (!move) return;
    event.preventDefault();
    buttons[(buttons.indexOf(document.activeElement) + move + buttons.length) % buttons.length].focus({
      preventScroll: true,
    });
  });
}

function faceButton({ view, text }) {
  const title = view === "top" ? "Look from above" : `Look at the robot's ${view}`;
  return h("button", { class: "cube-face", "aria-label": `${text} view`, title, data: { view }, text });
}

export class ViewCube {
  #store;
  #front = null;
  #faces;
  #corner = h("button", {
    class: "cube-corner",
    "aria-label": "Perspective view",
    title: "Look from above at an angle",
  });

  /**
   * @param {import("../state/store.js").Store} store
   * @param {(view: string) => void} look
   */
  constructor(store, look) {
    this.#store = store;
    this.#faces = FACES.map((face) => ({ ...face, button: faceButton(face) }));
    this.#faces.forEach(({ view, button }) => button.addEventListener("click", () => look(view)));
    this.#corner.addEventListener("click", () => look("perspective"));
    const buttons = [...this.#faces.map(({ button }) => button), this.#corner];
    byId("view-cube").replaceChildren(...buttons);
    roving(byId("view-cube"), buttons);
  }

  /** Whether the robot's front has changed. */
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
    const nearest = CORNERS.reduce((best, corner) =>
      dot(corner, axes.back) > dot(best, axes.back) ? corner : best,
    );
    const at = [dot(axes.right, nearest), -dot(axes.up, nearest)].map((value) => MIDDLE + HALF * value);
    this.#corner.style.transform = `translate(${at[0].toFixed(1)}px, ${at[1].toFixed(1)}px)`;
  }
}
