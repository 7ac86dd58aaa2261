/**
 * The 3D preview: shows a plan's poses in the embedded Viser client.
 *
 * All poses of a plan come once, as one binary; a moved playhead costs no message to the server.
 *
 * Events: "opening" (detail: the robot whose scene is being loaded); "ready" (its scene is there, also after
 * a reconnection); "poses" (those of a plan are shown from now on); "route" (detail: the new route).
 */

import { Ghosts } from "./viser_ghosts.js";
import { shadowMessages } from "./shadow.js";
import { COM, Marks, STILL } from "./marks.js";
import { Camera, wayOf } from "./camera.js";
import { floorOf } from "./overlay.js";
import { paintGrey } from "./plain_surfaces.js";
import { PoseTable, VALUES_A_NODE, downloaded } from "./poses.js";
import { ServerRoute } from "./server_route.js";
import { Sharpness } from "./sharpness.js";
import { Tracks } from "./tracks.js";
import { ViserClient, poseMessages, visibleMessage } from "./viser_client.js";

const FIRST_ROBOT = "deltawalker";
const ROBOT = "/robot";
const BODY = "/robot/body";
const WATCH_MS = 250;
const DIRECT_PATIENCE_MS = 8000;
const STRAY = 1e-5;
const SETTLING_POLLS = new Set([2, 4, 8]);

export class Preview extends EventTarget {
  #client;
  #camera;
  #table = null;
  #measured = null;
  #isGrey = false;
  #pose = null;
  #shown = null;
  #robot;
  #marks;
  #ghosts;
  #tracks;
  #dark = false;
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
  /** "direct", "server" (slower: through the server) or "none". */
  route = "none";

  /**
   * @param {HTMLIFrameElement} frame for the client
   * @param {string} [robot] the robot of the first scene
   */
  constructor(frame, robot = FIRST_ROBOT) {
    super();
    this.#client = new ViserClient(frame);
    this.#camera = new Camera(this.#client);
    this.#marks = new Marks(this.#client);
    this.#ghosts = new Ghosts(this.#client);
    this.#tracks = new Tracks(this.#client);
    this.#sharpness = new Sharpness(this.#client);
    this.#watch = setInterval(() => this.#look(), WATCH_MS);
    this.#open(robot);
  }

