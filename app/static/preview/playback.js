/**
 * The playback clock: one playhead for the 3D preview, the timeline and the plots.
 *
 * The browser's own clock is the master; nothing waits for the server. Times are seconds of the plan.
 *
 *   const playback = new Playback({ duration: 15.6, step: 0.4 });
 *   playback.addEventListener("time", (event) => preview.setTime(event.detail.time));
 *   playback.addEventListener("state", ({ detail }) => setText(button, detail.playing ? "Pause" : "Play"));
 *
 * Properties (read only): time, duration, playing, speed, loop ([start, end] or null).
 * Methods:
 *   setPlan(duration, samples)     another plan: the playhead stays, held inside the new duration; `samples`
 *                                  is the time between two of them, or the time of each
 *   play() pause() toggle()        play at the end starts over
 *   setTime(seconds)               scrubs, held inside [0, duration]; playing goes on from there
 *   step(count = 1)                pauses and moves by whole samples, negative backwards
 *   toStart() toEnd()
 *   setSpeed(factor)               0.1 to 10, held inside that range; returns what was set
 *   setLoop([start, end] | true | false)
 *   dispose()
 * Events (CustomEvent, detail is { time, playing, speed, loop, duration, cause }):
 *   "time"   the playhead moved; cause is "clock", "scrub" or "plan". At most once a frame while playing.
 *   "state"  play, pause, end, speed, loop or plan changed.
 *   "end"    the playhead reached the end without a loop; "state" follows.
 */

import { clamp } from "../lib/clamp.js";

const SLOWEST = 0.1;
const FASTEST = 10;

/** Index of the time that is nearest. */
const nearest = (times, time) =>
  times.reduce((best, one, index) => (Math.abs(one - time) < Math.abs(times[best] - time) ? index : best), 0);

export class Playback extends EventTarget {
  #time = 0;
  #duration;
  #samples;
  #speed = 1;
  #loop = null;
  #playing = false;
  #request = 0;
  #lastTick = 0;
  #now;
  #requestFrame;
  #cancelFrame;

  /**
   * @param {object} options
   * @param {number} [options.duration] of the plan, s
   * @param {number} [options.step] between two samples, s
   * @param {() => number} [options.now] clock in ms; tests give their own
   * @param {(callback: () => void) => number} [options.requestFrame]
   * @param {(request: number) => void} [options.cancelFrame]
   */
  constructor({
    duration = 0,
    step = 0.1,
    now = () => performance.now(),
    requestFrame = (callback) => requestAnimationFrame(callback),
    cancelFrame = (request) => cancelAnimationFrame(request),
  } = {}) {
    super();
    this.#duration = Math.max(0, duration);
    this.#samples = step;
    this.#now = now;
    this.#requestFrame = requestFrame;
    this.#cancelFrame = cancelFrame;
  }

  get time() {
    return this.#time;
  }
  get duration() {
    return this.#duration;
  }
  get speed() {
    return this.#speed;
  }
  get loop() {
    return this.#loop;
  }
  get playing() {
    return this.#playing;
  }

  setPlan(duration, samples = this.#samples) {
    this.#duration = Math.max(0, duration);
    this.#samples = samples;
    if (this.#loop) this.#loop = this.#loopWithin(this.#loop);
    if (this.#duration === 0) this.#stop();
    this.#moveTo(this.#time, "plan");
    this.#announce("state", "plan");
  }

  play() {
    if (this.#playing || this.#duration === 0) return;
    const end = this.#loop ? this.#loop[1] : this.#duration;
    if (this.#time >= end - 1e-9) this.#moveTo(this.#loop ? this.#loop[0] : 0, "scrub");
    this.#playing = true;
    this.#lastTick = this.#now();
    this.#request = this.#requestFrame(() => this.#tick());
    this.#announce("state", "play");
  }

  pause() {
    if (!this.#playing) return;
    this.#advance();
    if (!this.#playing) return;
    this.#stop();
    this.#announce("state", "pause");
  }

  toggle() {
    if (this.#playing) this.pause();
    else this.play();
  }

  setTime(seconds) {
    this.#lastTick = this.#now();
    this.#moveTo(seconds, "scrub");
  }

  step(count = 1) {
    this.pause();
    const times = Array.isArray(this.#samples) ? this.#samples : null;
    if (times) this.setTime(times[clamp(nearest(times, this.#time) + count, 0, times.length - 1)]);
    else this.setTime(Math.round(this.#time / this.#samples + count) * this.#samples);
  }

  toStart() {
    this.setTime(0);
  }
  toEnd() {
    this.setTime(this.#duration);
  }

  setSpeed(factor) {
    if (this.#playing) this.#advance();
    this.#speed = clamp(Number.isFinite(factor) ? factor : 1, SLOWEST, FASTEST);
    this.#announce("state", "speed");
    return this.#speed;
  }

  setLoop(loop) {
    if (loop === true) this.#loop = [0, this.#duration];
    else if (!loop) this.#loop = null;
    else this.#loop = this.#loopWithin(loop);
    this.#announce("state", "loop");
  }

  dispose() {
    this.#stop();
  }

  #loopWithin([start, end]) {
    const low = clamp(Math.min(start, end), 0, this.#duration);
    const high = clamp(Math.max(start, end), 0, this.#duration);
    return high - low > 1e-6 ? [low, high] : [0, this.#duration];
  }

  #tick() {
    if (!this.#playing) return;
    this.#advance();
    if (this.#playing) this.#request = this.#requestFrame(() => this.#tick());
  }

  #advance() {
    const now = this.#now();
    const time = this.#time + ((now - this.#lastTick) / 1000) * this.#speed;
    this.#lastTick = now;
    if (this.#loop && time >= this.#loop[1]) {
      const [start, end] = this.#loop;
      this.#moveTo(start + ((time - start) % (end - start)), "clock");
    } else if (time >= this.#duration) {
      this.#moveTo(this.#duration, "clock");
      this.#stop();
      this.#announce("end", "end");
      this.#announce("state", "end");
    } else {
      this.#moveTo(time, "clock");
    }
  }

  #moveTo(seconds, cause) {
    const time = clamp(Number.isFinite(seconds) ? seconds : 0, 0, this.#duration);
    if (time === this.#time && cause !== "plan") return;
    this.#time = time;
    this.#announce("time", cause);
  }

  #stop() {
    this.#playing = false;
    this.#cancelFrame(this.#request);
  }

  #announce(type, cause) {
    const detail = {
      time: this.#time,
      playing: this.#playing,
      speed: this.#speed,
      loop: this.#loop,
      duration: this.#duration,
      cause,
    };
    this.dispatchEvent(new CustomEvent(type, { detail }));
  }
}
