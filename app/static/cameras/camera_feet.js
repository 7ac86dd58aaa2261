/** Tunes the colours of the feet on a picture: their pixels stay lit, blobs say why they are feet or not. */

import { look } from "../api/videos.js";
import { h, setText } from "../lib/dom.js";
import { fixed } from "../lib/format.js";
import { announce, toast } from "../lib/toasts.js";
import { measured } from "../state/live_plan.js";
import { limitFields, shareField } from "./camera_fields.js";
import { hueRange } from "./camera_hue.js";
import { FOOT_NAMES } from "./camera_labels.js";
import { blobNumbers, drawBlobs } from "./camera_overlay.js";

const MOST_WIDTH = 1280;
const HELP =
  "Set the colour of each foot. Select a foot, press Pick colour, then click on this foot in the "
  + "picture. Look at other pictures, and adjust the colour until the studio finds the foot in each picture.";
const MASK_HELP = "Shows the pixels with the colour of the selected foot and dims all other pixels";

function footButtons(choose) {
  const buttons = FOOT_NAMES.map((name, index) =>
    h(
      "button",
      {
        type: "button",
        "aria-pressed": "false",
        data: { foot: index + 1 },
        "aria-label": name,
        on: { click: () => choose(index) },
      },
      h("i", { class: "foot-dot", "aria-hidden": "true" }),
      String(index + 1),
    ),
  );
  return {
    element: h("div", { class: "camera-choice", role: "group", "aria-label": "Foot" }, ...buttons),
    show: (foot) =>
      buttons.forEach((button, index) => button.setAttribute("aria-pressed", String(index === foot))),
  };
}

function blobText({ area, fill, fit, reason }, number, isChosen) {
  return h(
    "li",
    { data: { fit: isChosen ? "chosen" : fit ? "fit" : "refused" } },
    h("b", { text: String(number) }),
    h("span", { class: "number", text: `${fixed(area, 0)} px², filled ${fixed(fill * 100, 0)} %` }),
    h("span", {
      class: isChosen ? "" : "quiet",
      text: isChosen ? "chosen as the foot" : (reason ?? "smaller than the chosen spot"),
    }),
  );
}

function feetText(feet) {
  const words = (one) =>
    one === null
      ? "not seen"
      : one.place_cm
        ? `${fixed(one.place_cm[0], 1)}, ${fixed(one.place_cm[1], 1)} cm`
        : "seen";
  return feet.map((one, index) =>
    h(
      "li",
      { data: { foot: index + 1 } },
      h("i", { class: "foot-dot", "aria-hidden": "true" }),
      h("span", { text: FOOT_NAMES[index] }),
      h("span", { class: one ? "number" : "number why", text: words(one) }),
    ),
  );
}

/** The list of spots in the shown picture, and where each foot is taken to be. */
function findings() {
  const [spots, feet, head] = [
    h("ul", { class: "camera-spots", "aria-label": "Spots of this colour" }),
    h("ul", { class: "camera-feet", "aria-label": "Feet in this picture" }),
    h("p", { class: "quiet", role: "status" }),
  ];
  return {
    element: h(
      "div",
      { class: "camera-found" },
      head,
      spots,
      h("h3", { text: "All feet in this picture" }),
      feet,
    ),
    show(answer, foot) {
      const fit = answer.spots.filter((spot) => spot.fit).length;
      const count = answer.spots.length + answer.more;
      setText(
        head,
        count
          ? `Spots with the colour of foot ${foot + 1}: ${count}. Spots that may be the foot: ${fit}.`
          : `Nothing in this picture has the colour of foot ${foot + 1}.`,
      );
      spots.replaceChildren(
        ...answer.spots.map((spot, index) => blobText(spot, index + 1, index === answer.chosen)),
        ...(answer.more ? [h("li", { class: "quiet", text: `and ${answer.more} smaller` })] : []),
      );
      feet.replaceChildren(...feetText(answer.feet));
    },
  };
}

