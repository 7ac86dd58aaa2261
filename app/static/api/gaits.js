/** HTTP requests. Every refusal becomes an ApiError with a message for people. */

import { authorHeaders } from "./author.js";

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

export const request = async (method, path, body, signal) =>
  (await answer(method, path, body, signal)).json();

/** Sends text or a file unchanged, such as a CSV or JSON file or a picture. */
export async function sendFile(path, body, type = "text/plain") {
  const response = await fetch(path, {
    method: "POST",
    body,
    headers: { ...authorHeaders(), "Content-Type": type },
  });
  if (!response.ok) throw await refusal(response);
  return response.json();
}

/** A file that the server makes: its name and its bytes. */
async function download(path) {
  const response = await answer("GET", path);
  const name = /filename="([^"]*)"/.exec(response.headers.get("content-disposition") ?? "")?.[1] ?? "gait";
  return { name, blob: await response.blob() };
}

/** Passes on each line of JSON as it comes. */
async function linesOf(response, told) {
  const reader = response.body.pipeThrough(new TextDecoderStream()).getReader();
  let rest = "";
  for (;;) {
    const { done, value } = await reader.read();
    if (done) return;
    const lines = (rest + value).split("\n");
    rest = lines.pop();
    lines.forEach((line) => told(JSON.parse(line)));
  }
}

/** Sends a question and passes on each line of the answer as it comes. */
export const streamed = async (path, body, signal, told) =>
  linesOf(await answer("POST", path, body, signal), told);

const gait = (id) => `/api/gaits/${encodeURIComponent(id)}`;

