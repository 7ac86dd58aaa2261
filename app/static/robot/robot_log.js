/** The changes of link and robot with their causes, newest first. */

import { api } from "../api/gaits.js";
import { h } from "../lib/dom.js";
import { attempt } from "../lib/toasts.js";

const MOST = 50;

function timeOf(at) {
  return new Date(at * 1000).toLocaleTimeString([], {
    hour: "2-digit",
    minute: "2-digit",
    second: "2-digit",
    hour12: false,
  });
}

function row({ at, link, robot, cause }) {
  return h(
    "li",
    {},
    h("time", { class: "number quiet", text: timeOf(at) }),
    h("span", {}, h("b", { text: `${link}, ${robot}` }), ` ${cause}`),
  );
}

/** Builds the list; it is read when it is open and something changed. */
export function robotLog(store) {
  const list = h("ul", { class: "robot-log", "aria-label": "What happened", tabindex: "0" });
  const element = h("details", { class: "more" }, h("summary", { text: "What happened" }), list);
  const read = attempt(async () => {
    if (!element.open) return;
    const { transitions } = await api.transitions();
    list.replaceChildren(...transitions.slice(-MOST).reverse().map(row));
    const none =
      "Nothing has happened yet. "
      + "This list shows every change of the connection and of the robot, with the cause.";
    if (!transitions.length) list.replaceChildren(h("li", { class: "quiet", text: none }));
  });
  element.addEventListener("toggle", read);
  store.watch(({ robot }) => [robot?.link, robot?.robot, robot?.sentence], read);
  return element;
}
