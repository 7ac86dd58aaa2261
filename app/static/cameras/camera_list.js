/** The server's cameras: what each sees, its setup, whether it records with the run, and its live picture. */

import { drawFeet } from "./camera_overlay.js";
import { FOOT_NAMES, USES, cameraTone, cameraLabel } from "./camera_labels.js";
import { toggleFloat } from "./camera_float.js";
import { newSetup, openSetup } from "./camera_setup.js";
import { h, setText } from "../lib/dom.js";
import { fixed } from "../lib/format.js";
import { attempt } from "../lib/toasts.js";
import { cameraApi, cameraSource, look, setupApi } from "../api/videos.js";
import { openStage } from "../pictures/picture_stage.js";
import "../pictures/picture_style.js";

const LOOK_WIDTH = 1280;
const HELP =
  "Plug in a camera. To use a video file instead, start the studio with the option --camera NAME=FILE.";

/** Puts a camera that the server sent into the page's state. */
function accept(store, camera) {
  store.set({ cameras: (store.state.cameras ?? []).map((one) => (one.id === camera.id ? camera : one)) });
}

const LABELS = {
  use: {
    name: "seen",
    title:
      "Where the camera is. With a camera under the platform, the studio tracks the feet. "
      + "With a camera at the side, the studio only shows and records the picture",
  },
  setup: {
    name: "setup",
    title:
      "The setup of this camera: the lens correction, the place of the "
      + "platform in the picture and the colours of the feet",
  },
  records: {
    name: "record each run",
    title:
      "Records a video of each run. If the camera is under the platform, "
      + "the studio makes a trial from the video",
  },
};

/** The fields of what can be changed of a camera; `change` gets what is new. */
function cameraFields(change) {
  const use = h(
    "select",
    { title: LABELS.use.title },
    ...USES.map(([value, text]) => h("option", { value, text })),
  );
  const setup = h("select", { title: LABELS.setup.title });
  const records = h("input", { type: "checkbox", role: "switch" });
  use.addEventListener("change", () => change({ use: use.value }));
  setup.addEventListener("change", () => change({ setup: setup.value }));
  records.addEventListener("change", () => change({ records: records.checked }));
  const setupLine = h("label", {}, h("span", { text: "Setup" }), setup);

  /** Keeps an open choice as it is while the setups are the same. */
  function fillSetups(setups) {
    const options = [["", "none yet"], ...setups.map((one) => [one.id, one.setup.name])];
    if (setup.dataset.options === JSON.stringify(options)) return;
    setup.dataset.options = JSON.stringify(options);
    setup.replaceChildren(...options.map(([value, text]) => h("option", { value, text })));
  }
  return {
    elements: [
      h("label", {}, h("span", { text: "Seen" }), use),
      setupLine,
      h("label", { class: "tick", title: LABELS.records.title }, records, "Record each run"),
    ],
    show(camera, setups) {
      for (const [key, field] of Object.entries({ use, setup, records }))
        field.setAttribute("aria-label", `${camera.name}, ${LABELS[key].name}`);
      fillSetups(setups);
      [use.value, setup.value, records.checked] = [camera.use, camera.setup, camera.records];
      setupLine.hidden = camera.use !== "under";
    },
  };
}

/** The buttons that lead to a camera's picture and setup. */
function cameraButtons({ watch, float, setUp }) {
  const button = (text, title, act) =>
    h("button", { type: "button", class: "link", text, title, on: { click: act } });
  const looking = button("Look", "Shows the live picture and marks the feet that the studio finds", watch);
  const floating = button("Beside the scene", "Shows the live picture in a corner of the 3D scene", float);
  const adjust = button(
    "Set up…",
    "Opens the live picture of the camera. There you set the lens correction, "
      + "the place of the platform and the colours of the feet",
    setUp,
  );
  return {
    element: h("div", { class: "camera-row" }, looking, floating, adjust),
    show({ state, use }) {
      const isGone = state === "unplugged";
      [looking.hidden, floating.hidden, adjust.hidden] = [isGone, isGone, isGone || use !== "under"];
    },
  };
}

/** One camera's line; it is changed in place, so that what is focused stays so. */
function cameraRow(store, id, { watch, setUp }) {
  const now = () => store.state.cameras.find((camera) => camera.id === id);
  const fields = cameraFields(
    attempt(async (changes) => {
      try {
        accept(store, await cameraApi.change(id, changes));
      } finally {
        show(now(), store.state.setups ?? []);
      }
    }),
  );
  const buttons = cameraButtons({
    watch: () => watch(now()),
    float: () => toggleFloat(store, id),
    setUp: () => setUp(now()),
  });
  const dot = h("span", { class: "dot" });
  const name = h("b");
  const word = h("span", { class: "word" });
  const sentence = h("p", { class: "why" });
  const line = h("div", { class: "run-line" }, dot, name, word);
  const element = h("li", { class: "camera" }, line, sentence, ...fields.elements, buttons.element);

  function show(camera, setups) {
    dot.dataset.tone = cameraTone(camera);
    setText(name, camera.name);
    element.setAttribute("aria-label", camera.name);
    setText(word, cameraLabel(camera));
    setText(sentence, camera.state === "unplugged" ? camera.sentence : "");
    fields.show(camera, setups);
    buttons.show(camera);
  }
  return { element, show };
}

