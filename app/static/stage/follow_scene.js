/** Redraws what lies over the 3D scene: reads the camera once a frame, and draws only after a change. */

import { byId } from "../lib/dom.js";

/** Fixed elements of the stage; labels keep clear of them. */
const STANDING = ["badge", "stage-tools", "view-cube", "legend"];
/** Below this height the stage shows only the scene and its tools, px. */
const LEAST_HEIGHT = 170;

/** Sizes of stage and fixed elements, and left edge of the scene's frame; measured again after a resize. */
function stageSizes() {
  const stage = byId("viser").parentElement;
  const sizes = { width: 0, height: 0, left: 0, standing: [], version: 0 };
  const measure = () => {
    const box = stage.getBoundingClientRect();
    stage.toggleAttribute("data-low", box.height < LEAST_HEIGHT);
    const boxes = STANDING.map((id) => byId(id).getBoundingClientRect()).filter(({ width }) => width > 0);
    sizes.standing = boxes.map(({ left, top, width, height }) => ({
      x: left - box.left + width / 2,
      y: top - box.top + height / 2,
      width,
      height,
    }));
    Object.assign(sizes, {
      width: box.width,
      height: box.height,
      left: byId("viser").getBoundingClientRect().left - box.left,
    });
    sizes.version += 1;
  };
  const observer = new ResizeObserver(measure);
  [stage, byId("viser"), ...STANDING.map(byId)].forEach((element) => observer.observe(element));
  return sizes;
}

/**
 * What is seen: `toStage` (from [x, y, z] in m to pixels of the stage, or null), the camera's axes, the
 * stage's size, and `taken`: the boxes of earlier parts.
 * @typedef {Record<string, any>} Seen
 * @typedef {{draw: (seen: Seen) => void, isChanged: (seen: Seen) => boolean, boxes?: object[]}} Part
 */

/**
 * Draws parts whenever the camera or the stage changes, or their own `isChanged` returns true. A part that is
 * drawn makes all later ones draw too, since they keep clear of it.
 * @param {import("../preview/preview.js").Preview} preview
 * @param {Part[]} parts
 */
export function followScene(preview, parts) {
  const sizes = stageSizes();
  const layer = byId("scene-labels");
  let drawn = null;

  function follow() {
    requestAnimationFrame(follow);
    const view = sizes.height >= LEAST_HEIGHT ? preview.view() : null;
    layer.toggleAttribute("data-off", view === null);
    if (!view) {
      drawn = null;
      return;
    }
    const key = `${sizes.version} ${view.key}`;
    const seen = { ...view, ...sizes, taken: [], toStage: (at) => shifted(view.toScreen(at), sizes.left) };
    let isMoved = key !== drawn;
    drawn = key;
    for (const part of parts) {
      isMoved = part.isChanged(seen) || isMoved;
      if (isMoved) part.draw(seen);
      seen.taken.push(...(part.boxes ?? []));
    }
  }
  follow();
}

const shifted = (at, left) => at && [at[0] + left, at[1]];
