/** Requests for learning from trials. */

import { request } from "./gaits.js";

const course = (id) => `/api/learning/${encodeURIComponent(id)}`;

export const learningApi = {
  courses: async () => (await request("GET", "/api/learning")).courses,
  course: (id) => request("GET", course(id)),
  start: (wanted) => request("POST", "/api/learning", wanted),
  cancel: (id) => request("DELETE", course(id)),
  keep: (id, name) => request("POST", `${course(id)}/set`, { name }),
  sets: async () => (await request("GET", "/api/learning/sets")).sets,
  removeSet: ({ name, version }) => request("POST", "/api/learning/sets/delete", { name, version }),
  restoreSet: ({ name, version }) => request("POST", "/api/learning/sets/restore", { name, version }),
};
