/** Requests about atlases. */

import { request } from "./gaits.js";

const addressOf = (name) => `/api/atlases/${encodeURIComponent(name)}`;

export const atlasApi = {
  list: () => request("GET", "/api/atlases"),
  make: (body) => request("POST", "/api/atlases", body),
  erase: (name) => request("DELETE", addressOf(name)),
  restore: (name) => request("POST", `${addressOf(name)}/restore`),
  mapAddress: (name) => `${addressOf(name)}/map`,
  fileAddress: (name, format) => `${addressOf(name)}/export?format=${format}`,
};