/**
 * Builds the list; it follows the server's events.
 * @param {import("../state/store.js").Store} store
 * @param {{watch: (camera: Record<string, any>) => void, setUp: (camera: Record<string, any>) => void}}
 *   actions
 */
export function cameraList(store, actions) {
  const list = h("ul", { class: "camera-list", role: "list", "aria-label": "Cameras" });
  const empty = h("p", { class: "teach", text: `The studio has no camera. ${HELP}`, hidden: true });
  const rows = new Map();

  store.watch(
    ({ cameras, setups }) => [cameras, setups],
    ({ cameras, setups }) => {
      if (!cameras) return;
      empty.hidden = cameras.length > 0;
      for (const [id, row] of rows)
        if (!cameras.some((camera) => camera.id === id)) {
          row.element.remove();
          rows.delete(id);
        }
      cameras.forEach((camera) => {
        if (!rows.has(camera.id)) {
          rows.set(camera.id, cameraRow(store, camera.id, actions));
          list.append(rows.get(camera.id).element);
        }
        rows.get(camera.id).show(camera, setups ?? []);
      });
    },
  );
  return {
    element: h("div", { class: "cameras" }, list, empty),
    refresh: attempt(async () => {
      const [cameras, { setups }] = await Promise.all([cameraApi.list(), setupApi.list()]);
      store.set({ cameras, setups });
    }),
  };
}

/** Opens a camera's setup on its live picture; a camera without one gets a new one. */
export const setUpCamera = attempt(async (page, camera) => {
  const isOld = page.begin();
  const answer = camera.setup ? await setupApi.read(camera.setup) : await newSetup();
  if (!camera.setup) accept(page.store, await cameraApi.change(camera.id, { setup: answer.id }));
  if (isOld()) return;
  openSetup(page, {
    answer,
    source: cameraSource(camera),
    back: { text: "Cameras", act: () => openCameras(page) },
  });
});

function feetList() {
  const rows = FOOT_NAMES.map((name, index) => ({ words: h("span", { class: "number" }), name, index }));
  return {
    element: h(
      "ul",
      { class: "camera-feet", "aria-label": "Feet in this picture" },
      ...rows.map(({ words, name, index }) =>
        h(
          "li",
          { data: { foot: index + 1 } },
          h("i", { class: "foot-dot", "aria-hidden": "true" }),
          h("span", { text: name }),
          words,
        ),
      ),
    ),
    show: (feet) =>
      rows.forEach(({ words }, index) =>
        setText(
          words,
          feet === null
            ? ""
            : !feet[index]
              ? "not seen"
              : feet[index].place_cm
                ? `${fixed(feet[index].place_cm[0], 1)}, ${fixed(feet[index].place_cm[1], 1)} cm`
                : "seen",
        ),
      ),
  };
}

/** The sentence under a live picture. */
const standingText = ({ use, setup }) =>
  use === "under" && !setup
    ? "This camera has no setup, so the studio cannot find the feet."
    : "This is the live picture of the camera.";

/** Opens a camera's live picture; of one under the platform with the feet that are found. */
export const watchCamera = attempt(async (page, camera) => {
  const isOld = page.begin();
  const kept = camera.use === "under" && camera.setup ? await setupApi.read(camera.setup) : null;
  if (isOld()) return;
  const [feet, words] = [feetList(), h("p")];
  const stage = openStage(cameraSource(camera), 0, lost);
  let newest = camera;

  function lost(why) {
    words.className = why === null ? "quiet" : "why";
    words.dataset.toneText = why === null ? "" : "caution";
    setText(words, why ?? standingText(newest));
    if (why === null) return;
    stage.picture.drawing.replaceChildren();
    feet.show(null);
  }
  lost(null);
  const end = page.store.watch(
    ({ cameras }) => [cameras],
    ({ cameras }) => {
      newest = cameras?.find(({ id }) => id === camera.id) ?? newest;
      stage.away(newest.state === "unplugged" ? newest.sentence : null);
      // Its use may have been changed just before.
      if (words.className === "quiet") setText(words, standingText(newest));
    },
  );
  if (kept) {
    const { setup, view } = kept;
    stage.fetches(async () => {
      const answer = await look(stage.source, 0, {
        foot: null,
        colours: setup.colours,
        limits: setup.limits,
        shows: "plain",
        setup: view ? setup : null,
        most: LOOK_WIDTH,
      });
      await stage.picture.show(answer.picture, answer.size);
      if (stage.isAway) return null;
      drawFeet(stage.picture.drawing, answer.feet);
      feet.show(answer.feet);
      return null;
    });
  } else feet.element.hidden = true;
  page.show(
    h(
      "div",
      { class: "trial-form" },
      h("button", { type: "button", class: "link", text: "Cameras", on: { click: () => openCameras(page) } }),
      h("div", { class: "run-line run-title" }, h("b", { text: camera.name })),
      words,
      feet.element,
    ),
    () => {
      end();
      stage.close();
    },
  );
});

/** Opens the cameras in the trials' panel. */
export function openCameras(page) {
  page.begin();
  const list = cameraList(page.store, {
    watch: (camera) => watchCamera(page, camera),
    setUp: (camera) => setUpCamera(page, camera),
  });
  page.show(
    h(
      "div",
      { class: "trial-form" },
      h("button", { type: "button", class: "link", text: "All trials", on: { click: page.all } }),
      h("h3", { text: "Cameras" }),
      list.element,
    ),
  );
  list.refresh();
}