/** The fields of a foot's colour, and of the spots that may be any foot. */
function colourFields(change, changeLimits) {
  const hue = hueRange((range, last) => change({ hue: range }, last));
  const saturation = shareField(
    "Least saturation",
    "Pixels with a lower saturation do not count as "
      + "part of the foot. Pale and grey pixels have a low saturation",
    (share, last) => change({ saturation: share }, last),
  );
  const value = shareField(
    "Least brightness",
    "Darker pixels do not count as part of the foot. Pixels in a shadow are dark",
    (share, last) => change({ value: share }, last),
  );
  const limits = limitFields(changeLimits);
  return {
    elements: [
      hue.element,
      saturation.element,
      value.element,
      h("details", {}, h("summary", { text: "Which spots may be a foot" }), limits.element),
    ],
    show(setup, foot) {
      const colour = setup.colours[foot];
      hue.show(colour.hue, `Foot ${foot + 1}`);
      saturation.show(colour.saturation);
      value.show(colour.value);
      limits.show(setup.limits);
    },
  };
}

/** What is shown: the mask of the foot's colour, or the picture itself, from which a colour can be picked. */
function shownColours(picture, { changed, take }) {
  let hasMask = true;
  const mask = h("button", { type: "button", text: "Mask", title: MASK_HELP });
  const picking = colourPicking(picture, { changed: update, take });
  const shows = () => (hasMask && !picking.isOn() ? "mask" : "plain");

  function update() {
    mask.setAttribute("aria-pressed", String(shows() === "mask"));
    changed();
  }

  mask.addEventListener("click", () => {
    hasMask = !hasMask;
    update();
  });
  update();
  return { buttons: [picking.button, mask], shows, shown: picking.shown, end: picking.end };
}

/** Looks for the feet while the part is open, and draws blobs; `wanted` gives the foot and what to show. */
function feetView(draft, stage, { wanted, shown }) {
  const number = blobNumbers(stage.picture);
  let [isOn, since] = [false, null];

  async function fetching(frame) {
    const began = since ?? performance.now();
    const { setup, answer: state } = draft.state;
    const { colours, limits } = setup;
    const request = { ...wanted(), colours, limits, setup: state.view ? setup : null, most: MOST_WIDTH };
    const answer = await look(stage.source, frame, request);
    if (!isOn) return null;
    await stage.picture.show(answer.picture, answer.size);
    if (!isOn) return null;
    drawBlobs(stage.picture.drawing, answer);
    number(answer.spots);
    since = null;
    shown(answer, request.shows);
    measured("colour to picture", began);
    return null;
  }

  return {
    isOn: () => isOn,
    refresh() {
      if (isOn) stage.refresh();
    },
    change(patch, last = true) {
      since ??= performance.now();
      draft.change(patch, last);
      stage.refresh();
    },
    enter() {
      isOn = true;
      stage.fetches(fetching);
    },
    leave() {
      isOn = false;
      stage.picture.drawing.replaceChildren();
      number([]);
      stage.fetches(null);
    },
  };
}

/**
 * Builds the part.
 * @param {Record<string, any>} draft of `setupDraft`
 * @param {Record<string, any>} stage of `openStage`
 * @returns {{element: HTMLElement, enter: () => void, leave: () => void}}
 */
export function feetPart(draft, stage) {
  let foot = 0;
  const found = findings();
  const view = feetView(draft, stage, {
    wanted: () => ({ foot: foot + 1, shows: colours.shows() }),
    shown(answer, wanted) {
      found.show(answer, foot);
      colours.shown(wanted === "plain");
    },
  });
  const changeColour = (patch, last) => {
    const patched = (one, index) => (index === foot ? { ...one, ...patch } : one);
    view.change({ colours: draft.state.setup.colours.map(patched) }, last);
  };
  const buttons = footButtons((next) => {
    foot = next;
    show();
    view.refresh();
  });
  const fields = colourFields(changeColour, (patch) =>
    view.change({ limits: { ...draft.state.setup.limits, ...patch } }),
  );
  const colours = shownColours(stage.picture, {
    changed: view.refresh,
    take: (range) => {
      changeColour(range);
      announce(`The colour of foot ${foot + 1} is set.`);
    },
  });

  function show() {
    buttons.show(foot);
    fields.show(draft.state.setup, foot);
  }

  draft.watch(
    ({ setup }) => [setup.colours, setup.limits],
    () => {
      if (view.isOn()) show();
    },
  );
  const element = h(
    "div",
    { class: "camera-part" },
    h("p", { class: "quiet", text: HELP }),
    h("div", { class: "camera-row" }, buttons.element, ...colours.buttons),
    ...fields.elements,
    found.element,
  );
  return {
    element,
    enter() {
      show();
      view.enter();
    },
    leave() {
      view.leave();
      colours.end();
    },
  };
}

