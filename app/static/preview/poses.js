/**
 * A plan's poses as they come from the server, and the pose between two frames.
 *
 * Layout (little-endian): 4-byte length of the header; JSON header, padded to a multiple of 4; frames × nodes
 * × 7 float32: quaternion w x y z, then position x y z in m. app/scene/poses.py writes it.
 */

export const VALUES_A_NODE = 7;
const CUT_SHORT = "The poses of this plan are not complete. Reload the page.";

export class PoseTable {
  /** @param {ArrayBuffer} buffer */
  constructor(buffer) {
    const length = buffer.byteLength < 4 ? 0 : new DataView(buffer).getUint32(0, true);
    if (length === 0 || 4 + length > buffer.byteLength) throw new Error(CUT_SHORT);
    const header = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length)));
    if (header.format !== "footfall-poses" || header.version !== 1) {
      throw new Error(
        `The poses have an unknown format (${header.format} ${header.version}). Reload the page.`,
      );
    }
    const count = header.frames * header.nodes.length * VALUES_A_NODE;
    if (buffer.byteLength < 4 + length + 4 * count) throw new Error(CUT_SHORT);
    this.robot = header.robot;
    this.nodes = header.nodes;
    this.frames = header.frames;
    this.start = header.start;
    this.step = header.step;
    this.overlay = header.overlay ?? null;
    this.values = new Float32Array(buffer, 4 + length, count);
  }

  get duration() {
    return this.step * (this.frames - 1);
  }

  /**
   * All nodes' poses at a time, linear between frames.
   * @param {number} time s, held inside the plan
   * @param {Float32Array} into nodes × 7 values that are overwritten
   */
  sample(time, into) {
    const width = this.nodes.length * VALUES_A_NODE;
    const place = this.step > 0 ? (time - this.start) / this.step : 0;
    const held = Math.min(Math.max(place, 0), this.frames - 1);
    const before = Math.min(Math.floor(held), Math.max(this.frames - 2, 0));
    const part = held - before;
    const low = before * width;
    const high = this.frames > 1 ? low + width : low;
    for (let at = 0; at < width; at += VALUES_A_NODE) this.#mix(low + at, high + at, part, into, at);
  }

  #mix(low, high, part, into, at) {
    const { values } = this;
    let dot = 0;
    for (let i = 0; i < 4; i += 1) dot += values[low + i] * values[high + i];
    const sign = dot < 0 ? -1 : 1;
    let squares = 0;
    for (let i = 0; i < 4; i += 1) {
      const value = values[low + i] * (1 - part) + sign * values[high + i] * part;
      into[at + i] = value;
      squares += value * value;
    }
    const scale = 1 / Math.sqrt(squares);
    for (let i = 0; i < 4; i += 1) into[at + i] *= scale;
    for (let i = 4; i < VALUES_A_NODE; i += 1) {
      into[at + i] = values[low + i] * (1 - part) + values[high + i] * part;
    }
  }
}

/** The bytes of the poses at an address. */
export async function downloaded(url) {
  const answer = await fetch(url);
  if (!answer.ok)
    throw new Error(`The poses of this plan could not be loaded (${answer.status}). Reload the page.`);
  return answer.arrayBuffer();
}
