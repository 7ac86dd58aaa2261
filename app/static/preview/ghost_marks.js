/**
 * Contact marks of the simulated robot: a ring under each foot that carries load, a line where a foot slid.
 *
 * They come with the simulated ghost (app/scene/simulated_ghost.py): `contacts`, a string of 0 and 1 a frame,
 * `slips`, lines on the floor, and `sole`, the sole's depth under the foot's node.
 */

import { VALUES_A_NODE } from "./poses.js";
import { visibleMessage } from "./viser_client.js";

const CONTACT = "/ghost/contact";
const SLIP = "/ghost/slip";
const RING_RADIUS = 0.011;
const RING_PIECES = 12;
const COLOURS = { [CONTACT]: [31, 138, 91], [SLIP]: [192, 54, 44] };

/** Corners of a foot's ring in its own frame, as line pieces. */
function ring(sole) {
  const corner = (at) => [
    RING_RADIUS * Math.cos((2 * Math.PI * at) / RING_PIECES),
    RING_RADIUS * Math.sin((2 * Math.PI * at) / RING_PIECES),
    -sole,
  ];
  return Float32Array.from(
    Array.from({ length: RING_PIECES }, (_, at) => [...corner(at), ...corner(at + 1)]).flat(),
  );
}

export class GhostMarks {
  #client;
  #table = null;
  #place;
  #feet = [];
  #ring = null;
  #points = null;
  #isNew = true;

  /**
   * @param {import("./viser_client.js").ViserClient} client
   * @param {Function} place places line pieces by a pose (see ghosts.js)
   */
  constructor(client, place) {
    this.#client = client;
    this.#place = place;
  }

  /** @param {import("./poses.js").PoseTable|null} table of a ghost; one without contacts has no marks */
  set(table) {
    this.#table = table?.overlay?.contacts ? table : null;
    this.#isNew = true;
    if (!this.#table) return;
    this.#feet = this.#table.nodes.flatMap((name, index) => (name.endsWith("_foot") ? [index] : []));
    this.#ring = ring(this.#table.overlay.sole);
    this.#points = new Float32Array(this.#feet.length * this.#ring.length);
  }

  /** The client's scene is new: everything has to be sent again. */
  forget() {
    this.#isNew = true;
  }

  /** Messages that bring the marks up to a time, by the parts' poses at it. */
  messages(time, pose) {
    if (!this.#client.node(CONTACT) || !this.#client.node(SLIP)) return [];
    const messages = this.#isNew ? this.#newMessages() : [];
    if (this.#table && pose) messages.push(...this.#contactMessages(time, pose));
    this.#isNew = false;
    return messages;
  }

  #newMessages() {
    const slips = Float32Array.from(this.#table?.overlay.slips.flat(2) ?? []);
    const lines = {
      points: slips.length ? slips : new Float32Array(6),
      colors: Uint8Array.from(COLOURS[SLIP]),
    };
    return [
      this.#client.updateMessage(SLIP, lines),
      ...[CONTACT, SLIP].map((name) => visibleMessage(name, this.#table !== null)),
    ];
  }

  #contactMessages(time, pose) {
    const { contacts } = this.#table.overlay;
    const { start, step } = this.#table;
    const frame =
      step > 0 ? Math.min(Math.max(Math.round((time - start) / step), 0), contacts.length - 1) : 0;
    this.#points.fill(0);
    this.#feet.forEach((node, foot) => {
      if (contacts[frame][foot] === "1")
        this.#place(this.#ring, pose, node * VALUES_A_NODE, this.#points, foot * this.#ring.length);
    });
    if (!this.#isNew) return this.#client.moveSegments(CONTACT, this.#points);
    return [
      this.#client.updateMessage(CONTACT, {
        points: this.#points.slice(),
        colors: Uint8Array.from(COLOURS[CONTACT]),
      }),
    ];
  }
}