/**
 * Builds the button.
 * @param {Record<string, any>} picture of `pictureView`
 * @param {{changed: () => void, take: (range: Record<string, any>) => void}} acts `changed` at begin and end
 * @returns {{button: HTMLElement, isOn: () => boolean, shown: (hasOwn: boolean) => void, end: () => void}}
 *   call `shown` with each new picture: whether it has its own colours
 */
export function colourPicking(picture, { changed, take }) {
  const title =
    "Press this button, then click on the selected foot in the picture. "
    + "The studio takes the colour of the foot from the picture";
  const button = h("button", { type: "button", text: "Pick colour", "aria-pressed": "false", title });
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
      toast("The place you clicked is grey, black or white. Click on the coloured sole of the foot.", {
        of: "studio",
      });
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
    button,
    isOn,
    shown(own) {
      hasOwnColours = own;
      if (own && clicked && isOn()) pick(clicked);
    },
    end: () => {
      if (isOn()) turn(false);
    },
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
  const sixth =
    high === red
      ? (green - blue) / spread
      : high === green
        ? 2 + (blue - red) / spread
        : 4 + (red - green) / spread;
  return [(((sixth / 6) % 1) + 1) % 1, spread / high, high / 255];
}

function pixelsAround({ image, size }, place) {
  const [x, y] = place.map((value) => (value * image.naturalWidth) / size.width);
  const side = 2 * RADIUS + 1;
  const canvas = new OffscreenCanvas(side, side);
  const pen = canvas.getContext("2d", { willReadFrequently: true });
  pen.drawImage(image, Math.round(x) - RADIUS, Math.round(y) - RADIUS, side, side, 0, 0, side, side);
  const { data } = pen.getImageData(0, 0, side, side);
  return Array.from({ length: side * side }, (_, index) => [
    ...data.subarray(4 * index, 4 * index + 4),
  ]).filter(([, , , alpha]) => alpha === 255);
}

const share = (sorted, at) => sorted[Math.round(at * (sorted.length - 1))];
const ascending = (values) => [...values].sort((a, b) => a - b);

/**
 * The range of a clicked colour.
 * @param {number[][]} pixels red, green, blue, 0 to 255
 * @returns {{hue: number[], saturation: number, value: number}|null} null for grey, black or white
 */
export function rangeOf(pixels) {
  const all = pixels.map(hsv);
  const middle = share(ascending(all.map(([, saturation]) => saturation)), 0.5);
  if (!all.length || middle < LEAST) return null;
  // Hues are compared as turns from the mean direction: red lies on both ends of the circle.
  const [sin, cos] = [Math.sin, Math.cos].map((act) =>
    all.reduce((sum, [hue, saturation]) => sum + saturation * act(2 * Math.PI * hue), 0),
  );
  const mean = Math.atan2(sin, cos) / (2 * Math.PI);
  const turns = ascending(all.map(([hue]) => ((((hue - mean + 0.5) % 1) + 1) % 1) - 0.5));
  const around = (hue) => Number((((hue % 1) + 1) % 1).toFixed(4));
  const least = (index) => Number((SHARE * share(ascending(all.map((one) => one[index])), 0.2)).toFixed(3));
  return {
    hue: [around(mean + share(turns, 0.1) - HUE_ROOM), around(mean + share(turns, 0.9) + HUE_ROOM)],
    saturation: least(1),
    value: least(2),
  };
}

/** The range of the colour at a place of a `pictureView`. */
export const rangeAt = (picture, place) => rangeOf(pixelsAround(picture, place));
