/** Draws over a picture of the platform: blobs of a colour, and the detected feet. */

import { h, svg } from "../lib/dom.js";

const ARM_PX = 9;
const LEAST_RADIUS = 3;

/** Dark and light under the foot's colour, so that it is seen on a sole of that very colour. */
const cross = ({ pixel: [x, y] }, foot) =>
  ["dark", "light", "own"].map((line) =>
    svg("path", {
      class: `camera-foot ${line}`,
      "data-foot": foot + 1,
      d: `M${x - ARM_PX} ${y}h${2 * ARM_PX}M${x} ${y - ARM_PX}v${2 * ARM_PX}`,
    }),
  );

/** A cross in each foot's colour. */
export function drawFeet(drawing, feet) {
  drawing.replaceChildren(...feet.flatMap((one, index) => (one ? cross(one, index) : [])));
}

/** Draws a ring around every blob of a foot's colour, and crosses on the feet. */
export function drawBlobs(drawing, { spots, chosen, feet }) {
  drawFeet(drawing, feet);
  drawing.prepend(
    ...spots.map(({ pixel: [cx, cy], radius, fit }, index) =>
      svg("circle", {
        class: `camera-spot ${index === chosen ? "chosen" : fit ? "fit" : "refused"}`,
        cx,
        cy,
        r: Math.max(radius, LEAST_RADIUS),
      }),
    ),
  );
}

/** Returns a function that numbers the blobs in the order of the list. */
export function blobNumbers(picture) {
  let labels = [];
  const put = () =>
    labels.forEach(({ element, place }) => {
      const [x, y] = picture.toScreen(place);
      element.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
    });
  picture.onView(put);
  return (spots) => {
    labels.forEach(({ element }) => element.remove());
    labels = spots.map(({ pixel: [x, y], radius }, index) => ({
      place: [x + radius * Math.SQRT1_2, y - radius * Math.SQRT1_2],
      element: h("span", { class: "camera-number", text: String(index + 1) }),
    }));
    picture.layer.append(...labels.map(({ element }) => element));
    put();
  };
}
