/** Points over a picture: set by click, moved by drag or arrow keys, removed with Delete; a loupe helps. */

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

/** The button of a point, moved by drag and by keys. */
function pointButton(index, picture, lens, { moving, moved, nudge, remove, chosen }) {
  const title =
    "Drag the point to move it. The arrow keys move the point by 1 px, with Shift by 10 px, "
    + "with Alt by 0.1 px. The key Delete removes the point";
  const element = h(
    "button",
    { type: "button", class: "video-point", title, data: { arrows: "", keys: "" } },
    h("span", { text: String(index + 1) }),
  );
  dragging(element, picture, lens, { moving, moved });
  element.addEventListener("keydown", (event) => pressed(event, { nudge, remove }));
  element.addEventListener("focus", chosen);
  element.addEventListener("blur", () => lens.show(null));
  return element;
}

/**
 * Builds the points.
 * @param {Record<string, any>} picture of `pictureView`
 * @param {Object} acts
 * @param {(place: number[]) => void} acts.add
 * @param {(index: number, place: number[], last: boolean) => void} acts.move `last` is false during a drag
 * @param {(index: number) => void} acts.remove
 * @param {(index: number|null) => void} acts.chosen
 * @returns {{show: (places: number[][]) => void, focus: (index: number) => void, allow: (isOn: boolean) =>
 *   void}} `allow` says whether a click sets a point
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

  const handle = (index) =>
    pointButton(index, picture, lens, {
      moving: (place) => goTo(index, place, false),
      moved: () => move(index, places[index], true),
      nudge: (by) => nudge(index, by),
      remove: () => remove(index),
      chosen: () => chosen(index),
    });

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

/** A cross over the loupe, open in the middle. */
function drawCross(pen, color, width) {
  const middle = SIZE / 2 + 0.5;
  pen.strokeStyle = color;
  pen.lineWidth = width;
  pen.beginPath();
  for (const [from, to] of [
    [8, middle - 5],
    [middle + 5, SIZE - 8],
  ]) {
    pen.moveTo(middle, from);
    pen.lineTo(middle, to);
    pen.moveTo(from, middle);
    pen.lineTo(to, middle);
  }
  pen.stroke();
}

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

  /** @param {number[]} place */
  function draw([x, y]) {
    pen.imageSmoothingEnabled = false;
    pen.fillStyle = "#808080";
    pen.fillRect(0, 0, SIZE, SIZE);
    const shown = picture.image.naturalWidth / picture.size.width;
    const side = (SIZE / TIMES) * shown;
    const [left, top] = [x, y].map((value) => (value + 0.5) * shown - side / 2);
    pen.drawImage(picture.image, left, top, side, side, 0, 0, SIZE, SIZE);
    drawCross(pen, "#000", 3);
    drawCross(pen, "#fff", 1);
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
