/** Requests about atlases. */

import { onEach, post, request } from "./gaits.js";

const addressOf = (/** @type {string} */ name) => `/api/atlases/${encodeURIComponent(name)}`;
const onAtlas = onEach(addressOf);

export const atlasApi = {
  list: () => request("GET", "/api/atlases"),
  make: post("/api/atlases"),
  erase: onAtlas("DELETE"),
  restore: onAtlas("POST", "/restore"),
  /** @param {string} name */
  mapAddress: (name) => `${addressOf(name)}/map`,
  /** @type {(name: string, format: string) => string} */
  fileAddress: (name, format) => `${addressOf(name)}/export?format=${format}`,
};