  #open(robot) {
    this.#robot = robot;
    this.#bodyNode = null;
    this.#started = performance.now();
    this.route = "none";
    this.#serverRoute?.close();
    const scheme = location.protocol === "https:" ? "wss" : "ws";
    const socket = `${scheme}://${location.host}/viser/ws?robot=${encodeURIComponent(robot)}`;
    this.#client.open(`/viser/?websocket=${encodeURIComponent(socket)}`);
    this.dispatchEvent(new CustomEvent("opening", { detail: robot }));
  }

  get time() {
    return this.#time;
  }

  /** Of the loaded plan, or null. */
  get info() {
    if (!this.#table) return null;
    const { robot, duration, frames, nodes } = this.#table;
    return { robot, duration, frames, nodes: [...nodes] };
  }

  /** Whether the shown motion has centres of pressure. */
  get knowsPressure() {
    return Boolean(this.#marks.overlay?.cop);
  }

  /** What lies on the floor, or null. */
  get overlay() {
    return this.#marks.overlay;
  }

  /** Whether the robot is drawn by measured strokes. */
  get isMeasured() {
    return this.#measured !== null;
  }

  /** The client underneath, for tests. */
  get client() {
    return this.#client;
  }

  /** Resolves when the scene of the robot is in the client; rejects with a sentence. */
  ready(timeoutMs = 20000) {
    if (this.#bodyNode || this.route === "server") return Promise.resolve();
    return new Promise((resolve, reject) => {
      const late = new Error(`The 3D view did not start within ${timeoutMs / 1000} s. Reload the page.`);
      const timer = setTimeout(() => reject(late), timeoutMs);
      this.addEventListener("ready", resolve, { once: true });
      this.addEventListener("ready", () => clearTimeout(timer), { once: true });
    });
  }

  /**
   * Shows a plan's poses at the playhead's time, once the scene is there; those of another robot open its
   * scene. A newer call wins over one still under way, which then resolves to null.
   * @param {string|ArrayBuffer} source URL, or the poses
   * @param {Record<string, any>[]} [trouble] what is infeasible, marked at its time: { first, last, feet,
   *   family, rings }, with outlines of reach [knot][corner][2] m where they are known
   */
  async loadPoses(source, trouble = []) {
    this.#load += 1;
    const turn = this.#load;
    const buffer = typeof source === "string" ? await downloaded(source) : source;
    if (turn !== this.#load) return null;
    this.#table = new PoseTable(buffer);
    if (this.#table.robot !== this.#robot) this.#open(this.#table.robot);
    this.#pose = new Float32Array(this.#table.nodes.length * VALUES_A_NODE);
    this.#shown = null;
    this.#marks.setOverlay(this.#table.overlay, trouble);
    this.setTime(this.#time);
    this.dispatchEvent(new CustomEvent("poses"));
    return this.info;
  }

  setTrouble(trouble) {
    this.#marks.setTrouble(trouble);
    this.#request();
  }

  /** The robot in shades of grey: it is drawn by another plan than the gait's own. */
  setGrey(grey) {
    if (grey === this.#isGrey) return;
    this.#isGrey = grey;
    this.#marks.setGrey(grey);
    this.#paint();
    this.#request();
  }

  /** A version of the gait as a quiet second robot: "before", "saved", "measured", "simulated", "jog". */
  setGhost(kind, buffer) {
    this.#ghosts.set(kind, buffer);
    this.#request();
  }

  /** Draws the robot by a pose of its own instead of the plan's; null goes back to the plan. */
  setMeasured(buffer) {
    this.#measured = buffer && new PoseTable(buffer);
    if (this.#isGrey) this.#paint();
    this.#request();
  }

  /** Lines where feet were in trials: a list of `GET /api/trials/{id}/scene`; none takes them away. */
  setTracks(tracks) {
    this.#tracks.set(tracks);
    this.#request();
  }

  setReach(reach) {
    this.#marks.setShells(reach);
    this.#request();
  }

  /** `inFrame`: while the page makes a frame, in which it is drawn where there is no GPU. */
  setTime(seconds, inFrame = false) {
    this.#time = seconds;
    if (this.#table) this.#request(inFrame);
  }

  /**
   * What lies on the floor, null for nothing; `loadPoses` sets it where the poses carry one.
   * @param {{floor: number, times: number[], com: number[][], cop: number[][]|null, feet: number[][][],
   *   contact: boolean[][], margins: number[]}|null} overlay by sample, in m and s
   */
  setOverlay(overlay) {
    this.#marks.setOverlay(overlay);
    this.#request();
  }

  /** A part of `Marks`, such as "polygon", "robot" or "reach". */
  show(part, visible) {
    this.#marks.show(part, visible);
    if (this.#bodyNode) this.#client.push(this.#marks.visibleMessages());
    if (part === "reach" && visible) this.#request();
  }

  /** Margin below which the polygon is amber, 3 mm unless set; below 0 it is red. */
  setCaution(metres) {
    this.#marks.setCaution(metres);
    this.#request();
  }

  setDark(dark) {
    this.#dark = dark;
    this.#marks.setDark(dark);
    this.#ghosts.setDark(dark);
    this.#pushTheme();
    if (this.#isGrey) this.#paint();
    this.#request();
  }

  /** A view by its name in `Camera`; `front`: the way that the robot looks, degrees. */
  setView(name, front = 0) {
    if (this.#bodyNode) this.#camera.view(name, front, this.#way());
  }

  refit() {
    if (this.#bodyNode) this.#camera.refit(this.#way());
  }

  view() {
    return this.#bodyNode ? this.#client.view() : null;
  }

  setBusy(busy) {
    this.#sharpness.hold(busy);
  }

  /** The floor as it is seen (see `ViserClient.ground`), null where the camera is not known. */
  ground() {
    return this.#bodyNode ? this.#client.ground(floorOf(this.#marks.overlay)) : null;
  }

  /** Resolves when what was shown before has been handed to a frame of the client. */
  async drawn() {
    const frame = () => new Promise((resume) => requestAnimationFrame(resume));
    do await frame();
    while (this.#pending || this.#client.busy);
    await frame();
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
      this.#client.push(shadowMessages(this.#client));
      this.#client.keepCameraAbove(floorOf(this.#marks.overlay));
      this.#pushAll();
      this.dispatchEvent(new CustomEvent("ready"));
    }
    this.#settle();
    const late = performance.now() - this.#started > DIRECT_PATIENCE_MS;
    if (this.route === "none" && late && !this.#client.available) {
      this.#serverRoute = new ServerRoute(this.#robot);
      this.#setRoute("server");
      this.dispatchEvent(new CustomEvent("ready"));
    }
  }

  /** The server's own first messages may come after ours: sends again what they undid. */
  #settle() {
    if (!this.#bodyNode || this.#client.busy) return;
    this.#looks += 1;
    if (SETTLING_POLLS.has(this.#looks)) this.#pushAll();
    else if (this.#shown && this.#table.nodes.some((name, index) => this.#strayed(name, index))) {
      this.#shown = null;
      this.#request();
    }
  }

  #strayed(name, index) {
    const at = this.#client.position(name);
    return (
      at !== null
      && at.some((value, axis) => Math.abs(value - this.#shown[index * VALUES_A_NODE + 4 + axis]) > STRAY)
    );
  }

  #setRoute(route) {
    if (route === this.route) return;
    this.route = route;
    if (route === "direct") this.#serverRoute?.close();
    this.dispatchEvent(new CustomEvent("route", { detail: route }));
  }

  #request(inFrame = false) {
    if (this.#pending) return;
    if (!document.hidden && !this.#client.busy) this.#showPose(inFrame);
    else
      this.#pending = requestAnimationFrame(() => {
        this.#pending = 0;
        this.#request(true);
      });
  }

  #showPose(inFrame) {
    if (!this.#table) {
      if (this.#bodyNode) this.#client.push(this.#extras());
      return;
    }
    const source = this.#measured?.robot === this.#table.robot ? this.#measured : this.#table;
    source.sample(this.#time, this.#pose);
    if (this.route === "server") {
      if (this.#serverRoute.send(this.#table.nodes, this.#pose)) this.posesShown += 1;
      return;
    }
    if (!this.#bodyNode) return;
    const isNew = this.#marks.isNew;
    const before = this.#ghosts.moves + this.#tracks.moves;
    const messages = this.#extras();
    this.#table.nodes.forEach((name, index) => {
      const at = index * VALUES_A_NODE;
      if (this.#moved(at) && this.#client.node(name)) messages.push(...poseMessages(name, this.#pose, at));
    });
    this.#shown = Float32Array.from(this.#pose);
    if (messages.length === 0 && this.#ghosts.moves + this.#tracks.moves === before) return;
    this.#sharpness.moved();
    this.#client.push(messages, isNew);
    if (inFrame) this.#client.drawNow();
    this.posesShown += 1;
  }

  /** Marks, ghosts and tracks at the present time. */
  #extras() {
    const tracks = this.#tracks.messages(
      this.#time,
      this.#table?.duration ?? 0,
      floorOf(this.#marks.overlay),
    );
    return [...this.#marks.messages(this.#time), ...this.#ghosts.messages(this.#time), ...tracks];
  }

  #moved(at) {
    if (!this.#shown) return true;
    for (let i = at; i < at + VALUES_A_NODE; i += 1) {
      if (Math.abs(this.#shown[i] - this.#pose[i]) > STILL) return true;
    }
    return false;
  }

  /** Colours the robot. */
  #paint() {
    paintGrey(this.#client.node(ROBOT), this.#isGrey && !this.#measured, this.#dark);
    this.#client.push([]);
  }

  #pushAll() {
    this.#shown = null;
    this.#marks.forget();
    this.#ghosts.forget();
    this.#tracks.forget();
    this.#pushTheme();
    if (this.#isGrey) this.#paint();
    this.#request();
  }

  #pushTheme() {
    this.#client.root?.setAttribute("data-theme", this.#dark ? "dark" : "light");
    if (!this.#bodyNode) return;
    this.#client.push([
      visibleMessage("/floor/light", !this.#dark),
      visibleMessage("/floor/dark", this.#dark),
    ]);
  }

  #way() {
    return wayOf(this.#client, this.#marks.overlay, this.#table?.nodes ?? [], BODY);
  }
}
