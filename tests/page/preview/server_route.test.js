/** The way to the server's 3D scene, and how it is opened again. */

import assert from "node:assert/strict";
import { test } from "node:test";

import { ServerRoute } from "../../../app/static/preview/server_route.js";

/** How many sockets a way opens whose first one closes, with a window of the test's own. */
function socketsOf({ isClosed }) {
  const [sockets, waits] = [[], new Map()];
  class WebSocket {
    constructor() {
      sockets.push(this);
    }
    close() {}
  }
  const setTimeout = (callback) => {
    waits.set(waits.size + 1, callback);
    return waits.size;
  };
  const clearTimeout = (timer) => waits.delete(timer);
  const given = {
    window: globalThis,
    location: new URL("http://studio/"),
    WebSocket,
    setTimeout,
    clearTimeout,
  };
  const kept = Object.fromEntries(Object.keys(given).map((name) => [name, globalThis[name]]));
  Object.assign(globalThis, given);
  try {
    const route = new ServerRoute("deltawalker");
    sockets[0].onclose();
    if (isClosed) route.close();
    waits.forEach((callback) => callback());
  } finally {
    Object.assign(globalThis, kept);
  }
  return sockets.length;
}

test("a slow way that is closed while it waits is not opened again", () => {
  assert.equal(socketsOf({ isClosed: false }), 2);
  assert.equal(socketsOf({ isClosed: true }), 1);
});
