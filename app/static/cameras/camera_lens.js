/** The lens: pictures of a checkerboard, which show it, how well they agree, and the picture straightened. */

import {
  LEAST_CHECKERBOARDS,
  checkerboardBook,
  checkerboardRow,
  checkerboardSources,
} from "./camera_checkerboards.js";
import { h, onPress, setAllowed, setText } from "../lib/dom.js";
import { fixed } from "../lib/format.js";
import { announce, attempt } from "../lib/toasts.js";
import { pictureOf, setupApi } from "../api/videos.js";

const HELP =
  "A wide-angle lens bends straight lines in the picture. To correct the picture, add pictures of a "
  + "checkerboard at different places and angles. To skip the lens correction, open Place.";
const FIELD = { min: "3", max: "30", step: "1", required: true };
const SHARP_PX = 1;
const UNREADABLE = "The page cannot load the picture, so it does not show the straightened picture.";

function cornersField(name, value, changed) {
  const input = h("input", {
    type: "number",
    ...FIELD,
    value: String(value),
    "aria-label": name,
    title: "An inner corner is a point where four squares meet. A side with 9 squares has 8 inner corners",
  });
  input.addEventListener("change", () => {
    if (input.checkValidity()) changed(input.valueAsNumber);
  });
  return h("label", {}, h("span", { text: name }), input);
}

/** The fields of the board's corners; other corners need other pictures. */
const cornerFields = (book) =>
  Object.entries({ columns: "Inner corners, one side", rows: "Inner corners, other side" }).map(
    ([key, name]) =>
      cornersField(name, book.corners[key], (count) => {
        book.corners[key] = count;
        book.clear();
      }),
  );

/** What is missing where pictures are too few; null where they are enough, or none was taken yet. */
function lackText(boards) {
  const count = boards.filter(({ found }) => found).length;
  if (!boards.length || count >= LEAST_CHECKERBOARDS) return null;
  return (
    `The checkerboard was found in ${count} of ${boards.length} pictures. `
    + `At least ${LEAST_CHECKERBOARDS} pictures must show the whole checkerboard, flat and sharp.`
  );
}

function lensText({ lens }) {
  if (!lens)
    return (
      "There is no lens correction. "
      + "You need a lens correction if straight lines look bent in the picture."
    );
  if (lens.rms_px === null) return "The error of this lens correction is not known.";
  const from = lens.boards ? ` The lens correction is computed from ${lens.boards} pictures.` : "";
  const advice =
    lens.rms_px > SHARP_PX
      ? ` An error above ${SHARP_PX} px is large. Take sharper pictures of a flat checkerboard.`
      : "";
  return `The RMS error of the lens correction is ${fixed(lens.rms_px, 2)} px.${from}${advice}`;
}

/** A picture's address as one that can be sent back: the server straightens it. */
async function dataOf(address) {
  const response = await fetch(address);
  if (!response.ok) throw new Error(UNREADABLE);
  const blob = await response.blob();
  return new Promise((resolve, reject) => {
    const reader = new FileReader();
    reader.addEventListener("load", () => resolve(reader.result));
    reader.addEventListener("error", () => reject(new Error(UNREADABLE)));
    reader.readAsDataURL(blob);
  });
}

/** The switch that straightens what is shown. */
function straightening(draft, stage) {
  const button = h("button", { type: "button", text: "Straighten the picture", "aria-pressed": "false" });
  const isOn = () => button.getAttribute("aria-pressed") === "true";
  const turn = (on) => {
    button.setAttribute("aria-pressed", String(on));
    stage.refresh();
  };
  onPress(button, () => turn(!isOn()));
  return {
    button,
    /** A picture as the lens would have it, where that is wanted. */
    async of(plain) {
      if (!isOn()) return plain;
      return (
        await setupApi.straight(
          draft.state.setup.lens,
          plain.startsWith("data:") ? plain : await dataOf(plain),
        )
      ).picture;
    },
    show({ lens }) {
      const why = lens ? null : "There is no lens correction yet. Add pictures of a checkerboard first.";
      setAllowed(button, why, "Corrects the picture, so that straight lines look straight");
      if (!lens && isOn()) turn(false);
    },
    end: () => button.setAttribute("aria-pressed", "false"),
  };
}

const removeButton = (draft) =>
  h("button", {
    type: "button",
    class: "link",
    text: "Remove the lens correction",
    on: { click: () => draft.change({ lens: null }) },
  });

/** The searched pictures; one that is chosen is shown until the stage goes to another frame. */
function boardList(book, stage) {
  let chosen = null;
  const element = h("ul", { class: "camera-boards", "aria-label": "Pictures searched for the checkerboard" });
  const actions = {
    remove: attempt((board) => book.remove(board)),
    show: (board) => {
      chosen = { board, frame: stage.frame };
      stage.refresh();
    },
  };
  return {
    element,
    fill: () =>
      element.replaceChildren(
        ...book.boards.map((board) => checkerboardRow(board, book.rmsOf(board), actions)),
      ),
    addressAt(frame) {
      if (chosen?.frame !== frame) chosen = null;
      return chosen?.board.picture ?? pictureOf(stage.source, frame);
    },
    forget() {
      chosen = null;
    },
  };
}

/**
 * Builds the part.
 * @param {Record<string, any>} draft of `setupDraft`
 * @param {Record<string, any>} stage of `openStage`
 * @returns {{element: HTMLElement, enter: () => void, leave: () => void}}
 */
export function lensPart(draft, stage) {
  let isOn = false;
  const [status, words] = [1, 2].map(() => h("p", { class: "quiet", role: "status" }));
  const straight = straightening(draft, stage);
  const without = removeButton(draft);
  const book = checkerboardBook({
    changed: showCheckerboards,
    found: ({ lens, size }) => {
      draft.change({ lens, size });
      announce(lensText({ lens }));
    },
  });
  const list = boardList(book, stage);

  function showCheckerboards() {
    list.fill();
    const lack = lackText(book.boards);
    if (lack) setText(words, lack);
    else showLens();
  }

  function showLens() {
    const { setup } = draft.state;
    setText(words, lensText(setup));
    straight.show(setup);
    without.hidden = !setup.lens;
  }

  function show() {
    showCheckerboards();
    showLens();
  }

  draft.watch(
    ({ setup }) => [setup.lens],
    () => {
      if (isOn) show();
    },
  );
  return {
    element: h(
      "div",
      { class: "camera-part" },
      h("p", { class: "quiet", text: HELP }),
      ...cornerFields(book),
      checkerboardSources(stage, book, status),
      status,
      list.element,
      words,
      h("div", { class: "camera-row" }, straight.button, without),
    ),
    enter() {
      isOn = true;
      show();
      stage.fetches((frame) => straight.of(list.addressAt(frame)));
    },
    leave() {
      isOn = false;
      list.forget();
      straight.end();
      stage.fetches(null);
    },
  };
}
