/** HTTP requests. Every refusal becomes an ApiError with a message for people. */

import { authorHeaders } from "./author.js";

/**
 * What goes to the studio or comes from it.
 * @typedef {Record<string, any>} Json
 * @typedef {(line: any) => void} Told takes a line of an answer
 * @typedef {{label: string, number: string}} Edit
 */

/** Status of a change that somebody else's came before. */
export const CONFLICT = 409;

export class ApiError extends Error {
  /**
   * @param {string} message sentence for the user
   * @param {number} status HTTP status, 0 where the server did not answer
   * @param {string|null} where field or place, if the server named one
   */
  constructor(message, status, where = null) {
    super(message);
    this.status = status;
    this.where = where;
  }
}

/** @param {Response} response */
async function refusal(response) {
  try {
    const body = await response.json();
    if (body.error) return new ApiError(body.error, response.status, body.where ?? null);
    if (body.detail)
      return new ApiError(
        typeof body.detail === "string" ? body.detail : JSON.stringify(body.detail),
        response.status,
      );
  } catch {
    const unreadable = `The page cannot read the studio's answer (status ${response.status}). Try again.`;
    return new ApiError(unreadable, response.status);
  }
  const unexplained = `The studio refused the request and gave no reason (status ${response.status}).`;
  return new ApiError(unexplained, response.status);
}

/**
 * @param {string} method
 * @param {string} path
 * @param {Json} [body]
 * @param {AbortSignal} [signal]
 */
async function answer(method, path, body, signal) {
  let response;
  try {
    response = await fetch(path, {
      method,
      headers: { ...authorHeaders(), ...(body === undefined ? {} : { "Content-Type": "application/json" }) },
      body: body === undefined ? undefined : JSON.stringify(body),
      signal,
    });
  } catch {
    throw new ApiError("The studio does not answer. Check that the studio is still running.", 0);
  }
  if (!response.ok) throw await refusal(response);
  return response;
}

/** @type {(method: string, path: string, body?: Json, signal?: AbortSignal) => Promise<any>} */
export const request = async (method, path, body, signal) =>
  (await answer(method, path, body, signal)).json();

/** @type {(method: string, path: string, body?: Json) => Promise<ArrayBuffer>} */
export const bytes = async (method, path, body) => (await answer(method, path, body)).arrayBuffer();

/**
 * Makes requests about one thing of a kind, known by its id.
 * @param {(id: string) => string} address
 */
export const onEach =
  (address) =>
  (/** @type {string} */ method, path = "") =>
  (/** @type {string} */ id) =>
    request(method, `${address(id)}${path}`);

/**
 * Makes a request that sends a body.
 * @param {string} path
 */
export const post = (path) => (/** @type {Json} */ body) => request("POST", path, body);

/**
 * Sends text or a file unchanged, such as a CSV or JSON file or a picture.
 * @param {string} path
 * @param {BodyInit} body
 * @param {string} [type]
 * @returns {Promise<any>}
 */
export async function sendFile(path, body, type = "text/plain") {
  const response = await fetch(path, {
    method: "POST",
    body,
    headers: { ...authorHeaders(), "Content-Type": type },
  });
  if (!response.ok) throw await refusal(response);
  return response.json();
}

/**
 * A file that the server makes: its name and its bytes.
 * @param {string} path
 */
async function download(path) {
  const response = await answer("GET", path);
  const name = /filename="([^"]*)"/.exec(response.headers.get("content-disposition") ?? "")?.[1] ?? "gait";
  return { name, blob: await response.blob() };
}

/**
 * Passes on each line of JSON as it comes.
 * @param {ReadableStream<Uint8Array<ArrayBuffer>>} body
 * @param {Told} told
 */
async function linesOf(body, told) {
  const reader = body.pipeThrough(new TextDecoderStream()).getReader();
  let rest = "";
  for (;;) {
    const { done, value } = await reader.read();
    if (done) return;
    const lines = (rest + value).split("\n");
    rest = lines.pop() ?? "";
    lines.forEach((line) => told(JSON.parse(line)));
  }
}

/**
 * Sends a question and passes on each line of the answer as it comes.
 * @type {(path: string, body: Json|undefined, signal: AbortSignal|undefined, told: Told) => Promise<void>}
 */
export const streamed = async (path, body, signal, told) => {
  const response = await answer("POST", path, body, signal);
  if (response.body) await linesOf(response.body, told);
};

const gait = (/** @type {string} */ id) => `/api/gaits/${encodeURIComponent(id)}`;
const runAddress = (/** @type {string} */ id) => `/api/runs/${encodeURIComponent(id)}`;
const jobAddress = (/** @type {string} */ id) => `/api/jobs/${encodeURIComponent(id)}`;
const simulationAddress = (/** @type {string} */ key) => `/api/simulations/${encodeURIComponent(key)}`;

