/** Pictures of a checkerboard from files, video frames or a camera, and the lens that is fitted to them. */

import { h, setText } from "../lib/dom.js";
import { fixed } from "../lib/format.js";
import { attempt } from "../lib/toasts.js";
import { cameraApi, setupApi, videoApi } from "../api/videos.js";

export const LEAST_CHECKERBOARDS = 3;

/** One picture of the board: whether it was found, and how far the lens leaves it off. */
export function checkerboardRow(board, rms, { remove, show }) {
  const words = board.found
    ? rms === undefined || rms === null
      ? "found"
      : `${fixed(rms, 2)} px`
    : "not found";
  const picture = board.picture ? h("img", { src: board.picture, alt: "" }) : h("i");
  return h(
    "li",
    { data: { found: board.found } },
    h(
      "button",
      {
        type: "button",
        class: "plain",
        title: "Show this picture",
        "aria-label": `Show ${board.name}`,
        on: { click: () => show(board) },
      },
      picture,
    ),
    h("span", { class: "camera-board-name", text: board.name }),
    h("span", { class: board.found ? "number" : "number why", text: words }),
    h("button", {
      type: "button",
      class: "link",
      text: "Remove",
      "aria-label": `Remove ${board.name}`,
      on: { click: () => remove(board) },
    }),
  );
}

/** The pictures of the board that were taken or chosen, each once, and the lens that follows from them. */
export function checkerboardBook({ changed, found }) {
  let [boards, figures] = [[], new Map()];
  let number = 0;
  const corners = { columns: 8, rows: 5 };

  async function compute() {
    const request = ++number;
    figures = new Map();
    changed();
    if (boards.filter((board) => board.found).length < LEAST_CHECKERBOARDS) return;
    const answer = await setupApi.lens({
      ...corners,
      boards: boards.map(({ picture: _, ...board }) => board),
    });
    if (request !== number) return;
    answer.boards.forEach(({ rms_px: rms }, index) => figures.set(boards[index], rms));
    found(answer);
    changed();
  }

  return {
    get boards() {
      return boards;
    },
    corners,
    rmsOf: (board) => figures.get(board),
    async add(next) {
      const names = new Set(next.map(({ name }) => name));
      boards = [...boards.filter(({ name }) => !names.has(name)), ...next];
      await compute();
    },
    async remove(board) {
      boards = boards.filter((one) => one !== board);
      await compute();
    },
    clear() {
      number += 1;
      boards = [];
      changed();
    },
  };
}

/** Runs one search for the board at a time; `stop` is the button that ends it. */
function boardSearch(status) {
  let ending = null;
  const stop = h("button", { type: "button", class: "link", text: "Cancel", hidden: true });
  stop.addEventListener("click", () => ending?.abort());
  const starting = (act) =>
    attempt(async () => {
      if (ending) return;
      ending = new AbortController();
      stop.hidden = false;
      setText(status, "Looking for the checkerboard…");
      try {
        await act(ending.signal);
      } finally {
        ending = null;
        stop.hidden = true;
        setText(status, "");
      }
    });
  return { stop, starting };
}

async function searchFiles(files, book, status, signal) {
  for (const [index, file] of files.entries()) {
    setText(status, `Looking for the checkerboard: picture ${index + 1} of ${files.length}…`);
    const { columns, rows } = book.corners;
    const board = await setupApi.board(file, columns, rows, signal);
    if (board === null || signal.aborted) break;
    await book.add([board]);
  }
}

/** Searches frames that are spread over the video, as many in a request as the studio answers at once. */
async function searchVideo(video, book, status, signal) {
  let [frames, looked] = [null, 0];
  do {
    const { boards, left } = await videoApi.boards(video, { ...book.corners, frames });
    if (signal.aborted) break;
    await book.add(boards);
    [frames, looked] = [left, looked + boards.length];
    if (left.length)
      setText(status, `Looking for the checkerboard: picture ${looked + 1} of ${looked + left.length}…`);
  } while (frames.length);
}

/** The boards in the picture that is shown. */
async function shownBoards({ source, frame }, { columns, rows }) {
  if (source.kind !== "video") return [await cameraApi.board(source.id, columns, rows)];
  return (await videoApi.boards(source.id, { columns, rows, frames: [frame] })).boards;
}

/** Ways to pictures of the board: files, frames of the shown video, what the camera sees. */
export function checkerboardSources(stage, book, status) {
  const { source } = stage;
  const isVideo = source.kind === "video";
  const search = boardSearch(status);
  const files = h("input", {
    type: "file",
    multiple: true,
    accept: "image/*",
    "aria-label": "Pictures of the checkerboard",
  });
  files.addEventListener(
    "change",
    search.starting(async (signal) => {
      await searchFiles([...files.files], book, status, signal);
      files.value = "";
    }),
  );
  const spread = h("button", {
    type: "button",
    text: "Frames of this video",
    title: "Looks for the checkerboard in 24 frames, spread evenly over the video",
    hidden: !isVideo,
    on: { click: search.starting((signal) => searchVideo(source.id, book, status, signal)) },
  });
  const one = h("button", {
    type: "button",
    text: isVideo ? "The shown frame" : "The picture now",
    title: "Looks for the checkerboard in the picture that is shown",
    on: { click: search.starting(async () => book.add(await shownBoards(stage, book.corners))) },
  });
  return h(
    "div",
    { class: "camera-sources" },
    h("label", {}, h("span", { text: "Pictures" }), files),
    h("div", { class: "camera-row" }, spread, one, search.stop),
  );
}
