/** Requests for videos, cameras and camera setups. */

import { ApiError, onEach, post, request } from "./gaits.js";
import { authorHeaders } from "./author.js";

/** @typedef {import("./gaits.js").Json} Json */

/** @type {(kind: string, id: string) => string} */
const at = (kind, id) => `/api/${kind}/${encodeURIComponent(id)}`;

const onVideo = onEach((id) => at("videos", id));
const onSetup = onEach((id) => at("setups", id));

/** @param {XMLHttpRequest} request */
function refusal({ status, responseText }) {
  try {
    const { error, where = null } = JSON.parse(responseText);
    if (error) return new ApiError(error, status, where);
  } catch {
    return new ApiError(`The page cannot read the studio's answer (status ${status}). Try again.`, status);
  }
  return new ApiError(`The studio refused the request and gave no reason (status ${status}).`, status);
}

/** @typedef {{signal?: AbortSignal, progress?: (share: number) => void}} Sending */

/**
 * Sends a file as it is.
 * @param {string} path
 * @param {Blob} file
 * @param {Sending} [options]
 * @returns {Promise<any>} the answer; null where it was cancelled
 */
function sendFile(path, file, { signal, progress = () => {} } = {}) {
  return new Promise((resolve, reject) => {
    const sending = new XMLHttpRequest();
    sending.open("POST", path);
    for (const [name, value] of Object.entries({
      ...authorHeaders(),
      "Content-Type": file.type || "application/octet-stream",
    }))
      sending.setRequestHeader(name, value);
    sending.upload.addEventListener("progress", ({ loaded, total }) => progress(total ? loaded / total : 0));
    sending.addEventListener("load", () =>
      sending.status < 300 ? resolve(JSON.parse(sending.responseText)) : reject(refusal(sending)),
    );
    const lost = "The upload failed. The studio does not answer, or it closed the connection.";
    sending.addEventListener("error", () => reject(new ApiError(lost, 0)));
    sending.addEventListener("abort", () => resolve(null));
    signal?.addEventListener("abort", () => sending.abort());
    sending.send(file);
  });
}

const parameters = (/** @type {Json} */ values) => new URLSearchParams(values).toString();

export const videoApi = {
  list: () => request("GET", "/api/videos"),
  /** @param {string} run */
  ofRun: async (run) => (await request("GET", `/api/videos?${parameters({ run })}`)).videos,
  read: onVideo("GET"),
  /** The time of each picture after the first, s. */
  times: async (/** @type {string} */ id) => (await request("GET", `${at("videos", id)}/times`)).times,
  remove: onVideo("DELETE"),
  restore: onVideo("POST", "/restore"),
  /** @type {(file: File, options?: Sending) => Promise<any>} */
  upload: (file, options) => sendFile(`/api/videos?${parameters({ name: file.name })}`, file, options),
  /** @type {(id: string, body: Json) => Promise<any>} */
  track: (id, body) => request("POST", `${at("videos", id)}/track`, body),
  /** @type {(id: string, body: Json) => Promise<any>} */
  boards: (id, body) => request("POST", `${at("videos", id)}/boards`, body),
};

export const setupApi = {
  list: () => request("GET", "/api/setups"),
  read: onSetup("GET"),
  add: post("/api/setups"),
  /** @type {(id: string, revision: number, setup: Json) => Promise<any>} */
  change: (id, revision, setup) => request("PUT", at("setups", id), { revision, setup }),
  check: post("/api/setups/check"),
  remove: onSetup("DELETE"),
  restore: onSetup("POST", "/restore"),
  /** @param {string} id */
  exportPath: (id) => `${at("setups", id)}/export`,
  /** @type {(file: File, columns: number, rows: number, signal?: AbortSignal) => Promise<any>} */
  board: (file, columns, rows, signal) =>
    sendFile(`/api/boards?${parameters({ columns, rows, name: file.name })}`, file, { signal }),
  lens: post("/api/lens"),
  /** @type {(lens: Json, picture: string) => Promise<any>} */
  straight: (lens, picture) => request("POST", "/api/lens/look", { lens, picture }),
};

export const cameraApi = {
  list: async () => (await request("GET", "/api/cameras")).cameras,
  /** @type {(id: string, changes: Json) => Promise<any>} */
  change: (id, changes) => request("PUT", at("cameras", id), changes),
  /** @type {(id: string, columns: number, rows: number) => Promise<any>} */
  board: (id, columns, rows) =>
    request("POST", `${at("cameras", id)}/board?${parameters({ columns, rows })}`),
};

/**
 * Where pictures come from: a kept video or a camera.
 * @typedef {{kind: "video"|"camera", id: string, name: string, frames: number}} Source
 */

/** @type {(video: Json) => Source} */
export const videoSource = ({ id, name, frames }) => ({ kind: "video", id, name, frames });
/** @type {(camera: Json) => Source} */
export const cameraSource = ({ id, name }) => ({ kind: "camera", id, name, frames: 0 });

const base = (/** @type {Source} */ { kind, id }) => at(`${kind}s`, id);
/** @type {(source: Source, frame: number) => string} */
const ofFrame = ({ kind }, frame) => (kind === "video" ? `?frame=${frame}` : "");

/**
 * Looks at one picture of a source with a foot's colours.
 * @type {(source: Source, frame: number, body: Json, signal?: AbortSignal) => Promise<any>}
 */
export const look = (source, frame, body, signal) =>
  request("POST", `${base(source)}/look${ofFrame(source, frame)}`, body, signal);

/**
 * The address of one picture of a source; a camera's is another one each time.
 * @type {(source: Source, frame: number) => string}
 */
export const pictureOf = (source, frame) =>
  `${base(source)}/picture.jpg${source.kind === "video" ? `?frame=${frame}` : `?now=${Date.now()}`}`;

/**
 * The address of a camera's moving picture.
 * @type {(id: string, most: number, rate?: number) => string}
 */
export const streamOf = (id, most, rate = 10) => `${at("cameras", id)}/stream?${parameters({ rate, most })}`;
