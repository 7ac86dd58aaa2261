/** Requests for learning from trials. */

import { onEach, post, request } from "./gaits.js";

/** @typedef {{name: string, version: number}} SetName */

const course = (/** @type {string} */ id) => `/api/learning/${encodeURIComponent(id)}`;
const onCourse = onEach(course);

export const learningApi = {
  courses: async () => (await request("GET", "/api/learning")).courses,
  course: onCourse("GET"),
  start: post("/api/learning"),
  cancel: onCourse("DELETE"),
  /** @type {(id: string, name: string) => Promise<any>} */
  keep: (id, name) => request("POST", `${course(id)}/set`, { name }),
  sets: async () => (await request("GET", "/api/learning/sets")).sets,
  /** @param {SetName} set */
  removeSet: ({ name, version }) => request("POST", "/api/learning/sets/delete", { name, version }),
  /** @param {SetName} set */
  restoreSet: ({ name, version }) => request("POST", "/api/learning/sets/restore", { name, version }),
};
