/** Points over a picture: set by a click, moved by drag or arrow keys, removed with Delete; a loupe shows the place. */

import { h } from "../lib/dom.js";
import { fixed } from "../lib/format.js";

const STEPS = { plain: 1, far: 10, fine: 0.1 };
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

const nameOf = (index, [x, y]) => `Point ${index + 1}, at ${fixed(x, 1)}, ${fixed(y, 1)} px`;

function pressed(event, { nudge, remove }) {
  const way = ARROWS[event.key];
  const gone = event.key === "Delete" || event.key === "Backspace";
  if ((!way && !gone) || event.ctrlKey || event.metaKey) return;
  event.preventDefault();
  event.stopPropagation();
  const step = event.shiftKey ? STEPS.far : event.altKey ? STEPS.fine : STEPS.plain;
  if (gone) remove();
  else nudge(way.map((value) => value * step));
}

function dragging(handle, picture, lens, { moving, moved }) {
  let held = null;
  handle.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    event.preventDefault();
    handle.focus({ preventScroll: true });
    handle.setPointerCapture(event.pointerId);
    const { left, top } = picture.element.getBoundingClientRect();
    const [x, y] = [parseFloat(handle.dataset.x), parseFloat(handle.dataset.y)];
    const [sx, sy] = picture.toScreen([x, y]);
    held = { left, top, dx: sx - (event.clientX - left), dy: sy - (event.clientY - top), changed: false };
    lens.show([x, y]);
  });
  handle.addEventListener("pointermove", (event) => {
    if (!held) return;
    const place = picture.toPlace({
      x: event.clientX - held.left + held.dx,
      y: event.clientY - held.top + held.dy,
    });
    if (!picture.isInside(place)) return;
    held.changed = true;
    moving(place);
    lens.show(place);
  });
  const end = () => {
    if (!held) return;
    const { changed } = held;
    held = null;
    lens.show(null);
    if (changed) moved();
  };
  handle.addEventListener("pointerup", end);
  handle.addEventListener("pointercancel", end);
}

/**
 * Builds the points.
 * @param {Record<string, any>} picture of `pictureView`
 * @param {{add: (place: number[]) => void, move: (index: number, place: number[], last: boolean) => void, remove: (index: number) =>
 *   void, chosen: (index: number|null) => void}} acts `last` is false while a finger drags
 * @returns {{show: (places: number[][]) => void, focus: (index: number) => void, allow: (isOn: boolean) => void}} `allow` says
 *   whether a click sets a point
 */
export function picturePoints(picture, { add, move, remove, chosen }) {
  const lens = loupe(picture);
  let [places, handles, isOn] = [[], [], false];

  function put(index) {
    const [x, y] = picture.toScreen(places[index]);
    handles[index].style.transform = `translate(${x.toFixed(2)}px, ${y.toFixed(2)}px)`;
  }

  function goTo(index, place, last) {
    places = places.map((one, at) => (at === index ? place : one));
    label(index);
    put(index);
    move(index, place, last);
  }

  function label(index) {
    const [x, y] = places[index];
    Object.assign(handles[index].dataset, { x, y });
    handles[index].setAttribute("aria-label", nameOf(index, places[index]));
  }

  function nudge(index, by) {
    const place = places[index].map((value, axis) => value + by[axis]);
    if (!picture.isInside(place)) return;
    goTo(index, place, true);
    picture.reveal(place);
    lens.show(place);
  }

  function handle(index) {
    const title =
      "Drag the point to move it. The arrow keys move the point by 1 px, with Shift by 10 px, "
      + "with Alt by 0.1 px. The key Delete removes the point";
    const element = h(
      "button",
      { type: "button", class: "video-point", title, data: { arrows: "", keys: "" } },
      h("span", { text: String(index + 1) }),
    );
    dragging(element, picture, lens, {
      moving: (place) => goTo(index, place, false),
      moved: () => move(index, places[index], true),
    });
    element.addEventListener("keydown", (event) =>
      pressed(event, { nudge: (by) => nudge(index, by), remove: () => remove(index) }),
    );
    element.addEventListener("focus", () => chosen(index));
    element.addEventListener("blur", () => lens.show(null));
    return element;
  }

  picture.onView(() => handles.forEach((_, index) => put(index)));
  picture.onHover((place) => {
    if (isOn || place === null) lens.show(place);
  });
  picture.onClick((place) => {
    if (isOn) add(place);
  });
  return {
    show(next) {
      while (handles.length > next.length) handles.pop().remove();
      places = next.map((place) => [...place]);
      places.forEach((_, index) => {
        if (!handles[index]) picture.layer.append((handles[index] = handle(index)));
        label(index);
        put(index);
      });
    },
    focus: (index) => handles[index]?.focus(),
    allow(next) {
      isOn = next;
      picture.element.toggleAttribute("data-aims", next);
      if (!next) lens.show(null);
    },
  };
}

const SIZE = 116;
const TIMES = 6;
const AWAY = 22;

/**
 * Builds the loupe over a picture.
 * @param {Record<string, any>} picture of `pictureView`
 * @returns {{show: (place: number[]|null) => void}} null hides it
 */
function loupe(picture) {
  const canvas = h("canvas", {
    class: "video-loupe",
    width: SIZE,
    height: SIZE,
    "aria-hidden": "true",
    hidden: true,
  });
  const pen = canvas.getContext("2d");
  picture.element.append(canvas);

  function draw([x, y]) {
    const side = SIZE / TIMES;
    pen.imageSmoothingEnabled = false;
    pen.fillStyle = "#808080";
    pen.fillRect(0, 0, SIZE, SIZE);
    const shown = picture.image.naturalWidth / picture.size.width;
    pen.drawImage(
      picture.image,
      ...[x + 0.5 - side / 2, y + 0.5 - side / 2, side, side].map((value) => value * shown),
      0,
      0,
      SIZE,
      SIZE,
    );
    const middle = SIZE / 2 + 0.5;
    for (const [color, width] of [
      ["#000", 3],
      ["#fff", 1],
    ]) {
      pen.strokeStyle = color;
      pen.lineWidth = width;
      pen.beginPath();
      pen.moveTo(middle, 8);
      pen.lineTo(middle, middle - 5);
      pen.moveTo(middle, middle + 5);
      pen.lineTo(middle, SIZE - 8);
      pen.moveTo(8, middle);
      pen.lineTo(middle - 5, middle);
      pen.moveTo(middle + 5, middle);
      pen.lineTo(SIZE - 8, middle);
      pen.stroke();
    }
  }

  return {
    show(place) {
      canvas.hidden = !place || !picture.image.complete || !picture.image.naturalWidth;
      if (canvas.hidden) return;
      draw(place);
      const [x, y] = picture.toScreen(place);
      const { clientWidth: width } = picture.element;
      const left = x + AWAY + SIZE > width ? x - AWAY - SIZE : x + AWAY;
      const top = y - AWAY - SIZE < 0 ? y + AWAY : y - AWAY - SIZE;
      canvas.style.transform = `translate(${left.toFixed(1)}px, ${top.toFixed(1)}px)`;
    },
  };
}
