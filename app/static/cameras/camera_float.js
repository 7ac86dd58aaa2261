/** A camera's live picture in a corner of the 3D scene, so that the robot is seen while it walks. */

import { clamp } from "../lib/clamp.js";
import { cameraTone, cameraLabel } from "./camera_labels.js";
import { remember, remembered } from "../lib/remembered.js";
import { byId, h, icon, setText } from "../lib/dom.js";
import { streamOf } from "../api/videos.js";
import "../pictures/picture_style.js";

const WIDTH = 480;
const STEP_PX = 16;
const KEY = "camera-float";
const LEAST_PX = 96;

let open = null;

/** Place and width as they were left, px; null where the style's hold. */
function recalledPlace() {
  const { x, y, width } = remembered(KEY);
  return [x, y, width].map((value) => (Number.isFinite(value) ? value : null));
}

/** Moves the picture by its title, with drag or keys, and resizes it by its corner; both are kept. */
function movable(element, title) {
  const [keptX, keptY, width] = recalledPlace();
  let [x, y, held] = [keptX ?? 0, keptY ?? 0, null];
  if (width !== null) element.style.width = `${width}px`;
  const put = () => remember(KEY, { x, y, width: element.style.width ? element.offsetWidth : null });
  const place = (nextX, nextY) => {
    const [stage, { offsetLeft, offsetTop, offsetWidth, offsetHeight }] = [element.parentElement, element];
    x = clamp(nextX, -offsetLeft, stage.clientWidth - offsetLeft - offsetWidth);
    y = clamp(nextY, -offsetTop, stage.clientHeight - offsetTop - offsetHeight);
    element.style.transform = `translate(${x}px, ${y}px)`;
  };
  title.addEventListener("pointerdown", (event) => {
    if (event.button !== 0 || event.target.closest("button")) return;
    held = { dx: x - event.clientX, dy: y - event.clientY };
    title.setPointerCapture(event.pointerId);
  });
  title.addEventListener("pointermove", (event) => {
    if (held) place(event.clientX + held.dx, event.clientY + held.dy);
  });
  for (const kind of ["pointerup", "pointercancel"])
    title.addEventListener(kind, () => {
      held = null;
      put();
    });
  title.addEventListener("keydown", (event) => {
    const size = { "+": 1, "=": 1, "-": -1, "−": -1 }[event.key];
    if (size && event.target === title)
      element.style.width = `${Math.max(element.offsetWidth + size * STEP_PX, LEAST_PX)}px`;
    const way = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
    if (!way || event.target !== title) return;
    event.preventDefault();
    place(x + way[0] * STEP_PX, y + way[1] * STEP_PX);
    put();
  });
  // The corner is the browser's own handle. A new size or a smaller window may push it over the stage's edge.
  new ResizeObserver(() => {
    if (!element.isConnected) return;
    place(x, y);
    if (element.style.width) put();
  }).observe(element);
}

/** The bar that names the camera; the picture is moved by it. */
function titleBar(close) {
  const [dot, word, name] = [h("span", { class: "dot" }), h("span", { class: "quiet" }), h("b")];
  const closing = h(
    "button",
    {
      type: "button",
      class: "plain icon-only",
      "aria-label": "Close the camera's picture",
      on: { click: close },
    },
    icon("close"),
  );
  const title =
    "Drag here to move the picture, or press the arrow keys. "
    + "Drag the corner to resize the picture, or press + and −";
  const attributes = { tabindex: "0", role: "group", data: { arrows: "" }, title };
  const element = h("header", attributes, dot, name, word, closing);
  return {
    element,
    show(camera) {
      const keys = "the arrow keys move the picture, plus and minus resize the picture";
      element.setAttribute("aria-label", `Camera ${camera.name}: ${keys}`);
      setText(name, camera.name);
      dot.dataset.tone = cameraTone(camera);
      setText(word, cameraLabel(camera));
    },
  };
}

function build(store, id) {
  const image = h("img", { alt: "", draggable: "false" });
  const note = h("p", { class: "quiet", role: "status" });
  const title = titleBar(shut);
  const element = h("section", { class: "camera-float" }, title.element, image, note);
  let [isClosed, streams] = [false, false];

  function follow({ cameras }) {
    if (isClosed) return;
    const camera = cameras?.find((one) => one.id === id);
    if (!camera) return;
    element.setAttribute("aria-label", `Camera ${camera.name}`);
    title.show(camera);
    const gone = camera.state === "unplugged";
    setText(note, gone ? camera.sentence : "");
    image.hidden = gone;
    if (!gone && !streams) begin();
  }
  function begin() {
    streams = true;
    image.src = `${streamOf(id, WIDTH)}&since=${Date.now()}`;
  }
  function shut() {
    isClosed = true;
    image.removeAttribute("src");
    element.remove();
    open = null;
  }

  // The stream ends where the camera is unplugged; the next event that says it is back begins another one.
  image.addEventListener("error", () => {
    streams = false;
  });
  movable(element, title.element);
  store.watch(({ cameras }) => [cameras], follow);
  return { id, element, shut };
}

/** Shows a camera's picture over the scene, or removes it; one at a time. */
export function toggleFloat(store, id) {
  const before = open;
  before?.shut();
  if (before?.id === id) return;
  open = build(store, id);
  byId("viser").parentElement.append(open.element);
}
