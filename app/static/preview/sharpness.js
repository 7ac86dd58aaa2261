/**
 * Without a GPU: draws at screen resolution while anything moves, and finer once the view is still.
 *
 * Software drawing has no antialiasing here; drawing a still view finer than the screen does the same. Making
 * the drawing smaller holds up the page for about 100 ms (making it larger does not), so that this is done
 * ahead of an edit, when the pointer comes near what edits, and not in the middle of it.
 */

const MOVING_RATIO = 1;
const STILL_RATIO = 1.5;
const STILL_AFTER_MS = 600;
const STILL_AFTER_MOVES = 4;
const MOST_PACE_MS = 1000;

export class Sharpness {
  #client;
  #timer = 0;
  #ratio = null;
  #held = false;
  #page = null;
  #lastMove = -Infinity;
  #pace = 0;

  /** @param {import("./viser_client.js").ViserClient} client */
  constructor(client) {
    this.#client = client;
  }

  /** Call when the client's page is there. */
  attach() {
    if (!this.#client.drawsInSoftware) return;
    if (this.#page !== this.#client.root) this.#client.onTouch(() => this.moved());
    this.#page = this.#client.root;
    this.#ratio = 0;
    this.moved();
  }

  /** More is about to move, until this is called with false: coarse pixels, and no fine drawing meanwhile. */
  hold(held) {
    if (held === this.#held) return;
    this.#held = held;
    if (held) this.moved();
    else this.#sharpenLater();
  }

  /** Something moves in the view. */
  moved() {
    if (this.#ratio === null) return;
    const now = performance.now();
    this.#pace = Math.min(now - this.#lastMove, MOST_PACE_MS);
    this.#lastMove = now;
    this.#sharpenLater();
    this.#set(MOVING_RATIO);
  }

  #sharpenLater() {
    clearTimeout(this.#timer);
    // On a busy machine even a playing view stands still for long between two poses.
    const wait = Math.max(STILL_AFTER_MS, STILL_AFTER_MOVES * this.#pace);
    if (!this.#held && this.#ratio !== null) this.#timer = setTimeout(() => this.#set(STILL_RATIO), wait);
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
