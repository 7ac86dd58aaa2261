/** The HTTP side of the server. Every refusal becomes an ApiError whose message is meant for people. */

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
    if (body.detail) return new ApiError(typeof body.detail === "string" ? body.detail : JSON.stringify(body.detail), response.status);
  } catch {
    return new ApiError(`The studio answered with status ${response.status} and no sentence.`, response.status);
  }
  return new ApiError(`The studio refused this with status ${response.status}.`, response.status);
}

async function request(method, path, body) {
  let response;
  try {
    response = await fetch(path, {
      method,
      headers: body === undefined ? {} : { "Content-Type": "application/json" },
      body: body === undefined ? undefined : JSON.stringify(body),
    });
  } catch {
    throw new ApiError("The studio does not answer. Is it still running?", 0);
  }
  if (!response.ok) throw await refusal(response);
  return response.json();
}

const gait = (id) => `/api/gaits/${encodeURIComponent(id)}`;

export const api = {
  view: (id) => request("GET", `${gait(id)}/view`),
  document: (id) => request("GET", gait(id)),
  put: (id, document, label, revision) =>
    request("PUT", `${gait(id)}?label=${encodeURIComponent(label)}&revision=${revision}`, document),
  redraw: (id, body) => request("POST", `${gait(id)}/redraw`, body),
  history: (id, verb) => request("POST", `${gait(id)}/${verb}`),
  copy: (id, name) => request("POST", `/api/gaits?copy_of=${encodeURIComponent(id)}&name=${encodeURIComponent(name)}`),
  create: (document) => request("POST", "/api/gaits", document),
  remove: (id) => request("DELETE", gait(id)),
  restore: (id) => request("POST", `${gait(id)}/restore`),
  check: (id) => request("POST", `${gait(id)}/check`),
  approve: (id, by, verdict) => request("POST", `${gait(id)}/approve`, { by, verdict_hash: verdict }),
  run: (id) => request("GET", `${gait(id)}/run`),
  posesPath: (id, plan) => `${gait(id)}/poses?plan=${encodeURIComponent(plan)}`,
  optimise: (id) => request("POST", "/api/jobs", { kind: "optimise", gait: id }),
  cancelJob: (id) => request("DELETE", `/api/jobs/${encodeURIComponent(id)}`),
  robot: (verb, body = {}) => request("POST", `/api/robot/${verb}`, body),
};

/**
 * Sends Stop, again and again until it is answered; needs no body.
 * @param {string} by who stops, where known
 * @returns {Promise<object>} the robot's state
 * @throws {ApiError} after `attempts` failures
 */
export async function sendStop(by, attempts = 5) {
  let failure = null;
  for (let attempt = 0; attempt < attempts; attempt += 1) {
    try {
      return await request("POST", `/api/robot/stop${by ? `?by=${encodeURIComponent(by)}` : ""}`);
    } catch (error) {
      failure = error;
      await new Promise((resume) => setTimeout(resume, 150 * attempt));
    }
  }
  throw failure;
}
