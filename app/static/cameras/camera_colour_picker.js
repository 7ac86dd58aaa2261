/** Picks a foot's colour: press the button, then click the foot in the picture. */

import { h } from "../lib/dom.js";
import { toast } from "../lib/toasts.js";

/**
 * Builds the button.
 * @param {object} picture of `pictureView`
 * @param {{changed: () => void, take: (range: object) => void}} acts `changed` when picking begins or ends
 * @returns {{button: HTMLElement, isOn: () => boolean, shown: (hasOwnColours: boolean) => void, end: () => void}} `shown` is to be
 *   told whether the picture that stands there now has its own colours
 */
export function colourPicking(picture, { changed, take }) {
  const button = h("button", { type: "button", text: "Pick colour", "aria-pressed": "false", title: "Then click on this foot in the picture" });
  let [hasOwnColours, clicked] = [false, null];
  const isOn = () => button.getAttribute("aria-pressed") === "true";

  function turn(on) {
    button.setAttribute("aria-pressed", String(on));
    picture.element.toggleAttribute("data-aims", on);
    clicked = null;
    changed();
  }

  function pick(place) {
    clicked = null;
    const range = rangeAt(picture, place);
    if (!range) {
      toast("This place is grey, black or white: it has no hue to look for. Click on the foot's coloured sole.", { of: "studio" });
      return;
    }
    turn(false);
    take(range);
  }

  button.addEventListener("click", () => turn(!isOn()));
  // Where the mask is still shown, the click waits for the picture with its own colours.
  picture.onClick((place) => {
    if (!isOn()) return;
    if (hasOwnColours) pick(place);
    else clicked = place;
  });
  return {
    button, isOn,
    shown(own) {
      hasOwnColours = own;
      if (own && clicked && isOn()) pick(clicked);
    },
    end: () => { if (isOn()) turn(false); },
  };
}

const RADIUS = 5;
const HUE_ROOM = 0.03;
const SHARE = 0.6;
const LEAST = 0.15;

/** Hue, saturation and value, 0 to 1, as OpenCV defines them. */
function hsv([red, green, blue]) {
  const [high, low] = [Math.max(red, green, blue), Math.min(red, green, blue)];
  const spread = high - low;
  if (!spread) return [0, 0, high / 255];
  const sixth = high === red ? (green - blue) / spread : high === green ? 2 + (blue - red) / spread : 4 + (red - green) / spread;
  return [((sixth / 6) % 1 + 1) % 1, spread / high, high / 255];
}

function pixelsAround({ image, size }, place) {
  const [x, y] = place.map((value) => (value * image.naturalWidth) / size.width);
  const side = 2 * RADIUS + 1;
  const canvas = new OffscreenCanvas(side, side);
  const pen = canvas.getContext("2d", { willReadFrequently: true });
  pen.drawImage(image, Math.round(x) - RADIUS, Math.round(y) - RADIUS, side, side, 0, 0, side, side);
  const { data } = pen.getImageData(0, 0, side, side);
  return Array.from({ length: side * side }, (_, index) => [...data.subarray(4 * index, 4 * index + 4)]).filter(([, , , alpha]) => alpha === 255);
}

const share = (sorted, at) => sorted[Math.round(at * (sorted.length - 1))];
const ascending = (values) => [...values].sort((a, b) => a - b);

/**
 * The range of a clicked colour.
 * @param {number[][]} pixels red, green, blue, 0 to 255
 * @returns {{hue: number[], saturation: number, value: number}|null} null where they have no colour: grey, black or white
 */
export function rangeOf(pixels) {
  const all = pixels.map(hsv);
  const middle = share(ascending(all.map(([, saturation]) => saturation)), 0.5);
  if (!all.length || middle < LEAST) return null;
  // Hues are compared as turns from the mean direction: red lies on both ends of the circle.
  const [sin, cos] = [Math.sin, Math.cos].map((act) => all.reduce((sum, [hue, saturation]) => sum + saturation * act(2 * Math.PI * hue), 0));
  const mean = Math.atan2(sin, cos) / (2 * Math.PI);
  const turns = ascending(all.map(([hue]) => ((hue - mean + 0.5) % 1 + 1) % 1 - 0.5));
  const around = (hue) => Number((((hue % 1) + 1) % 1).toFixed(4));
  const least = (index) => Number((SHARE * share(ascending(all.map((one) => one[index])), 0.2)).toFixed(3));
  return { hue: [around(mean + share(turns, 0.1) - HUE_ROOM), around(mean + share(turns, 0.9) + HUE_ROOM)], saturation: least(1), value: least(2) };
}

/** The range of the colour at a place of a `pictureView`. */
export const rangeAt = (picture, place) => rangeOf(pixelsAround(picture, place));
