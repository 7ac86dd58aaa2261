/** A range of hues on the colour circle as a strip with two ends; it may go over red, where that closes. */

import { h } from "../lib/dom.js";
import { fixed } from "../lib/format.js";

const CIRCLE = 360;
const STEP = 1;
const FAR = 10;

const around = (degrees) => ((degrees % CIRCLE) + CIRCLE) % CIRCLE;

/**
 * The pieces of the strip that a range leaves out, as shares from left to right.
 * @param {number[]} range
 */
function leftOut([low, high]) {
  return low <= high
    ? [
        [0, low],
        [high, 1],
      ]
    : [
        [high, low],
        [0, 0],
      ];
}

function end(strip, { read, moving, moved }) {
  const title = "Drag this end of the hue range. The arrow keys move this end by 1°, with Shift by 10°";
  const element = h("div", {
    class: "hue-end",
    role: "slider",
    tabindex: "0",
    "aria-valuemin": "0",
    "aria-valuemax": String(CIRCLE),
    data: { arrows: "", keys: "" },
    title,
  });
  const set = (degrees, last) => (last ? moved : moving)(around(degrees) / CIRCLE);
  let held = false;
  element.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    event.preventDefault();
    held = true;
    element.focus({ preventScroll: true });
    element.setPointerCapture(event.pointerId);
  });
  element.addEventListener("pointermove", (event) => {
    if (!held) return;
    const { left, width } = strip.getBoundingClientRect();
    set(Math.min(Math.max((event.clientX - left) / width, 0), 0.9999) * CIRCLE, false);
  });
  const release = () => {
    if (held) set(read() * CIRCLE, true);
    held = false;
  };
  element.addEventListener("pointerup", release);
  element.addEventListener("pointercancel", release);
  element.addEventListener("keydown", (event) => {
    const way = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1 }[event.key];
    if (!way || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    event.stopPropagation();
    set(read() * CIRCLE + way * (event.shiftKey ? FAR : STEP), true);
  });
  return {
    element,
    show(share, name) {
      element.setAttribute("aria-label", name);
      element.style.left = `${share * 100}%`;
      element.setAttribute("aria-valuenow", fixed(share * CIRCLE, 0));
      element.setAttribute("aria-valuetext", `${fixed(share * CIRCLE, 0)}°`);
    },
  };
}

/**
 * Builds the strip.
 * @param {(range: number[], last: boolean) => void} changed told (low, high) as shares of the circle;
 *   `last` is false while a finger drags
 * @returns {{element: HTMLElement, show: (range: number[], name: string) => void}} `name` is of what has the
 *   colour, such as "Foot 1"
 */
export function hueRange(changed) {
  let [range, owner] = [[0, 1], ""];
  const masks = [h("i"), h("i")];
  const strip = h("div", { class: "hue-strip" }, ...masks);
  const words = h("span", { class: "number quiet" });
  const change = (index, share, last) => {
    range = range.map((one, at) => (at === index ? share : one));
    show(range, owner);
    changed(range, last);
  };
  const ends = [0, 1].map((index) =>
    end(strip, {
      read: () => range[index],
      moving: (share) => change(index, share, false),
      moved: (share) => change(index, share, true),
    }),
  );
  const element = h(
    "div",
    { class: "hue", role: "group" },
    h("div", { class: "hue-words" }, h("span", { text: "Hue" }), words),
    strip,
  );
  strip.append(...ends.map(({ element }) => element));

  function show(next, name) {
    [range, owner] = [[...next], name];
    element.setAttribute("aria-label", `${name}, hue`);
    leftOut(range).forEach(([from, to], index) =>
      Object.assign(masks[index].style, {
        left: `${from * 100}%`,
        width: `${Math.max(0, to - from) * 100}%`,
      }),
    );
    ends.forEach((one, index) => one.show(range[index], `${name}, hue ${["from", "to"][index]}`));
    words.textContent = `${fixed(range[0] * CIRCLE, 0)}° to ${fixed(range[1] * CIRCLE, 0)}°`;
  }

  return { element, show };
}