const onGait = onEach(gait);
const onRun = onEach(runAddress);
const onPattern = onEach((id) => `/api/patterns/${id}`);

/**
 * Makes a request that sends a body about one gait.
 * @param {string} path
 * @returns {(id: string, body: Json) => Promise<any>}
 */
const toGait = (path) => (id, body) => request("POST", `${gait(id)}${path}`, body);

export const api = {
  view: onGait("GET", "/view"),
  document: onGait("GET"),
  /** @type {(id: string, document: Json, edit: Edit, revision: number) => Promise<any>} */
  put: (id, document, { label, number }, revision) =>
    request(
      "PUT",
      `${gait(id)}?label=${encodeURIComponent(label)}&revision=${revision}&edit=${number}`,
      document,
    ),
  redraw: toGait("/redraw"),
  /** @type {(id: string, verb: string) => Promise<any>} */
  history: (id, verb) => request("POST", `${gait(id)}/${verb}`),
  /** @type {(id: string, name: string) => Promise<any>} */
  copy: (id, name) =>
    request("POST", `/api/gaits?copy_of=${encodeURIComponent(id)}&name=${encodeURIComponent(name)}`),
  /** @type {(body: BodyInit, file: string) => Promise<any>} */
  importFile: (body, file) => sendFile(`/api/gaits/import?file=${encodeURIComponent(file)}`, body),
  /** @type {(id: string, form: string) => Promise<{name: string, blob: Blob}>} */
  exportFile: (id, form) => download(`${gait(id)}/export/${form}`),
  robots: () => request("GET", "/api/robots"),
  draw: post("/api/gaits/drawn"),
  sequence: post("/api/sequences"),
  /** @type {(id: string, part: number|null, resample: boolean) => Promise<any>} */
  refreshSequence: (id, part, resample) =>
    request(
      "POST",
      `${gait(id)}/sequence/refresh?resample=${resample}${part === null ? "" : `&part=${part}`}`,
    ),
  resampleSequence: toGait("/sequence/resample"),
  deleted: async () => (await request("GET", "/api/gaits/deleted")).gaits,
  remove: onGait("DELETE"),
  versions: onGait("GET", "/versions"),
  /** @type {(id: string, name: string) => Promise<any>} */
  nameVersion: (id, name) => request("POST", `${gait(id)}/versions`, { name }),
  /** @type {(id: string, number: number, to?: number|null) => Promise<any>} */
  difference: (id, number, to = null) =>
    request("GET", `${gait(id)}/versions/${number}/difference${to === null ? "" : `?to=${to}`}`),
  /** @type {(id: string, number: number) => Promise<any>} */
  restoreVersion: (id, number) => request("POST", `${gait(id)}/versions/${number}/restore`),
  /** @type {(id: string, keep: string) => Promise<any>} */
  settleFile: (id, keep) => request("POST", `${gait(id)}/file`, { keep }),
  recover: onGait("POST", "/recover"),
  restore: onGait("POST", "/restore"),
  check: onGait("POST", "/check"),
  /**
   * @type {(id: string, by: string, verdict: string, seen: boolean,
   *   override?: {rules: string[], reason: string}|null) => Promise<any>}
   */
  approve: (id, by, verdict, seen, override = null) =>
    request("POST", `${gait(id)}/approve`, { by, verdict_hash: verdict, accept_warnings: seen, override }),
  approvals: onGait("GET", "/approvals"),
  /** @type {(id: string, number: number, to?: number|null) => Promise<any>} */
  approvalDifference: (id, number, to = null) =>
    request("GET", `${gait(id)}/approvals/${number}/difference${to === null ? "" : `?to=${to}`}`),
  /** @type {(id: string, range: {first: number, iterations: number}) => Promise<any>} */
  run: (id, { first, iterations }) =>
    request("GET", `${gait(id)}/run?from=${first}&iterations=${iterations}`),
  optimiseParts: onGait("POST", "/sequence/optimise"),
  /** @param {Json} document */
  createTable: (document) => request("POST", "/api/tables/made", { document }),
  poseTable: post("/api/tables/pose"),
  tableRepairs: post("/api/tables/repairs"),
  /** @type {(id: string, plan: string) => Promise<ArrayBuffer>} */
  poses: (id, plan) => bytes("GET", `${gait(id)}/poses?plan=${encodeURIComponent(plan)}`),
  /** @type {(id: string, of: string) => Promise<ArrayBuffer>} */
  ghost: (id, of) => bytes("GET", `${gait(id)}/ghost?of=${of}`),
  /** @type {(id: string, plan: string, workspace: string) => Promise<any>} */
  reach: (id, plan, workspace) =>
    request("GET", `${gait(id)}/reach?plan=${encodeURIComponent(plan)}&workspace=${workspace}`),
  live: toGait("/live"),
  /** @type {(id: string, body: Json, signal?: AbortSignal) => Promise<any>} */
  limit: async (id, body, signal) => (await request("POST", `${gait(id)}/limit`, body, signal)).value,
  /** @type {(id: string, body: Json, signal: AbortSignal|undefined, told: Told) => Promise<void>} */
  remedies: (id, body, signal, told) => streamed(`${gait(id)}/remedies`, body, signal, told),
  /** @type {(id: string, to: string, revision: number|null) => Promise<any>} */
  convert: (id, to, revision) => request("POST", `${gait(id)}/convert`, { to, revision }),
  /** @type {(id: string, signal: AbortSignal|undefined, told: Told) => Promise<void>} */
  faster: (id, signal, told) => streamed(`${gait(id)}/faster`, undefined, signal, told),
  create: post("/api/gaits"),
  /** @type {(job: string, number: number) => Promise<any>} */
  iterate: (job, number) => request("GET", `${jobAddress(job)}/course/${number}`),
  patterns: post("/api/patterns"),
  pattern: onPattern("GET"),
  cancelPattern: onPattern("DELETE"),
  usePattern: onPattern("POST", "/use"),
  cancelSearch: onGait("DELETE", "/search"),
  searchAgain: onGait("POST", "/search"),
  patternGait: post("/api/patterns/gait"),
  patternPlan: post("/api/patterns/plan"),
  patternDocument: post("/api/patterns/document"),
  /** @param {string} id */
  optimise: (id) => request("POST", "/api/jobs", { kind: "optimise", gait: id }),
  /** @param {string} id */
  timing: (id) => request("POST", "/api/jobs", { kind: "timing", gait: id }),
  /** @type {(id: string, physics: string|null, variations: number) => Promise<any>} */
  simulate: (id, physics, variations) =>
    request("POST", "/api/jobs", { kind: "simulate", gait: id, physics, variations }),
  /** @param {string} robot */
  physicsSets: (robot) => request("GET", `/api/simulations/sets?robot=${encodeURIComponent(robot)}`),
  simulation: onEach(simulationAddress)("GET"),
  /** @param {string} key */
  simulatedGhost: (key) => bytes("GET", `${simulationAddress(key)}/ghost`),
  cancelJob: onEach(jobAddress)("DELETE"),
  /** @type {(act: string, by: string) => Promise<any>} */
  lease: (act, by) => request("POST", `/api/robot/lease/${act}`, by ? { by } : {}),
  ports: () => request("GET", "/api/robot/ports"),
  transitions: () => request("GET", "/api/robot/transitions"),
  /** @param {Json} wanted */
  runs: (wanted) =>
    request(
      "GET",
      `/api/runs?${new URLSearchParams(Object.entries(wanted).filter(([, value]) => value !== ""))}`,
    ),
  /** @type {(id: string, other: string) => Promise<any>} */
  compareRuns: (id, other) =>
    request("GET", `${runAddress(id)}/comparison?other=${encodeURIComponent(other)}`),
  keptRun: onRun("GET"),
  runStrokes: onRun("GET", "/strokes"),
  /** @param {string} id */
  runGhost: (id) => bytes("GET", `${runAddress(id)}/ghost`),
  /** @type {(id: string, note: string) => Promise<any>} */
  noteRun: (id, note) => request("PUT", `${runAddress(id)}/note`, { note }),
  deleteRun: onRun("DELETE"),
  restoreRun: onRun("POST", "/restore"),
  /** @type {(table: string, row: number) => Promise<{number: number}>} */
  setAside: (table, row) => request("POST", "/api/storage/unreadable/set-aside", { table, row }),
  /** @type {(number: number) => Promise<any>} */
  bringBack: (number) => request("POST", "/api/storage/unreadable/bring-back", { number }),
  /** @param {Json} target */
  jogGhost: (target) => bytes("POST", "/api/robot/jog/ghost", target),
  measuredPoses: () => bytes("GET", "/api/robot/poses"),
  /** @type {(verb: string, body?: Json) => Promise<any>} */
  robot: (verb, body = {}) => request("POST", `/api/robot/${verb}`, body),
};

/** Time after which a Stop that was not answered is sent again. */
const STOP_MS = 1000;

/**
 * Sends Stop, again and again until it is answered; needs no body.
 * @param {string} by who stops, where known
 * @returns {Promise<Record<string, any>>} the robot's state
 * @throws {ApiError} after `attempts` failures, each of which takes `STOP_MS` at most
 */
export async function sendStop(by, attempts = 5) {
  let failure = null;
  for (let attempt = 0; attempt < attempts; attempt += 1) {
    try {
      return await request(
        "POST",
        `/api/robot/stop${by ? `?by=${encodeURIComponent(by)}` : ""}`,
        undefined,
        AbortSignal.timeout(STOP_MS),
      );
    } catch (error) {
      failure = error;
      await new Promise((resume) => setTimeout(resume, 150 * attempt));
    }
  }
  throw failure;
}
