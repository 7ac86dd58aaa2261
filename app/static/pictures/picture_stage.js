/** A large picture instead of the 3D preview and the timeline: of a kept video's frames, or of a camera. */

import { h, setText } from "../lib/dom.js";
import { fixed } from "../lib/format.js";
import { latestOnly } from "../lib/latest_only.js";
import { pictureView } from "./picture_view.js";
import { report } from "../lib/toasts.js";
import { pictureOf, videoApi } from "../api/videos.js";
import "./picture_style.js";

const LIVE_MS = 250;
const RETRY_MS = 1000;
const MOST_RETRY_MS = 10000;

function frameSlider(moved) {
  const range = h("input", { type: "range", min: "0", step: "1", value: "0", "aria-label": "Frame" });
  const number = h("input", {
    type: "number",
    min: "0",
    step: "1",
    value: "0",
    "aria-label": "Frame number",
  });
  const words = h("span", { class: "quiet number" });
  const element = h("div", { class: "video-frames" }, range, number, words);
  /** @type {number[]} */
  let times = [];
  const show = (frame) => {
    range.value = number.value = String(frame);
    const seconds = frame in times ? `${fixed(times[frame], 2)} s` : "";
    range.setAttribute("aria-valuetext", [`frame ${frame}`, seconds].filter(Boolean).join(", "));
    setText(words, [`of ${Number(range.max) + 1}`, seconds].filter(Boolean).join(" · "));
  };
  const take = (input) => () => {
    const frame = Math.round(Math.min(Math.max(input.valueAsNumber || 0, 0), Number(range.max)));
    show(frame);
    moved(frame);
  };
  range.addEventListener("input", take(range));
  number.addEventListener("change", take(number));
  return {
    element,
    /** @param {Record<string, any>} source */
    open({ kind, frames }, frame) {
      element.hidden = kind !== "video";
      range.max = number.max = String(Math.max(frames - 1, 0));
      show(Math.min(frame, Number(range.max)));
    },
    /** @param {number[]} ofPictures s, the time of each picture after the first */
    time(ofPictures) {
      times = ofPictures;
      show(Number(range.value));
    },
    get frame() {
      return Number(range.value);
    },
  };
}

/** The section on the page; `tell` says why its picture is not a current one, or null. */
function stageSection(name, slider, picture) {
  const note = h("span", { class: "quiet", role: "status", text: "Waiting for the picture…" });
  const element = h(
    "section",
    { class: "video-stage", "aria-label": "Picture", data: { keys: "" } },
    h("header", {}, h("b", { text: name }), note, slider),
    picture,
  );
  document.querySelector("section.stage").append(element);
  document.body.toggleAttribute("data-video", true);
  return {
    tell(why) {
      setText(note, why ?? "");
      note.dataset.toneText = why === null ? "" : "caution";
      note.title = why ?? "";
      element.toggleAttribute("data-gone", why !== null);
    },
    remove() {
      element.remove();
      document.body.toggleAttribute("data-video", document.querySelector(".video-stage") !== null);
    },
  };
}

/**
 * Opens the picture.
 * @param {import("../api/videos.js").Source} source
 * @param {number} [frame] that is shown first
 * @param {(why: string|null) => void} [lost] gets why there is no current picture, null when there is again
 * @returns {Record<string, any>} `picture` of `pictureView`; `frame`; `fetches(act)`: another way to a
 *   picture, `act(frame)` gives a blob, an address or null where it is out of date; `away(why)`: the server's
 *   reason if a camera is gone, or null; `refresh()`; `close()`; `source`
 */
export function openStage(source, frame = 0, lost = () => {}) {
  const picture = pictureView(`Picture of ${source.name}`);
  const plain = (number) => pictureOf(source, number);
  let [fetching, timer, closed, retry] = [plain, 0, false, RETRY_MS];
  let [reason, failed, shown] = [null, null, null];

  /** An old picture must not look like one of now. */
  function standing() {
    const why = reason ?? failed;
    section.tell(why);
    if (why === shown) return;
    shown = why;
    lost(why);
  }

  const offer = latestOnly(async (number) => {
    if (closed) return;
    try {
      const next = await fetching(number);
      if (next !== null && !closed) await picture.show(next);
      failed = null;
    } catch (error) {
      failed = error.message;
    }
    if (closed) return;
    standing();
    if (source.kind !== "camera") return;
    clearTimeout(timer);
    timer = setTimeout(() => offer(0), failed === null ? LIVE_MS : retry);
    retry = failed === null ? RETRY_MS : Math.min(2 * retry, MOST_RETRY_MS);
  });
  const slider = frameSlider(offer);
  slider.open(source, frame);
  if (source.kind === "video") videoApi.times(source.id).then(slider.time).catch(report);
  const section = stageSection(source.name, slider.element, picture.element);
  offer(slider.frame);

  return {
    picture,
    source,
    get frame() {
      return slider.frame;
    },
    get isAway() {
      return reason !== null;
    },
    fetches(act) {
      fetching = act ?? plain;
      offer(slider.frame);
    },
    refresh: () => offer(slider.frame),
    away(why) {
      if (why === reason) return;
      reason = why;
      standing();
      if (why === null) offer(0);
    },
    close() {
      closed = true;
      clearTimeout(timer);
      section.remove();
    },
  };
}
