/** The server's pushes: one WebSocket that comes back by itself, each time with the whole truth. */

import { acceptView, withJob } from "./store.js";

const FIRST_WAIT_MS = 300;
const LONGEST_WAIT_MS = 5000;

function receive(store, message, onHello) {
  switch (message.type) {
    case "hello":
      store.set({
        connected: true, greeted: true, version: message.version, gaits: message.gaits, robot: message.robot,
        jobs: message.jobs.reduce((jobs, job) => withJob(jobs, job), []),
      });
      onHello();
      break;
    case "gaits": store.set({ gaits: message.gaits }); break;
    case "gait": acceptView(store, message.view); break;
    case "job": store.set({ jobs: withJob(store.state.jobs, message.job) }); break;
    case "robot": store.set({ robot: message.robot }); break;
    default: break;
  }
}

/** Keeps a connection to /api/events; `onHello` runs after every greeting, also after a reconnection. */
export function listen(store, onHello) {
  let wait = FIRST_WAIT_MS;
  const address = `${location.protocol === "https:" ? "wss" : "ws"}://${location.host}/api/events${location.search}`;

  function connect() {
    const socket = new WebSocket(address);
    socket.addEventListener("message", (event) => {
      wait = FIRST_WAIT_MS;
      receive(store, JSON.parse(event.data), onHello);
    });
    socket.addEventListener("close", () => {
      if (store.state.connected) store.set({ connected: false });
      setTimeout(connect, wait);
      wait = Math.min(wait * 2, LONGEST_WAIT_MS);
    });
  }

  connect();
}
