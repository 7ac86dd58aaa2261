/** Requests for videos, cameras and camera setups. */

import { ApiError, request } from "./gaits.js";
import { authorHeaders } from "./author.js";

const at = (kind, id) => `/api/${kind}/${encodeURIComponent(id)}`;

function refusal({ status, responseText }) {
  try {
    const { error, where = null } = JSON.parse(responseText);
    if (error) return new ApiError(error, status, where);
  } catch {
    return new ApiError(`The page cannot read the studio's answer (status ${status}). Try again.`, status);
  }
  return new ApiError(`The studio refused the request and gave no reason (status ${status}).`, status);
}

/**
 * Sends a file as it is.
 * @param {string} path
 * @param {Blob} file
 * @param {{signal?: AbortSignal, progress?: (share: number) => void}} [options]
 * @returns {Promise<Record<string, any>>} the answer; null where it was cancelled
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

const parameters = (values) => new URLSearchParams(values).toString();

export const videoApi = {
  list: () => request("GET", "/api/videos"),
  ofRun: async (run) => (await request("GET", `/api/videos?${parameters({ run })}`)).videos,
  read: (id) => request("GET", at("videos", id)),
  remove: (id) => request("DELETE", at("videos", id)),
  restore: (id) => request("POST", `${at("videos", id)}/restore`),
  upload: (file, options) => sendFile(`/api/videos?${parameters({ name: file.name })}`, file, options),
  track: (id, body) => request("POST", `${at("videos", id)}/track`, body),
  boards: (id, body) => request("POST", `${at("videos", id)}/boards`, body),
};

export const setupApi = {
  list: () => request("GET", "/api/setups"),
  read: (id) => request("GET", at("setups", id)),
  add: (setup) => request("POST", "/api/setups", setup),
  change: (id, revision, setup) => request("PUT", at("setups", id), { revision, setup }),
  check: (setup) => request("POST", "/api/setups/check", setup),
  remove: (id) => request("DELETE", at("setups", id)),
  restore: (id) => request("POST", `${at("setups", id)}/restore`),
  exportPath: (id) => `${at("setups", id)}/export`,
  board: (file, columns, rows, signal) =>
    sendFile(`/api/boards?${parameters({ columns, rows, name: file.name })}`, file, { signal }),
  lens: (body) => request("POST", "/api/lens", body),
  straight: (lens, picture) => request("POST", "/api/lens/look", { lens, picture }),
};

export const cameraApi = {
  list: async () => (await request("GET", "/api/cameras")).cameras,
  change: (id, changes) => request("PUT", at("cameras", id), changes),
  board: (id, columns, rows) =>
    request("POST", `${at("cameras", id)}/board?${parameters({ columns, rows })}`),
};

/**
 * Where pictures come from: a kept video or a camera.
 * @typedef {{kind: "video"|"camera", id: string, name: string, frames: number, rate: number}} Source
 */

export const videoSource = ({ id, name, frames, rate }) => ({ kind: "video", id, name, frames, rate });
export const cameraSource = ({ id, name }) => ({ kind: "camera", id, name, frames: 0, rate: 0 });

const base = ({ kind, id }) => at(`${kind}s`, id);
const ofFrame = ({ kind }, frame) => (kind === "video" ? `?frame=${frame}` : "");

/** Looks at one picture of a source with a foot's colours. */
export const look = (source, frame, body, signal) =>
  request("POST", `${base(source)}/look${ofFrame(source, frame)}`, body, signal);

/** The address of one picture of a source; a camera's is another one each time. */
export const pictureOf = (source, frame) =>
  `${base(source)}/picture.jpg${source.kind === "video" ? `?frame=${frame}` : `?now=${Date.now()}`}`;

/** The address of a camera's moving picture. */
export const streamOf = (id, most, rate = 10) => `${at("cameras", id)}/stream?${parameters({ rate, most })}`;
