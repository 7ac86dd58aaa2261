/**
 * The WebSocket to /api/events. This module is loaded ahead of the page's others and opens the first one at
 * once, so that the greeting is on its way while they are still being read.
 */

import { onRenamed, pageId } from "./author.js";

/** Opens a socket in the name of this tab. */
export function openSocket() {
  const query = new URLSearchParams(location.search);
  query.set("page", pageId());
  return new WebSocket(
    `${location.protocol === "https:" ? "wss" : "ws"}://${location.host}/api/events?${query}`,
  );
}

const first = openSocket();
/** @type {string[]} */
const early = [];
const keep = (/** @type {MessageEvent} */ { data }) => early.push(data);
first.addEventListener("message", keep);
onRenamed(() => first.close());

/** Hands the first socket over, with the messages that have come already. */
export function takeFirst() {
  first.removeEventListener("message", keep);
  return { socket: first, early };
}
