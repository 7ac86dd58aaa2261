/** Requests for trials. */

import { request } from "./gaits.js";

const trial = (id) => `/api/trials/${encodeURIComponent(id)}`;

export const trialApi = {
  list: () => request("GET", "/api/trials"),
  read: (id) => request("GET", trial(id)),
  paths: (id) => request("GET", `${trial(id)}/paths`),
  add: (body) => request("POST", "/api/trials", body),
  example: () => request("POST", "/api/trials/example"),
  change: (id, revision, changes) => request("PUT", trial(id), { revision, ...changes }),
  remove: (id) => request("DELETE", trial(id)),
  restore: (id) => request("POST", `${trial(id)}/restore`),
  runs: () => request("GET", "/api/runs?most=50"),
};
