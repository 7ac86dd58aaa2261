/**
 * Without a GPU: coarse pixels while anything moves, fine ones once it stands still.
 *
 * Software drawing has no antialiasing here; drawing a still view finer than the screen does the same.
 */

const MOVING_RATIO = 0.8;
const STILL_RATIO = 1.5;
const STILL_AFTER_MS = 450;

export class Sharpness {
  #client;
  #timer = 0;
  #ratio = null;

  /** @param {import("./viser_client.js").ViserClient} client */
  constructor(client) {
    this.#client = client;
  }

  /** Call when the client's page is there. */
  attach() {
    if (!this.#client.drawsInSoftware) return;
    if (this.#ratio === null) this.#client.onTouch(() => this.moved());
    this.#ratio = 0;
    this.moved();
  }

  /** Something moves in the view. */
  moved() {
    if (this.#ratio === null) return;
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => this.#set(STILL_RATIO), STILL_AFTER_MS);
    this.#set(MOVING_RATIO);
  }

  dispose() {
    clearTimeout(this.#timer);
  }

  #set(ratio) {
    if (ratio === this.#ratio) return;
    this.#ratio = ratio;
    this.#client.setPixelRatio(ratio);
  }
}
