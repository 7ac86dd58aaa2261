/** The server's events: one WebSocket that reconnects by itself and then gets the whole state. */

import { onRenamed } from "../api/author.js";
import { openSocket, takeFirst } from "../api/socket.js";
import {
  acceptHello,
  acceptLine,
  acceptRobot,
  acceptSources,
  acceptSteps,
  acceptView,
  withJob,
} from "./store.js";

const FIRST_WAIT_MS = 300;
const LONGEST_WAIT_MS = 5000;

/**
 * @typedef {import("./store.js").Store} Store
 * @typedef {Record<string, any>} Message
 */

/** @type {(text: string) => void} */
let send = () => {};

/** Sends text to the studio over the socket if it is open. @param {string} text */
export const sendToStudio = (text) => send(text);

/**
 * What each message changes, by its type.
 * @type {Record<string, (store: Store, message: Message) => void>}
 */
const RECEIVERS = {
  hello: acceptHello,
  gaits: (store, { gaits }) => store.set({ gaits }),
  gait: (store, { view }) => {
    acceptView(store, view);
    acceptLine(store, view);
  },
  steps: acceptSteps,
  sources: acceptSources,
  job: (store, { job }) => store.set({ jobs: withJob(store.state.jobs, job) }),
  storage: (store, { storage }) => store.set({ storage }),
  search: (store, { search }) => store.set({ poseSearch: search }),
  pattern: (store, pattern) => store.set({ pattern }),
  setups: (store, { setups }) => store.set({ setups }),
  cameras: (store, { cameras }) => store.set({ cameras }),
  published: (store, { table }) => store.set({ publishedChanged: { table } }),
  video: (store, { video }) => store.set({ videoChanged: video }),
  trials: (store, { trial }) => store.set({ trialMade: { id: trial } }),
  trial: (store, { trial }) =>
    store.set({ trialChanges: { ...store.state.trialChanges, [trial.id]: trial } }),
  robot: (store, { robot }) => acceptRobot(store, robot),
  motor_test: (store, { motor_test: motorTest }) => store.set({ motorTest }),
};

/**
 * Keeps a connection to /api/events.
 * @param {Store} store
 * @param {() => void} onHello runs after every greeting, also after a reconnection
 */
export function listen(store, onHello) {
  let wait = FIRST_WAIT_MS;
  let closeSocket = () => {};
  onRenamed(() => closeSocket());

  /** @param {string} data */
  function take(data) {
    wait = FIRST_WAIT_MS;
    const message = JSON.parse(data);
    if (message.type === "beat") send("here");
    RECEIVERS[message.type]?.(store, message);
    if (message.type === "hello") onHello();
  }

  function closed() {
    if (store.state.connected) store.set({ connected: false });
    setTimeout(() => follow({ socket: openSocket(), early: [] }), wait);
    wait = Math.min(wait * 2, LONGEST_WAIT_MS);
  }

  /** @param {{socket: WebSocket, early: string[]}} from */
  function follow({ socket, early }) {
    closeSocket = () => socket.close();
    send = (text) => {
      if (socket.readyState === WebSocket.OPEN) socket.send(text);
    };
    socket.addEventListener("message", ({ data }) => take(data));
    if (socket.readyState === WebSocket.CLOSED) closed();
    else socket.addEventListener("close", closed);
    early.forEach(take);
  }

  follow(takeFirst());
}
