/**
 * Foot tracks of trials on the ground, drawn over the shown gait; one mark a foot follows the playhead.
 *
 * Tracks come in the plan's frame (`GET /api/trials/{id}/scene`). What was filled, as a foot was not seen, is
 * drawn grey and broken, and so is the mark's ring. The playhead goes over the plan once: over the lap that
 * the track was asked for.
 */

import { visibleMessage } from "./viser_client.js";

const WAYS = "/tracks/ways";
const MARKS = "/tracks/marks";
const GREY = "#7c8698";
const LIFT = 0.0026;
const RING_RADIUS = 0.0145;
const RING_PIECES = 20;
const LEAST_PIECE = 0.0004;

/** "#2e9e5b" as red, green, blue; the client takes colours of single points as linear light. */
const rgb = (colour) =>
  [1, 3, 5].map((at) => 255 * (Number.parseInt(colour.slice(at, at + 2), 16) / 255) ** 2.2);
const UNSEEN = rgb(GREY);

/** Line pieces of a foot's way, [points, colours]; where it was not seen they are grey and broken. */
function pathLine(places, filled, colour, height) {
  const [points, colours] = [[], []];
  let [from, gaps] = [0, 0];
  for (let at = 1; at < places.length; at += 1) {
    const isGap = filled[at - 1] || filled[at];
    const turns = at + 1 < places.length && isGap !== (filled[at] || filled[at + 1]);
    // Feet mostly stand: a piece too short to see is left out.
    if (
      !turns
      && at + 1 < places.length
      && Math.hypot(places[at][0] - places[from][0], places[at][1] - places[from][1]) < LEAST_PIECE
    )
      continue;
    gaps += isGap ? 1 : 0;
    if (!isGap || gaps % 2) {
      points.push(...places[from], height, ...places[at], height);
      colours.push(...(isGap ? UNSEEN : colour), ...(isGap ? UNSEEN : colour));
    }
    from = at;
  }
  return [points, colours];
}

/** Where in a growing list a value lies: the index before it, and the share of the way to the next. */
function placeIn(values, value) {
  let at = 0;
  while (at + 2 < values.length && values[at + 1] <= value) at += 1;
  const part = (value - values[at]) / ((values[at + 1] ?? value) - values[at] || 1);
  return [at, Math.min(Math.max(part, 0), 1)];
}

/**
 * Puts a ring round a place, wider than a sole, into line pieces.
 * @param {Float32Array} into
 * @param {number} start
 * @param {number[]} at
 * @param {number} height
 * @param {boolean} isBroken every second piece is missing, since the foot was not seen
 */
function ringInto(into, start, [x, y], height, isBroken) {
  for (let piece = 0; piece < RING_PIECES; piece += 1) {
    const length = isBroken && piece % 2 ? 0 : 1;
    const corners = [piece, piece + length].map((corner) => (2 * Math.PI * corner) / RING_PIECES);
    corners.forEach((angle, end) => {
      into.set(
        [x + RING_RADIUS * Math.cos(angle), y + RING_RADIUS * Math.sin(angle), height],
        start + 6 * piece + 3 * end,
      );
    });
  }
}

export class Tracks {
  #client;
  #tracks = [];
  #isNew = false;
  #share = null;
  #points = new Float32Array(6);
  /** How often the marks were placed. */
  moves = 0;

  /** @param {import("./viser_client.js").ViserClient} client */
  constructor(client) {
    this.#client = client;
  }

  /** @param {Record<string, any>[]} tracks of trials; none takes them away */
  set(tracks) {
    this.#tracks = tracks;
    this.#points = new Float32Array(Math.max(this.#feet.length, 1) * RING_PIECES * 6);
    this.forget();
  }

  /** The client's scene is new: everything has to be sent again. */
  forget() {
    this.#isNew = true;
    this.#share = null;
  }

  get #feet() {
    return this.#tracks.flatMap((track) =>
      track.feet.map((places, foot) => ({
        track,
        places,
        filled: track.filled[foot],
        colour: rgb(track.colours[foot]),
      })),
    );
  }

  /**
   * Messages that bring lines and marks up to a time.
   * @param {number} time of the plan, s
   * @param {number} duration of the plan, s
   * @param {number} floor its height, m
   */
  messages(time, duration, floor) {
    const share = duration > 0 ? time / duration : 0;
    if (
      !this.#client.node(WAYS)
      || !this.#client.node(MARKS)
      || (!this.#isNew && (share === this.#share || !this.#tracks.length))
    )
      return [];
    const messages = this.#isNew ? this.#newMessages(floor + LIFT) : [];
    this.#share = share;
    if (this.#tracks.length) messages.push(...this.#markMessages(share, floor + LIFT));
    this.#isNew = false;
    return messages;
  }

  #newMessages(height) {
    const shown = [WAYS, MARKS].map((name) => visibleMessage(name, this.#tracks.length > 0));
    if (!this.#tracks.length) return shown;
    const ways = this.#feet.map(({ places, filled, colour }) => pathLine(places, filled, colour, height));
    const [points, colours] = [0, 1].map((index) => ways.flatMap((way) => way[index]));
    return [
      this.#client.updateMessage(WAYS, {
        points: Float32Array.from(points),
        colors: Uint8Array.from(colours),
      }),
      ...shown,
    ];
  }

  #markMessages(share, height) {
    this.#feet.forEach(({ track, places, filled }, index) => {
      const [at, part] = placeIn(
        track.shares,
        track.playing[0] + share * (track.playing[1] - track.playing[0]),
      );
      const next = Math.min(at + 1, places.length - 1);
      const place = [0, 1].map((axis) => places[at][axis] * (1 - part) + places[next][axis] * part);
      ringInto(this.#points, index * RING_PIECES * 6, place, height, filled[part < 0.5 ? at : next]);
    });
    this.moves += 1;
    if (!this.#isNew) return this.#client.moveSegments(MARKS, this.#points);
    const colors = Uint8Array.from(
      this.#feet.flatMap(({ colour }) =>
        Array(RING_PIECES * 2)
          .fill(colour)
          .flat(),
      ),
    );
    return [this.#client.updateMessage(MARKS, { points: this.#points.slice(), colors })];
  }
}
