/**
 * The one place that knows the inside of the embedded Viser client (pinned: viser 1.1).
 *
 * The client hangs its mutable state on its window (`__viserMutable`): the queue of messages that its next
 * frame handles, the scene nodes that exist by name, and a function that asks for a frame. Messages pushed
 * there are handled exactly as if the server had sent them. `available` is false where a version lacks any of
 * these; the browser tests fail then.
 */

import { groundView, spaceView } from "./ground.js";
import { drawLinePlainly, moveEnds } from "./plain_lines.js";
import { drawSurfacePlainly, leaveOutNoPicture } from "./plain_surfaces.js";

const SETTLE_MS = 250;
/** Angle of the view from straight above at most, rad: a little over the floor. */
const LOWEST_VIEW = 1.53;

export class ViserClient {
  #frame;
  #left = null;
  #leanRequest = null;
  #lateFrame = 0;
  #drawnFrame = null;

  /** @param {HTMLIFrameElement} frame of the same origin */
  constructor(frame) {
    this.#frame = frame;
  }

  get #inside() {
    const inside = this.#frame.contentWindow?.__viserMutable;
    const complete =
      inside
      && Array.isArray(inside.messageQueue)
      && typeof inside.requestRender === "function"
      && typeof inside.nodeRefFromName === "object";
    return complete && inside !== this.#left ? inside : null;
  }

  /** Opens another address in the frame; what is inside now is no longer spoken to. */
  open(address) {
    this.#left = this.#frame.contentWindow?.__viserMutable ?? null;
    this.#frame.src = address;
  }

  /** Whether messages can be pushed. */
  get available() {
    return this.#inside !== null;
  }

  /** Whether messages pushed before are still waiting for a frame. */
  get busy() {
    return (this.#inside?.messageQueue.length ?? 0) > 0;
  }

  /** The drawn object of a scene node, or undefined; a reconnection makes new ones. */
  node(name) {
    return this.#inside?.nodeRefFromName[name] ?? undefined;
  }

  /** Names of the nodes under a path that are drawn as meshes themselves. */
  meshes(path) {
    const isMesh = (node) => node?.isMesh || node?.children?.some((part) => part.isMesh && !part.name);
    return Object.entries(this.#inside?.nodeRefFromName ?? {})
      .filter(([name, node]) => name.startsWith(path) && isMesh(node))
      .map(([name]) => name);
  }

  /** Position [x, y, z] of a drawn node, or null. */
  position(name) {
    const node = this.node(name);
    return node ? [node.position.x, node.position.y, node.position.z] : null;
  }

  /**
   * Puts messages into the queue and asks for a frame.
   * @param {Record<string, any>[]} messages
   * @param {boolean} [atOnce] handles the queue now, so that lines and poses are drawn in one frame
   */
  push(messages, atOnce = false) {
    const inside = this.#inside;
    if (!inside) return false;
    for (const message of messages) inside.messageQueue.push(message);
    if (atOnce && !document.hidden) inside.drainMessageQueue?.();
    this.#requestFrame(inside);
    return true;
  }

  /**
   * Draws what has been pushed for the page's present frame, where there is no GPU: each frame of the page is
   * dear there, and the client, when asked for a frame at a time, draws in every second one.
   * @returns {boolean} false where it was left to the frame that is asked for: once a frame is enough
   */
  drawNow() {
    const state =
      this.drawsInSoftware && !document.hidden ? this.#inside?.scene?.__r3f?.root?.getState?.() : undefined;
    const frame = document.timeline.currentTime;
    if (!state?.advance || frame === this.#drawnFrame) return false;
    this.#drawnFrame = frame;
    state.advance(performance.now());
    return true;
  }

  /**
   * Asks for a frame. The client's own way draws for 250 ms on end, since some changes need a frame more;
   * without a GPU that holds up the whole page, so there it becomes one frame now and one after that time.
   */
  #requestFrame(inside) {
    const invalidate = this.drawsInSoftware ? inside.scene?.__r3f?.root?.getState?.().invalidate : undefined;
    if (invalidate && inside.requestRender !== this.#leanRequest) {
      this.#leanRequest = () => {
        invalidate();
        clearTimeout(this.#lateFrame);
        this.#lateFrame = setTimeout(invalidate, SETTLE_MS);
      };
      inside.requestRender = this.#leanRequest;
      this.#drawPlainly(inside.scene.__r3f.root.getState().scene);
    }
    inside.requestRender();
  }

  /** Looks before each frame for what the client has made anew since the last one. */
  #drawPlainly(scene) {
    scene.onBeforeRender = () =>
      scene.traverseVisible((part) => {
        drawLinePlainly(part);
        drawSurfacePlainly(part);
        leaveOutNoPicture(part);
      });
  }

  /** A message that sets properties of a node; arrays become arrays of the client's own window. */
  updateMessage(name, updates) {
    const inside = this.#frame.contentWindow;
    const own = (value) => (ArrayBuffer.isView(value) ? new inside[value.constructor.name](value) : value);
    const values = Object.fromEntries(Object.entries(updates).map(([key, value]) => [key, own(value)]));
    return { type: "SceneNodeUpdateMessage", name, owner: "", updates: values };
  }

  /**
   * Moves the ends of a node's line pieces without a message, which would make a new buffer each time.
   * @param {Float32Array} points n × 2 × 3 values
   * @returns {Record<string, any>[]} the message to be pushed where the buffer is unknown or of another size
   */
  moveSegments(name, points) {
    let lines = null;
    this.node(name)?.traverse(({ geometry }) => {
      if (geometry?.attributes?.instanceStart) lines ??= geometry;
    });
    if (!lines || !moveEnds(lines, points)) return [this.updateMessage(name, { points: points.slice() })];
    return [];
  }

  /** Whether the client draws without a GPU (viser_frame.js finds out). */
  get drawsInSoftware() {
    return this.#frame.contentWindow?.footfallSoftwareDrawing === true;
  }

  /** Draws this many pixels for a pixel of the page each way. */
  setPixelRatio(ratio) {
    this.#frame.contentWindow?.__viserTestpoints?.devSettings?.set?.({ fixedDpr: ratio });
    if (this.#inside) this.#requestFrame(this.#inside);
  }

  /** Calls back when a hand is on the view: a drag or the wheel. */
  onTouch(callback) {
    for (const type of ["pointerdown", "pointermove", "wheel"]) {
      this.#frame.contentWindow?.addEventListener(
        type,
        (event) => {
          if (type !== "pointermove" || event.buttons) callback();
        },
        { capture: true, passive: true },
      );
    }
  }

  /**
   * How a level plane of the scene is seen by the camera now.
   * @param {number} height of the plane, m
   * @returns {{toScreen: Function, toGround: Function}|null} between [x, y] in m and pixels of the frame
   */
  ground(height) {
    const inside = this.#inside;
    const root = this.node("/floor/light")?.parent;
    if (!inside?.camera || !inside.canvas || !root) return null;
    const { left, top, width, height: tall } = inside.canvas.getBoundingClientRect();
    const { projectionMatrix, matrixWorldInverse } = inside.camera;
    return groundView(
      [projectionMatrix, matrixWorldInverse, root.matrixWorld].map(({ elements }) => elements),
      height,
      { left, top, width, height: tall },
    );
  }

  /** What the camera sees: places of the scene in pixels of the frame, and its axes; null if not known. */
  view() {
    const inside = this.#inside;
    const root = this.node("/floor/light")?.parent;
    if (!inside?.camera || !inside.canvas || !root) return null;
    const { projectionMatrix, matrixWorldInverse } = inside.camera;
    const size = { width: inside.canvas.clientWidth, height: inside.canvas.clientHeight };
    return spaceView(
      [projectionMatrix, matrixWorldInverse, root.matrixWorld].map(({ elements }) => elements),
      size,
    );
  }

  /** Where the camera is going to stand and look at, [x, y, z] m in the scene; null where it is not known. */
  cameraPose() {
    const control = this.#inside?.cameraControl;
    const root = this.node("/floor/light")?.parent;
    if (!control?.getPosition || !root) return null;
    const e = root.matrixWorld.elements;
    const inScene = ({ x, y, z }) =>
      [0, 4, 8].map((column) => e[column] * x + e[column + 1] * y + e[column + 2] * z);
    return { position: inScene(control.getPosition()), target: inScene(control.getTarget()) };
  }

  /** Keeps the camera, and what it turns around, above a level plane of the scene, m. */
  keepCameraAbove(height) {
    const control = this.#inside?.cameraControl;
    if (!control?.setBoundary) return;
    control.maxPolarAngle = LOWEST_VIEW;
    // The client's own y points up.
    control.setBoundary({
      min: { x: -Infinity, y: height, z: -Infinity },
      max: { x: Infinity, y: Infinity, z: Infinity },
    });
  }

  /** Width and height of what is seen of the frame, px. */
  get visibleSize() {
    const { clientWidth, clientHeight, parentElement } = this.#frame;
    return { width: Math.min(clientWidth, parentElement?.clientWidth ?? clientWidth), height: clientHeight };
  }

  /** Root element of the client's page. */
  get root() {
    return this.#frame.contentDocument?.documentElement ?? null;
  }
}

export const poseMessages = (name, values, at) => [
  {
    type: "SetOrientationMessage",
    name,
    owner: "",
    wxyz: [values[at], values[at + 1], values[at + 2], values[at + 3]],
  },
  { type: "SetPositionMessage", name, owner: "", position: [values[at + 4], values[at + 5], values[at + 6]] },
];

export const visibleMessage = (name, visible) => ({
  type: "SetSceneNodeVisibilityMessage",
  name,
  owner: "",
  visible,
});

export const cameraMessages = (position, target) => [
  { type: "SetCameraLookAtMessage", look_at: target, initial: false },
  { type: "SetCameraPositionMessage", position, initial: false },
];
