/** Requests for trials. */

import { onEach, post, request } from "./gaits.js";

const trial = (/** @type {string} */ id) => `/api/trials/${encodeURIComponent(id)}`;

const onTrial = onEach(trial);

export const trialApi = {
  list: () => request("GET", "/api/trials"),
  read: onTrial("GET"),
  paths: onTrial("GET", "/paths"),
  add: post("/api/trials"),
  example: () => request("POST", "/api/trials/example"),
  /** @type {(id: string, revision: number, changes: Record<string, any>) => Promise<any>} */
  change: (id, revision, changes) => request("PUT", trial(id), { revision, ...changes }),
  remove: onTrial("DELETE"),
  restore: onTrial("POST", "/restore"),
  runs: () => request("GET", "/api/runs?most=50"),
};
