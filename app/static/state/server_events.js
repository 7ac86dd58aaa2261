/** The server's events: one WebSocket that reconnects by itself and then gets the whole state. */

import { onRenamed } from "../api/author.js";
import { openSocket, takeFirst } from "../api/socket.js";
import { acceptLine, acceptRobot, acceptSources, acceptSteps, acceptView, withJob } from "./store.js";

const FIRST_WAIT_MS = 300;
const LONGEST_WAIT_MS = 5000;

let send = () => {};

/** Sends text to the studio over the socket if it is open. */
export const sendToStudio = (text) => send(text);

function receive(store, message, onHello) {
  switch (message.type) {
    case "hello":
      store.set({
        connected: true,
        greeted: true,
        version: message.version,
        gaits: message.gaits,
        robot: message.robot,
        storage: message.storage,
        jobs: message.jobs.reduce((jobs, job) => withJob(jobs, job), []),
      });
      onHello();
      break;
    case "gaits":
      store.set({ gaits: message.gaits });
      break;
    case "gait":
      acceptView(store, message.view);
      acceptLine(store, message.view);
      break;
    case "steps":
      acceptSteps(store, message);
      break;
    case "sources":
      acceptSources(store, message);
      break;
    case "job":
      store.set({ jobs: withJob(store.state.jobs, message.job) });
      break;
    case "storage":
      store.set({ storage: message.storage });
      break;
    case "search":
      store.set({ poseSearch: message.search });
      break;
    case "pattern":
      store.set({ pattern: message });
      break;
    case "setups":
      store.set({ setups: message.setups });
      break;
    case "cameras":
      store.set({ cameras: message.cameras });
      break;
    case "video":
      store.set({ videoChanged: message.video });
      break;
    case "trials":
      store.set({ trialMade: { id: message.trial } });
      break;
    case "trial":
      store.set({ trialChanges: { ...store.state.trialChanges, [message.trial.id]: message.trial } });
      break;
    case "robot":
      acceptRobot(store, message.robot);
      break;
    default:
      break;
  }
}

/** Keeps a connection to /api/events; `onHello` runs after every greeting, also after a reconnection. */
export function listen(store, onHello) {
  let wait = FIRST_WAIT_MS;
  let closeSocket = () => {};
  onRenamed(() => closeSocket());

  function take(data) {
    wait = FIRST_WAIT_MS;
    const message = JSON.parse(data);
    if (message.type === "beat") send("here");
    else receive(store, message, onHello);
  }

  function closed() {
    if (store.state.connected) store.set({ connected: false });
    setTimeout(() => follow({ socket: openSocket(), early: [] }), wait);
    wait = Math.min(wait * 2, LONGEST_WAIT_MS);
  }

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
