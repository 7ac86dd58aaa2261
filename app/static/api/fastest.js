/** Requests about the fastest gait for the robot's clock. */

import { request, streamed } from "./gaits.js";

export const fastestApi = {
  prices: (question, signal, told) => streamed("/api/fastest/prices", question, signal, told),
  search: (question, front) => request("POST", "/api/fastest/searches", { ...question, front }),
  create: (question, name) => request("POST", "/api/fastest/gaits", { ...question, name }),
};
