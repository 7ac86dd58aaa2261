/** Fits the view of the 3D scene when a robot's scene opens, and again when the stage has another size. */

import { byId } from "../lib/dom.js";

/** The stage counts as resized when its size has stood for this long, ms. */
const SETTLED_MS = 120;

/**
 * @param {import("../preview/preview.js").Preview} preview
 * @param {() => void} fit shows the whole way by the view that was chosen last
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
  preview.addEventListener("opening", () => { isFitted = false; });
  preview.addEventListener("ready", first);
  preview.addEventListener("poses", first);
  first();
  new ResizeObserver(([{ contentRect: { width, height } }]) => {
    const before = size;
    size = `${width} ${height}`;
    clearTimeout(timer);
    // A stage that is folded away has no size to fit to.
    if (before && width && height) timer = setTimeout(() => preview.refit(), SETTLED_MS);
  }).observe(byId("viser").parentElement);
}
