/** Picks a foot's colour: press the button, then click the foot in the picture. */

import { rangeAt } from "./camera_colour_range.js";
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
