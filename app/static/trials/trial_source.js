/** The source of a trial's track: the video, the camera and its setup, with remarks. */

import { h } from "../lib/dom.js";

const stretches = (count, what) => (count ? `${count} ${count === 1 ? "time" : "times"} ${what}` : null);

/** How often a foot was out of sight, and how often something else was taken for it. */
function sights({ unseen, false: wrong }) {
  const words = [stretches(unseen.length, "a foot was not seen"), stretches(wrong.length, "something else was taken for a foot")].filter(Boolean);
  return words.length ? `${words.join(", ")}; these places are filled by straight lines and marked.` : null;
}

/**
 * Builds the lines; nothing for tracks out of files.
 * @param {object} trial
 * @param {(video: string) => void} open a video
 */
export function sourcePart(trial, open) {
  const { source, remarks, plan } = trial;
  const doubts = [...remarks, source ? sights(trial) : null, plan && !plan.fits ? plan.fit_sentence : null, plan?.astray_sentence].filter(Boolean);
  if (!source && !doubts.length) return null;
  const video = source?.video && h("button", { class: "link", text: source.camera ? `Recording of ${source.camera}` : "Its video", title: "The frames that the feet were found in", on: { click: () => open(source.video) } });
  return h("div", { class: "trial-source" },
    source && h("p", { class: "quiet" }, video, video && " · ", `tracked with “${source.setup_name}”, version ${source.setup_revision}`),
    ...doubts.map((text) => h("p", { class: "why", data: { toneText: "caution" }, text })));
}
