/** Kept videos in a list, and a file on its way to the studio. */

import { durationText, sizeText } from "../cameras/camera_labels.js";
import { h, setText } from "../lib/dom.js";
import { clockTime, fixed } from "../lib/format.js";
import { report, toast } from "../lib/toasts.js";
import { videoApi } from "../api/videos.js";
import "../pictures/picture_style.js";

/**
 * A kept video as the server tells it.
 * @typedef {Object} Video
 * @property {string} id
 * @property {string} name
 * @property {string} kind
 * @property {string} state
 * @property {string} sentence
 * @property {string} camera
 * @property {string} run
 * @property {string} made
 * @property {number[]} size px
 * @property {number} rate
 * @property {number} frames
 * @property {number} seconds
 * @property {number} bytes
 * @property {{id: string, name: string}[]} trials
 */

/** Size, rate and length of a video. */
export const videoFacts = ({ size, rate, seconds, bytes }) =>
  `${size.join(" × ")} px · ${fixed(rate, 1)} frames/s · ${durationText(seconds)} · ${sizeText(bytes)}`;

const trialsText = ({ trials }) =>
  trials.length > 1 ? `has ${trials.length} trials` : trials.length ? "has a trial" : "";

/** A kept video in the list, with the ways to what was tracked in it. */
export function videoRow(video, { open, trial }) {
  const origin = video.kind === "recording" ? `recorded run, camera ${video.camera}` : "";
  const state = video.state === "kept" ? origin : video.state;
  const { trials } = video;
  const ways = trials.map(({ id, name }) =>
    h("button", {
      type: "button",
      class: "link",
      text: trials.length > 1 ? `Trial: ${name}` : "Open its trial",
      title: name,
      on: { click: () => trial(id) },
    }),
  );
  return h(
    "li",
    {},
    h(
      "button",
      {
        type: "button",
        class: "run-row",
        data: { video: video.id },
        title: video.sentence || "Track the feet in this video",
        on: { click: () => open(video) },
      },
      h(
        "span",
        { class: "run-line" },
        h("b", { text: video.name }),
        h("span", { text: durationText(video.seconds) }),
      ),
      h(
        "span",
        { class: "run-line quiet" },
        h("span", { text: [clockTime(video.made), state, trialsText(video)].filter(Boolean).join(" · ") }),
      ),
    ),
    ways.length ? h("div", { class: "video-trials" }, ...ways) : null,
  );
}

/** How much of a file is sent, with Cancel; hidden while none is. */
function uploadProgress(cancel) {
  const bar = h("i");
  const words = h("p", { class: "quiet number", role: "status" });
  const element = h(
    "div",
    { class: "video-going", hidden: true },
    h("div", { class: "progress" }, bar),
    words,
    h("button", { type: "button", text: "Cancel", "aria-label": "Cancel upload", on: { click: cancel } }),
  );
  return {
    element,
    show(share, size) {
      bar.style.transform = `scaleX(${share})`;
      setText(
        words,
        share < 1
          ? `${fixed(share * 100, 0)} % of ${sizeText(size)} sent`
          : "The upload is complete. The studio is reading the video…",
      );
    },
  };
}

const tellAgain = (file, { name, made }) =>
  toast(
    `The studio already has “${file.name}”. `
      + `The file has the same content as the video “${name}”, sent ${clockTime(made)}.`,
    { of: "studio" },
  );

/** A field for a file, which is sent when it is chosen, with its progress and Cancel. */
function buildUpload() {
  const file = h("input", {
    type: "file",
    accept: "video/*,.avi,.mkv,.mov,.mp4",
    "aria-label": "Video file",
  });
  const progress = uploadProgress(() => ending?.abort());
  const field = {
    element: h(
      "div",
      { class: "video-upload" },
      h("label", {}, h("span", { text: "Video file" }), file),
      progress.element,
    ),
    /** @type {(video: Video) => void} */
    done: () => {},
  };
  let ending = null;

  async function send() {
    const [chosen] = file.files;
    if (!chosen) return;
    ending = new AbortController();
    [progress.element.hidden, file.disabled] = [false, true];
    const show = (share) => progress.show(share, chosen.size);
    show(0);
    let video = null;
    try {
      video = await videoApi.upload(chosen, { signal: ending.signal, progress: show });
    } catch (error) {
      report(error);
    }
    ending = null;
    [progress.element.hidden, file.disabled, file.value] = [true, false, ""];
    if (video?.again) tellAgain(chosen, video);
    if (video && field.element.isConnected) field.done(video);
    else if (video) {
      const act = () => field.done(video);
      toast(`The video “${video.name}” is sent.`, { action: { label: "Track the feet", act } });
    }
  }

  file.addEventListener("change", send);
  return field;
}

let upload = null;

/**
 * The field for a video. A file goes on being sent where its panel is left, and is there when that is opened.
 * @param {(video: Video) => void} done
 * @returns {HTMLElement}
 */
export function uploadField(done) {
  upload ??= buildUpload();
  upload.done = done;
  return upload.element;
}
