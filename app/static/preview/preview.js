/**
 * The 3D preview: shows a plan's poses in the embedded Viser client.
 *
 * All poses of a plan come once, as one binary; a moved playhead costs no message to the server.
 *
 *   const frame = document.querySelector("iframe");
 *   frame.src = Preview.url();                     // "/viser/?websocket=ws://HOST/viser/ws"
 *   const preview = new Preview(frame);
 *   await preview.ready();
 *   await preview.loadPoses(`/api/gaits/${id}/poses?plan=${hash}`);   // or an ArrayBuffer
 *   playback.addEventListener("time", (event) => preview.setTime(event.detail.time));
 *
 * Static:
 *   Preview.url()                 address for the iframe
 * Methods:
 *   ready(timeoutMs = 20000)      Promise: the scene of the robot is in the client; rejects with a sentence
 *   loadPoses(source)             Promise<{ robot, duration, frames, nodes }>: URL string or ArrayBuffer; the
 *                                 playhead's time stays. A newer call wins over one still under way (whose
 *                                 promise then resolves to null). May be called before the scene is ready.
 *   setTime(seconds)              shows the pose at that time, interpolated; cheap, call it every frame
 *   setOverlay(overlay | null)    what lies on the floor; loadPoses sets it by itself where the poses carry one:
 *                                 { times: [n] s, com: [n][3] m, feet: [n][legs][3] m, contact: [n][legs] bool,
 *                                   margins: [n] m }   null takes it away
 *   show(part, visible)           part: "polygon", "com", "traces", "footholds", "robot"
 *   setCaution(metres)            margin below which the polygon is amber (0.003 by default; below 0 it is red)
 *   setDark(dark)                 backdrop and floor for the dark theme
 *   setView(name)                 "perspective", "top", "front", "side"
 *   dispose()
 * Properties: time, info (of the loaded plan or null), route ("direct", "server" or "none"), posesShown (count).
 * Events: "ready" (also when the client's scene was made anew: a reconnection or another robot),
 *   "route" (detail: the new route; "server" means the slower way, through the server).
 */

import { planUpdates, polygonUpdates, sampleAt } from "./overlay.js";
import { PoseTable, VALUES_A_NODE } from "./poses.js";
import { ServerRoute } from "./server_route.js";
import { Sharpness } from "./sharpness.js";
import { ViserClient, cameraMessages, poseMessages, visibleMessage } from "./viser_client.js";

const BODY = "/robot/body";
const COM = "/overlay/com";
const WATCH_MS = 250;
const DIRECT_PATIENCE_MS = 8000;
const STILL = 1e-7;
const STRAY = 1e-5;
const SETTLING_LOOKS = new Set([2, 4, 8]);
const TARGET = [0, 0, 0.034];
const VIEW_DISTANCE = 4.6;
const VIEWS = {
  perspective: [0.363, -0.865, 0.346],
  top: [0, -0.02, 1],
  front: [0, -1, 0.06],
  side: [1, 0, 0.06],
};

export class Preview extends EventTarget {
  #client;
  #table = null;
  #pose = null;
  #shown = null;
  #overlay = null;
  #sample = -1;
  #caution = 0.003;
  #dark = false;
  #visible = { polygon: true, com: true, traces: true, footholds: true, robot: true };
  #time = 0;
  #load = 0;
  #pending = 0;
  #bodyNode = null;
  #looks = 0;
  #started = performance.now();
  #watch;
  #serverRoute = null;
  #sharpness;
  posesShown = 0;
  route = "none";

  /** @param {HTMLIFrameElement} frame whose src is Preview.url() */
  constructor(frame) {
    super();
    this.#client = new ViserClient(frame);
    this.#sharpness = new Sharpness(this.#client);
    this.#watch = setInterval(() => this.#look(), WATCH_MS);
  }

