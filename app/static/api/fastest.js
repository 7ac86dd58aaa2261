/** Requests about the fastest gait for the robot's clock. */

import { request, streamed } from "./gaits.js";

/** @typedef {import("./gaits.js").Json} Json */

export const fastestApi = {
  /** @type {(question: Json, signal: AbortSignal, told: import("./gaits.js").Told) => Promise<void>} */
  prices: (question, signal, told) => streamed("/api/fastest/prices", question, signal, told),
  /** @type {(question: Json, front: boolean) => Promise<any>} */
  search: (question, front) => request("POST", "/api/fastest/searches", { ...question, front }),
  /** @type {(question: Json, name: string) => Promise<any>} */
  create: (question, name) => request("POST", "/api/fastest/gaits", { ...question, name }),
};
