/**
 * The one place that knows the inside of the embedded Viser client (pinned: viser 1.1).
 *
 * The client hangs its mutable state on its window (`__viserMutable`): the queue of messages that its next frame
 * handles, the scene nodes that exist by name, and a function that asks for a frame. Messages pushed there are
 * handled exactly as if the server had sent them. `available` is false where a version lacks any of these; the
 * browser tests fail then.
 */

export class ViserClient {
  #frame;

  /** @param {HTMLIFrameElement} frame of the same origin */
  constructor(frame) {
    this.#frame = frame;
  }

  get #inside() {
    const inside = this.#frame.contentWindow?.__viserMutable;
    const complete =
      inside &&
      Array.isArray(inside.messageQueue) &&
      typeof inside.requestRender === "function" &&
      typeof inside.nodeRefFromName === "object";
    return complete ? inside : null;
  }

  /** Whether messages can be pushed. */
  get available() { return this.#inside !== null; }

  /** Whether messages pushed before are still waiting for a frame. */
  get busy() { return (this.#inside?.messageQueue.length ?? 0) > 0; }

  /** The drawn object of a scene node, or undefined; a reconnection makes new ones. */
  node(name) { return this.#inside?.nodeRefFromName[name] ?? undefined; }

  /** Position [x, y, z] of a drawn node, or null. */
  position(name) {
    const node = this.node(name);
    return node ? [node.position.x, node.position.y, node.position.z] : null;
  }

  /** Puts messages into the queue and asks for a frame. */
  push(messages) {
    const inside = this.#inside;
    if (!inside) return false;
    for (const message of messages) inside.messageQueue.push(message);
    inside.requestRender();
    return true;
  }

  /** A message that sets properties of a node; arrays become arrays of the client's own window. */
  updateMessage(name, updates) {
    const inside = this.#frame.contentWindow;
    const own = (value) => (ArrayBuffer.isView(value) ? new inside[value.constructor.name](value) : value);
    const values = Object.fromEntries(Object.entries(updates).map(([key, value]) => [key, own(value)]));
    return { type: "SceneNodeUpdateMessage", name, owner: "", updates: values };
  }

  /** Whether the client draws without a GPU (viser_frame.js finds out). */
  get drawsInSoftware() { return this.#frame.contentWindow?.footfallSoftwareDrawing === true; }

  /** Draws this many pixels for a pixel of the page each way. */
  setPixelRatio(ratio) {
    this.#frame.contentWindow?.__viserTestpoints?.devSettings?.set?.({ fixedDpr: ratio });
    this.#inside?.requestRender();
  }

  /** Calls back when a hand is on the view: a drag or the wheel. */
  onTouch(callback) {
    for (const type of ["pointerdown", "pointermove", "wheel"]) {
      this.#frame.contentWindow?.addEventListener(type, (event) => {
        if (type !== "pointermove" || event.buttons) callback();
      }, { capture: true, passive: true });
    }
  }

  /** Root element of the client's page. */
  get root() { return this.#frame.contentDocument?.documentElement ?? null; }
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