  static url() {
    const scheme = location.protocol === "https:" ? "wss" : "ws";
    return `/viser/?websocket=${encodeURIComponent(`${scheme}://${location.host}/viser/ws`)}`;
  }

  get time() { return this.#time; }

  get info() {
    if (!this.#table) return null;
    const { robot, duration, frames, nodes } = this.#table;
    return { robot, duration, frames, nodes: [...nodes] };
  }

  /** The client underneath, for tests. */
  get client() { return this.#client; }

  ready(timeoutMs = 20000) {
    if (this.#bodyNode || this.route === "server") return Promise.resolve();
    return new Promise((resolve, reject) => {
      const timer = setTimeout(() => {
        reject(new Error(`The 3D view did not start within ${timeoutMs / 1000} s; reload the page.`));
      }, timeoutMs);
      this.addEventListener("ready", () => { clearTimeout(timer); resolve(); }, { once: true });
    });
  }

  async loadPoses(source) {
    this.#load += 1;
    const turn = this.#load;
    const buffer = typeof source === "string" ? await download(source) : source;
    if (turn !== this.#load) return null;
    this.#table = new PoseTable(buffer);
    this.#pose = new Float32Array(this.#table.nodes.length * VALUES_A_NODE);
    this.#shown = null;
    this.setOverlay(this.#table.overlay);
    this.setTime(this.#time);
    return this.info;
  }

  setTime(seconds) {
    this.#time = seconds;
    if (this.#table) this.#request();
  }

  setOverlay(overlay) {
    this.#overlay = overlay;
    this.#sample = -1;
    this.#pushPlan();
    this.#request();
  }

  show(part, visible) {
    this.#visible[part] = visible;
    this.#pushVisible();
  }

  setCaution(metres) {
    this.#caution = metres;
    this.#sample = -1;
    this.#request();
  }

  setDark(dark) {
    this.#dark = dark;
    this.#pushTheme();
    this.#pushPlan();
  }

  setView(name) {
    const direction = VIEWS[name] ?? VIEWS.perspective;
    const body = this.#client.position(BODY) ?? [0, 0, 0];
    const target = [body[0], body[1], TARGET[2]];
    const distance = this.#reach() * VIEW_DISTANCE;
    this.#client.push(cameraMessages(target.map((value, axis) => value + distance * direction[axis]), target));
  }

  dispose() {
    clearInterval(this.#watch);
    cancelAnimationFrame(this.#pending);
    this.#serverRoute?.close();
    this.#sharpness.dispose();
    this.#bodyNode = null;
    this.#table = null;
  }

  /** Looks whether the client's scene is there, is a new one, or can't be reached. */
  #look() {
    const body = this.#client.node(COM) ? this.#client.node(BODY) : undefined;
    if (body && body !== this.#bodyNode) {
      this.#bodyNode = body;
      this.#looks = 0;
      this.#setRoute("direct");
      this.#sharpness.attach();
      this.#pushAll();
      this.dispatchEvent(new CustomEvent("ready"));
    }
    this.#settle();
    const late = performance.now() - this.#started > DIRECT_PATIENCE_MS;
    if (this.route === "none" && late && !this.#client.available) {
      this.#serverRoute = new ServerRoute();
      this.#setRoute("server");
      this.dispatchEvent(new CustomEvent("ready"));
    }
  }

  /** The server's own first messages may come after ours: says again what they undid. */
  #settle() {
    if (!this.#bodyNode || this.#client.busy) return;
    this.#looks += 1;
    if (SETTLING_LOOKS.has(this.#looks)) this.#pushAll();
    else if (this.#shown && this.#table.nodes.some((name, index) => this.#strayed(name, index))) {
      this.#shown = null;
      this.#request();
    }
  }

  #strayed(name, index) {
    const at = this.#client.position(name);
    return at !== null && at.some((value, axis) => Math.abs(value - this.#shown[index * VALUES_A_NODE + 4 + axis]) > STRAY);
  }

  #setRoute(route) {
    if (route === this.route) return;
    this.route = route;
    if (route === "direct") this.#serverRoute?.close();
    this.dispatchEvent(new CustomEvent("route", { detail: route }));
  }

  #request() {
    if (this.#pending) return;
    if (!document.hidden && !this.#client.busy) this.#showPose();
    else this.#pending = requestAnimationFrame(() => { this.#pending = 0; this.#request(); });
  }

  #showPose() {
    if (!this.#table) return;
    this.#table.sample(this.#time, this.#pose);
    if (this.route === "server") {
      if (this.#serverRoute.send(this.#table.nodes, this.#pose)) this.posesShown += 1;
      return;
    }
    if (!this.#bodyNode) return;
    const messages = [...this.#polygonMessages()];
    this.#table.nodes.forEach((name, index) => {
      const at = index * VALUES_A_NODE;
      if (this.#moved(at) && this.#client.node(name)) messages.push(...poseMessages(name, this.#pose, at));
    });
    this.#shown = Float32Array.from(this.#pose);
    if (messages.length === 0) return;
    this.#client.push(messages);
    this.#sharpness.moved();
    this.posesShown += 1;
  }

  #moved(at) {
    if (!this.#shown) return true;
    for (let i = at; i < at + VALUES_A_NODE; i += 1) {
      if (Math.abs(this.#shown[i] - this.#pose[i]) > STILL) return true;
    }
    return false;
  }

  #polygonMessages() {
    if (!this.#overlay) return [];
    const sample = sampleAt(this.#overlay.times, this.#time);
    if (sample === this.#sample) return [];
    this.#sample = sample;
    return this.#updates(polygonUpdates(this.#overlay, sample, this.#caution));
  }

  #pushAll() {
    this.#shown = null;
    this.#sample = -1;
    this.#pushTheme();
    this.#pushPlan();
    this.#request();
  }

  #pushPlan() {
    if (!this.#bodyNode) return;
    if (this.#overlay) {
      this.#client.push(this.#updates(planUpdates(this.#overlay, this.#dark ? "dark" : "light")));
    }
    this.#pushVisible();
  }

  #pushVisible() {
    if (!this.#bodyNode) return;
    const { polygon, com, traces, footholds, robot } = this.#visible;
    const wanted = { "/overlay/polygon": polygon, "/overlay/polygon_edge": polygon, "/overlay/com_trace": com };
    wanted[COM] = com;
    for (let foot = 1; this.#client.node(`/overlay/swing${foot}`); foot += 1) {
      wanted[`/overlay/swing${foot}`] = traces;
      wanted[`/overlay/foothold${foot}`] = footholds;
    }
    const messages = Object.entries(wanted).map(([name, on]) => visibleMessage(name, on && this.#overlay !== null));
    this.#client.push([...messages, visibleMessage("/robot", robot)]);
  }

  #pushTheme() {
    this.#client.root?.setAttribute("data-theme", this.#dark ? "dark" : "light");
    if (!this.#bodyNode) return;
    this.#client.push([visibleMessage("/floor/light", !this.#dark), visibleMessage("/floor/dark", this.#dark)]);
  }

  #updates(updates) {
    const known = updates.filter(([name]) => this.#client.node(name));
    return known.map(([name, values]) => this.#client.updateMessage(name, values));
  }

  #reach() {
    const body = this.#client.position(BODY) ?? [0, 0, 0];
    const distances = (this.#table?.nodes ?? []).map((name) => {
      const at = this.#client.position(name) ?? body;
      return Math.hypot(at[0] - body[0], at[1] - body[1]);
    });
    return Math.max(0.053, ...distances) + 0.027;
  }
}

async function download(url) {
  const answer = await fetch(url);
  if (!answer.ok) throw new Error(`The poses of this plan could not be loaded (${answer.status}); reload the page.`);
  return answer.arrayBuffer();
}
