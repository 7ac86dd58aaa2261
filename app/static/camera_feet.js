/** Colours of the feet, tuned on a picture: what has the colour stays lit, and every spot says why it is a foot or is none. */

import { drawSpots } from "./camera_drawing.js";
import { limitFields, shareField } from "./camera_fields.js";
import { hueRange } from "./camera_hue.js";
import { rangeAt } from "./camera_pick.js";
import { FOOT_NAMES } from "./camera_words.js";
import { h, setText } from "./dom.js";
import { fixed } from "./format.js";
import { announce, toast } from "./toasts.js";
import { look } from "./video_api.js";

const MOST_WIDTH = 1280;

function footButtons(choose) {
  const buttons = FOOT_NAMES.map((name, index) => h("button", { type: "button", "aria-pressed": "false", data: { foot: index + 1 }, "aria-label": name, on: { click: () => choose(index) } },
    h("i", { class: "foot-dot", "aria-hidden": "true" }), String(index + 1)));
  return {
    element: h("div", { class: "camera-choice", role: "group", "aria-label": "Foot" }, ...buttons),
    show: (foot) => buttons.forEach((button, index) => button.setAttribute("aria-pressed", String(index === foot))),
  };
}

function spotWords({ area, fill, fit, reason }, isChosen) {
  return h("li", { data: { fit: isChosen ? "chosen" : fit ? "fit" : "refused" } }, h("span", { class: "number", text: `${fixed(area, 0)} px², filled ${fixed(fill * 100, 0)} %` }),
    h("span", { class: isChosen ? "" : "quiet", text: isChosen ? "taken as the foot" : reason ?? "smaller than the one that is taken" }));
}

function feetWords(feet) {
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
      spots.replaceChildren(...answer.spots.map((spot, index) => spotWords(spot, index === answer.chosen)), ...(answer.more ? [h("li", { class: "quiet", text: `and ${answer.more} smaller` })] : []));
      feet.replaceChildren(...feetWords(answer.feet));
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
  let [foot, isOn, since, shows] = [0, false, null, "mask"];
  const found = findings();
  const colour = () => draft.state.setup.colours[foot];

  function change(patch, last) {
    since ??= performance.now();
    draft.change({ colours: draft.state.setup.colours.map((one, index) => (index === foot ? { ...one, ...patch } : one)) }, last);
    stage.refresh();
  }

  const buttons = footButtons((next) => { foot = next; show(); stage.refresh(); });
  const hue = hueRange("Foot", (range, last) => change({ hue: range }, last));
  const saturation = shareField("Least saturation", "How colourful a pixel must be; light and grey pixels have little", (value, last) => change({ saturation: value }, last));
  const value = shareField("Least brightness", "How bright a pixel must be; shade has little", (next, last) => change({ value: next }, last));
  const limits = limitFields((patch) => {
    since ??= performance.now();
    draft.change({ limits: { ...draft.state.setup.limits, ...patch } });
    stage.refresh();
  });
  const pick = h("button", { type: "button", text: "Pick colour", "aria-pressed": "false", title: "Then click on this foot in the picture" });
  const mask = h("button", { type: "button", text: "Mask", "aria-pressed": "true", title: "What has this colour stays lit, the rest is dim" });

  const aim = (next) => {
    pick.setAttribute("aria-pressed", String(next));
    stage.picture.element.toggleAttribute("data-aims", next);
    if (shows === "mask") mask.setAttribute("aria-pressed", String(!next));
    if (isOn) stage.refresh();
  };
  const aims = () => pick.getAttribute("aria-pressed") === "true";
  pick.addEventListener("click", () => aim(!aims()));
  mask.addEventListener("click", () => {
    shows = shows === "mask" ? "plain" : "mask";
    mask.setAttribute("aria-pressed", String(shows === "mask"));
    stage.refresh();
  });
  stage.picture.onClick((place) => {
    if (!isOn || !aims()) return;
    const range = rangeAt(stage.picture, place);
    if (!range) {
      toast("This place is grey, black or white: it has no hue to look for. Click on the foot's coloured sole.", { of: "studio" });
      return;
    }
    aim(false);
    change(range, true);
    announce(`Colour of foot ${foot + 1} taken.`);
  });

  async function fetching(frame) {
    const began = since ?? performance.now();
    const { setup } = draft.state;
    const answer = await look(stage.source, frame, { foot: foot + 1, colours: setup.colours, limits: setup.limits, shows: aims() ? "plain" : shows, setup: draft.state.answer.view ? setup : null, most: MOST_WIDTH });
    if (!isOn) return null;
    await stage.picture.show(answer.picture, answer.size);
    drawSpots(stage.picture.drawing, answer);
    found.show(answer, foot);
    since = null;
    requestAnimationFrame(() => performance.measure("colour to picture", { start: began, end: performance.now() }));
    return null;
  }

  function show() {
    const { setup } = draft.state;
    buttons.show(foot);
    hue.show(colour().hue);
    saturation.show(colour().saturation);
    value.show(colour().value);
    limits.show(setup.limits);
  }

  draft.watch(({ setup }) => [setup.colours, setup.limits], () => { if (isOn) show(); });
  return {
    element: h("div", { class: "camera-part" },
      h("p", { class: "quiet", text: "Which colour each foot has. Pick it in the picture, then look through the frames and widen or narrow it." }),
      h("div", { class: "camera-row" }, buttons.element, pick, mask), hue.element, saturation.element, value.element,
      h("details", {}, h("summary", { text: "Which spots may be a foot" }), limits.element), found.element),
    enter() {
      isOn = true;
      show();
      stage.fetches(fetching);
    },
    leave() {
      aim(false);
      isOn = false;
      stage.picture.drawing.replaceChildren();
      stage.fetches(null);
    },
  };
}
