/**
 * Quiet second robots: another version of the gait at the playhead's time, drawn with lines.
 *
 * A ghost comes once, as poses of its few parts with the lines of each in its own frame (app/scene/ghost.py).
 * In the scene it is one node of line pieces, whose corners are placed anew with each pose.
 */

import { GhostMarks } from "./ghost_marks.js";
import { PoseTable, VALUES_A_NODE } from "./poses.js";
import { visibleMessage } from "./viser_client.js";

const COLOURS = {
  before: { light: [112, 128, 156], dark: [132, 148, 176] },
  saved: { light: [158, 108, 196], dark: [180, 140, 216] },
  measured: { light: [14, 128, 120], dark: [64, 190, 178] },
  jog: { light: [58, 92, 204], dark: [125, 152, 243] },
  simulated: { light: [190, 62, 122], dark: [232, 124, 174] },
};

/** Places a part's line pieces by its pose. */
function place(lines, pose, at, into, start) {
  const [w, x, y, z, px, py, pz] = pose.subarray(at, at + VALUES_A_NODE);
  for (let i = 0; i < lines.length; i += 3) {
    const [a, b, c] = [lines[i], lines[i + 1], lines[i + 2]];
    // v + 2 q × (q × v + w v), for the quaternion's vector part q.
    const [tx, ty, tz] = [y * c - z * b + w * a, z * a - x * c + w * b, x * b - y * a + w * c];
    into[start + i] = a + 2 * (y * tz - z * ty) + px;
    into[start + i + 1] = b + 2 * (z * tx - x * tz) + py;
    into[start + i + 2] = c + 2 * (x * ty - y * tx) + pz;
  }
}

class Ghost {
  #table;
  #parts;
  #pose;
  #points;
  #time = null;

  constructor(buffer) {
    this.#table = new PoseTable(buffer);
    this.#parts = this.#table.overlay.lines.map((lines) => Float32Array.from(lines.flat(2)));
    this.#pose = new Float32Array(this.#table.nodes.length * VALUES_A_NODE);
    this.#points = new Float32Array(this.#parts.reduce((sum, lines) => sum + lines.length, 0));
  }

  /** The line pieces at a time, or null where they are where they were. */
  at(time) {
    const held = Math.min(Math.max(time, this.#table.start), this.#table.start + this.#table.duration);
    if (held === this.#time) return null;
    this.#time = held;
    this.#table.sample(held, this.#pose);
    let start = 0;
    this.#parts.forEach((lines, part) => {
      place(lines, this.#pose, part * VALUES_A_NODE, this.#points, start);
      start += lines.length;
    });
    return this.#points;
  }

  forget() {
    this.#time = null;
  }

  get table() {
    return this.#table;
  }

  /** The parts' poses at the time that was asked for last. */
  get pose() {
    return this.#pose;
  }
}

export class Ghosts {
  #client;
  #ghosts = new Map();
  #news = new Set(Object.keys(COLOURS));
  #theme = "light";
  #marks;
  /** How often a ghost was placed. */
  moves = 0;

  /** @param {import("./viser_client.js").ViserClient} client */
  constructor(client) {
    this.#client = client;
    this.#marks = new GhostMarks(client, place);
  }

  /**
   * @param {"before"|"saved"|"measured"|"simulated"|"jog"} kind
   * @param {ArrayBuffer|null} buffer null takes the ghost away
   */
  set(kind, buffer) {
    if (buffer) this.#ghosts.set(kind, new Ghost(buffer));
    else this.#ghosts.delete(kind);
    this.#news.add(kind);
    if (kind === "simulated") this.#marks.set(this.#ghosts.get(kind)?.table ?? null);
  }

  setDark(dark) {
    this.#theme = dark ? "dark" : "light";
    this.forget();
  }

  /** The client's scene is new: everything has to be sent again. */
  forget() {
    for (const kind of Object.keys(COLOURS)) this.#news.add(kind);
    this.#marks.forget();
  }

  /** Messages that bring the ghosts up to a time. */
  messages(time) {
    const messages = Object.keys(COLOURS).flatMap((kind) => this.#messagesOf(kind, time));
    return [...messages, ...this.#marks.messages(time, this.#ghosts.get("simulated")?.pose)];
  }

  #messagesOf(kind, time) {
    const [name, ghost] = [`/ghost/${kind}`, this.#ghosts.get(kind)];
    if (!this.#client.node(name)) return [];
    const isNew = this.#news.delete(kind);
    if (isNew) ghost?.forget();
    const points = ghost?.at(time);
    const messages = isNew ? [visibleMessage(name, Boolean(ghost))] : [];
    if (!points) return messages;
    this.moves += 1;
    if (isNew)
      messages.push(
        this.#client.updateMessage(name, { points, colors: Uint8Array.from(COLOURS[kind][this.#theme]) }),
      );
    else messages.push(...this.#client.moveSegments(name, points));
    return messages;
  }
}
