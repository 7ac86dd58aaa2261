/** Fits the view when the 3D scene of a robot opens, and again after the stage is resized. */

import { byId } from "../lib/dom.js";

/** A resize is over when the size has been constant for this long, ms. */
const SETTLED_MS = 120;

/**
 * @param {import("../preview/preview.js").Preview} preview
 * @param {() => void} fit shows the robot's whole path in the view chosen last
 */
export function fitByItself(preview, fit) {
  let isFitted = false;
  let timer = 0;
  let size = "";
  const first = () => {
    if (isFitted || !preview.view() || !preview.info) return;
    isFitted = true;
    fit();
  };
  preview.addEventListener("opening", () => {
    isFitted = false;
  });
  preview.addEventListener("ready", first);
  preview.addEventListener("poses", first);
  first();
  new ResizeObserver(
    ([
      {
        contentRect: { width, height },
      },
    ]) => {
      const before = size;
      size = `${width} ${height}`;
      clearTimeout(timer);
      // A collapsed stage has no size to fit to.
      if (before && width && height) timer = setTimeout(() => preview.refit(), SETTLED_MS);
    },
  ).observe(byId("viser").parentElement);
}
