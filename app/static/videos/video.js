/** Trials from a video: send the file, choose or make a camera setup, track the feet, and open the trial. */

import { h } from "../lib/dom.js";
import { oneTabStop } from "../lib/tab_stop.js";
import { attempt, report } from "../lib/toasts.js";
import { openVideo } from "./video_page.js";
import { videoApi } from "../api/videos.js";
import { unreadableRow } from "../shell/storage_notice.js";
import { uploadField, videoRow } from "./video_rows.js";

const UPLOAD_HELP =
  "Choose a video that shows the robot from below, through a glass platform. "
  + "The studio finds the four coloured feet in every frame.";
const NONE_YET =
  "There is no video yet. The studio stores your videos and the camera recordings in its data folder.";

/**
 * Opens the videos in the trials' panel.
 * @param {Record<string, any>} page `store`, `show(content, onLeave)`, `begin()` tells later whether
 *   something else was asked for, `all` shows the list of trials, `one` a trial
 */
export const openVideos = attempt(async (page) => {
  const again = () => openVideos(page);
  const open = (video) => openVideo(page, video, { back: again }).catch(report);
  const isOld = page.begin();
  const { videos, unreadable } = await videoApi.list();
  if (isOld()) return;
  const upload = uploadField(open);
  const kept = videos.filter(({ state }) => state !== "removed");
  const list = h(
    "ul",
    { class: "run-list", role: "list", "aria-label": "Videos" },
    ...kept.map((video) => videoRow(video, { open, trial: page.one })),
    ...unreadable.map((entry) => unreadableRow(entry, again)),
  );
  oneTabStop(list);
  page.show(
    h(
      "div",
      { class: "trial-form" },
      h("button", { type: "button", class: "link", text: "All trials", on: { click: page.all } }),
      h("p", { class: "quiet", text: UPLOAD_HELP }),
      upload,
      h("h3", { text: "Videos" }),
      kept.length ? null : h("p", { class: "teach", text: NONE_YET }),
      list,
    ),
  );
});

/** Opens one video by its id. */
export const openVideoOf = attempt(async (page, id) => {
  const isOld = page.begin();
  const video = await videoApi.read(id);
  if (!isOld()) await openVideo(page, video, { back: () => openVideos(page) });
});
