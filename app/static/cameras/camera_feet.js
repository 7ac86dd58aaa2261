/** Tunes the colours of the feet on a picture: pixels of the colour stay lit, and each blob shows why it is a foot or not. */

import { drawBlobs, blobNumbers } from "./camera_overlay.js";
import { limitFields, shareField } from "./camera_fields.js";
import { hueRange } from "./camera_hue.js";
import { colourPicking } from "./camera_colour_picker.js";
import { FOOT_NAMES } from "./camera_labels.js";
import { h, setText } from "../lib/dom.js";
import { fixed } from "../lib/format.js";
import { measured } from "../state/live_plan.js";
import { announce } from "../lib/toasts.js";
import { look } from "../api/videos.js";

const MOST_WIDTH = 1280;

function footButtons(choose) {
  const buttons = FOOT_NAMES.map((name, index) => h("button", { type: "button", "aria-pressed": "false", data: { foot: index + 1 }, "aria-label": name, on: { click: () => choose(index) } },
    h("i", { class: "foot-dot", "aria-hidden": "true" }), String(index + 1)));
  return {
    element: h("div", { class: "camera-choice", role: "group", "aria-label": "Foot" }, ...buttons),
    show: (foot) => buttons.forEach((button, index) => button.setAttribute("aria-pressed", String(index === foot))),
  };
}

function blobText({ area, fill, fit, reason }, number, isChosen) {
  return h("li", { data: { fit: isChosen ? "chosen" : fit ? "fit" : "refused" } }, h("b", { text: String(number) }), h("span", { class: "number", text: `${fixed(area, 0)} px², filled ${fixed(fill * 100, 0)} %` }),
    h("span", { class: isChosen ? "" : "quiet", text: isChosen ? "taken as the foot" : reason ?? "smaller than the one that is taken" }));
}

function feetText(feet) {
  const words = (one) => (one === null ? "not seen" : one.place_cm ? `${fixed(one.place_cm[0], 1)}, ${fixed(one.place_cm[1], 1)} cm` : "seen");
  return feet.map((one, index) => h("li", { data: { foot: index + 1 } }, h("i", { class: "foot-dot", "aria-hidden": "true" }), h("span", { text: FOOT_NAMES[index] }), h("span", { class: one ? "number" : "number why", text: words(one) })));
}

/** The list of spots in the shown picture, and where each foot is taken to be. */
function findings() {
  const [spots, feet, head] = [h("ul", { class: "camera-spots", "aria-label": "Spots of this colour" }), h("ul", { class: "camera-feet", "aria-label": "Feet in this picture" }), h("p", { class: "quiet", role: "status" })];
  return {
    element: h("div", { class: "camera-found" }, head, spots, h("h3", { text: "All feet in this picture" }), feet),
    show(answer, foot) {
      const fit = answer.spots.filter((spot) => spot.fit).length;
      const count = answer.spots.length + answer.more;
      setText(head, count ? `${count} ${count === 1 ? "spot has" : "spots have"} this colour, ${fit} could be a foot.` : `Nothing in this picture has the colour of foot ${foot + 1}.`);
      spots.replaceChildren(...answer.spots.map((spot, index) => blobText(spot, index + 1, index === answer.chosen)), ...(answer.more ? [h("li", { class: "quiet", text: `and ${answer.more} smaller` })] : []));
      feet.replaceChildren(...feetText(answer.feet));
    },
  };
}

/** The fields of a foot's colour, and of the spots that may be any foot. */
function colourFields(change, changeLimits) {
  const hue = hueRange((range, last) => change({ hue: range }, last));
  const saturation = shareField("Least saturation", "How colourful a pixel must be; light and grey pixels have little", (share, last) => change({ saturation: share }, last));
  const value = shareField("Least brightness", "How bright a pixel must be; shade has little", (share, last) => change({ value: share }, last));
  const limits = limitFields(changeLimits);
  return {
    elements: [hue.element, saturation.element, value.element, h("details", {}, h("summary", { text: "Which spots may be a foot" }), limits.element)],
    show(setup, foot) {
      const colour = setup.colours[foot];
      hue.show(colour.hue, `Foot ${foot + 1}`);
      saturation.show(colour.saturation);
      value.show(colour.value);
      limits.show(setup.limits);
    },
  };
}

/**
 * Builds the part.
 * @param {object} draft of `setupDraft`
 * @param {object} stage of `openStage`
 * @returns {{element: HTMLElement, enter: () => void, leave: () => void}}
 */
export function feetPart(draft, stage) {
  let [foot, isOn, since, hasMask] = [0, false, null, true];
  const [found, number] = [findings(), blobNumbers(stage.picture)];

  function change(patch, last = true) {
    since ??= performance.now();
    draft.change(patch, last);
    stage.refresh();
  }
  const changeColour = (patch, last) => change({ colours: draft.state.setup.colours.map((one, index) => (index === foot ? { ...one, ...patch } : one)) }, last);
  const buttons = footButtons((next) => { foot = next; show(); stage.refresh(); });
  const fields = colourFields(changeColour, (patch) => change({ limits: { ...draft.state.setup.limits, ...patch } }));
  const mask = h("button", { type: "button", text: "Mask", title: "What has this colour stays lit, the rest is dim", on: { click: () => { hasMask = !hasMask; showMask(); } } });
  const picking = colourPicking(stage.picture, { changed: () => showMask(), take: (range) => { changeColour(range); announce(`Colour of foot ${foot + 1} taken.`); } });
  const shows = () => (hasMask && !picking.isOn() ? "mask" : "plain");

  function showMask() {
    mask.setAttribute("aria-pressed", String(shows() === "mask"));
    if (isOn) stage.refresh();
  }

  async function fetching(frame) {
    const [began, wanted, { setup, answer: { view } }] = [since ?? performance.now(), shows(), draft.state];
    const answer = await look(stage.source, frame, { foot: foot + 1, colours: setup.colours, limits: setup.limits, shows: wanted, setup: view ? setup : null, most: MOST_WIDTH });
    if (!isOn) return null;
    await stage.picture.show(answer.picture, answer.size);
    if (!isOn) return null;
    drawBlobs(stage.picture.drawing, answer);
    number(answer.spots);
    found.show(answer, foot);
    since = null;
    picking.shown(wanted === "plain");
    measured("colour to picture", began);
    return null;
  }

  const show = () => { buttons.show(foot); fields.show(draft.state.setup, foot); };

  draft.watch(({ setup }) => [setup.colours, setup.limits], () => { if (isOn) show(); });
  showMask();
  return {
    element: h("div", { class: "camera-part" },
      h("p", { class: "quiet", text: "Which colour each foot has. Pick it in the picture, then look through the frames and widen or narrow it." }),
      h("div", { class: "camera-row" }, buttons.element, picking.button, mask), ...fields.elements, found.element),
    enter() {
      isOn = true;
      show();
      stage.fetches(fetching);
    },
    leave() {
      isOn = false;
      picking.end();
      stage.picture.drawing.replaceChildren();
      number([]);
      stage.fetches(null);
    },
  };
}