export const api = {
  view: (id) => request("GET", `${gait(id)}/view`),
  document: (id) => request("GET", gait(id)),
  put: (id, document, { label, number }, revision) =>
    request(
      "PUT",
      `${gait(id)}?label=${encodeURIComponent(label)}&revision=${revision}&edit=${number}`,
      document,
    ),
  redraw: (id, body) => request("POST", `${gait(id)}/redraw`, body),
  history: (id, verb) => request("POST", `${gait(id)}/${verb}`),
  copy: (id, name) =>
    request("POST", `/api/gaits?copy_of=${encodeURIComponent(id)}&name=${encodeURIComponent(name)}`),
  importFile: (body, file) => sendFile(`/api/gaits/import?file=${encodeURIComponent(file)}`, body),
  exportFile: (id, form) => download(`${gait(id)}/export/${form}`),
  robots: () => request("GET", "/api/robots"),
  draw: (words) => request("POST", "/api/gaits/drawn", words),
  sequence: (body) => request("POST", "/api/sequences", body),
  refreshSequence: (id, part, resample) =>
    request(
      "POST",
      `${gait(id)}/sequence/refresh?resample=${resample}${part === null ? "" : `&part=${part}`}`,
    ),
  resampleSequence: (id, body) => request("POST", `${gait(id)}/sequence/resample`, body),
  deleted: async () => (await request("GET", "/api/gaits/deleted")).gaits,
  remove: (id) => request("DELETE", gait(id)),
  versions: (id) => request("GET", `${gait(id)}/versions`),
  nameVersion: (id, name) => request("POST", `${gait(id)}/versions`, { name }),
  difference: (id, number, to = null) =>
    request("GET", `${gait(id)}/versions/${number}/difference${to === null ? "" : `?to=${to}`}`),
  restoreVersion: (id, number) => request("POST", `${gait(id)}/versions/${number}/restore`),
  settleFile: (id, keep) => request("POST", `${gait(id)}/file`, { keep }),
  recover: (id) => request("POST", `${gait(id)}/recover`),
  restore: (id) => request("POST", `${gait(id)}/restore`),
  check: (id) => request("POST", `${gait(id)}/check`),
  approve: (id, by, verdict, seen) =>
    request("POST", `${gait(id)}/approve`, { by, verdict_hash: verdict, accept_warnings: seen }),
  approvals: (id) => request("GET", `${gait(id)}/approvals`),
  approvalDifference: (id, number, to = null) =>
    request("GET", `${gait(id)}/approvals/${number}/difference${to === null ? "" : `?to=${to}`}`),
  run: (id, { first, iterations }) =>
    request("GET", `${gait(id)}/run?from=${first}&iterations=${iterations}`),
  optimiseParts: (id) => request("POST", `${gait(id)}/sequence/optimise`),
  createTable: (document) => request("POST", "/api/tables/made", { document }),
  poseTable: (body) => request("POST", "/api/tables/pose", body),
  tableRepairs: (body) => request("POST", "/api/tables/repairs", body),
  poses: async (id, plan) =>
    (await answer("GET", `${gait(id)}/poses?plan=${encodeURIComponent(plan)}`)).arrayBuffer(),
  ghost: async (id, of) => (await answer("GET", `${gait(id)}/ghost?of=${of}`)).arrayBuffer(),
  reach: (id, plan, workspace) =>
    request("GET", `${gait(id)}/reach?plan=${encodeURIComponent(plan)}&workspace=${workspace}`),
  live: (id, body) => request("POST", `${gait(id)}/live`, body),
  limit: async (id, body, signal) => (await request("POST", `${gait(id)}/limit`, body, signal)).value,
  remedies: (id, body, signal, told) => streamed(`${gait(id)}/remedies`, body, signal, told),
  convert: (id, to, revision) => request("POST", `${gait(id)}/convert`, { to, revision }),
  faster: (id, signal, told) => streamed(`${gait(id)}/faster`, undefined, signal, told),
  create: (document) => request("POST", "/api/gaits", document),
  iterate: (job, number) => request("GET", `/api/jobs/${encodeURIComponent(job)}/course/${number}`),
  patterns: (question) => request("POST", "/api/patterns", question),
  pattern: (id) => request("GET", `/api/patterns/${id}`),
  cancelPattern: (id) => request("DELETE", `/api/patterns/${id}`),
  usePattern: (id) => request("POST", `/api/patterns/${id}/use`),
  cancelSearch: (id) => request("DELETE", `/api/gaits/${id}/search`),
  searchAgain: (id) => request("POST", `/api/gaits/${id}/search`),
  patternGait: (body) => request("POST", "/api/patterns/gait", body),
  patternPlan: (body) => request("POST", "/api/patterns/plan", body),
  patternDocument: (body) => request("POST", "/api/patterns/document", body),
  optimise: (id) => request("POST", "/api/jobs", { kind: "optimise", gait: id }),
  timing: (id) => request("POST", "/api/jobs", { kind: "timing", gait: id }),
  simulate: (id, physics, variations) =>
    request("POST", "/api/jobs", { kind: "simulate", gait: id, physics, variations }),
  physicsSets: (robot) => request("GET", `/api/simulations/sets?robot=${encodeURIComponent(robot)}`),
  simulation: (key) => request("GET", `/api/simulations/${encodeURIComponent(key)}`),
  simulatedGhost: async (key) =>
    (await answer("GET", `/api/simulations/${encodeURIComponent(key)}/ghost`)).arrayBuffer(),
  cancelJob: (id) => request("DELETE", `/api/jobs/${encodeURIComponent(id)}`),
  lease: (act, by) => request("POST", `/api/robot/lease/${act}`, by ? { by } : {}),
  ports: () => request("GET", "/api/robot/ports"),
  transitions: () => request("GET", "/api/robot/transitions"),
  runs: (wanted) =>
    request(
      "GET",
      `/api/runs?${new URLSearchParams(Object.entries(wanted).filter(([, value]) => value !== ""))}`,
    ),
  compareRuns: (id, other) =>
    request("GET", `/api/runs/${encodeURIComponent(id)}/comparison?other=${encodeURIComponent(other)}`),
  keptRun: (id) => request("GET", `/api/runs/${encodeURIComponent(id)}`),
  runStrokes: (id) => request("GET", `/api/runs/${encodeURIComponent(id)}/strokes`),
  runGhost: async (id) => (await answer("GET", `/api/runs/${encodeURIComponent(id)}/ghost`)).arrayBuffer(),
  noteRun: (id, note) => request("PUT", `/api/runs/${encodeURIComponent(id)}/note`, { note }),
  deleteRun: (id) => request("DELETE", `/api/runs/${encodeURIComponent(id)}`),
  restoreRun: (id) => request("POST", `/api/runs/${encodeURIComponent(id)}/restore`),
  jogGhost: async (target) => (await answer("POST", "/api/robot/jog/ghost", target)).arrayBuffer(),
  measuredPoses: async () => (await answer("GET", "/api/robot/poses")).arrayBuffer(),
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
