/**
 * The marks round the robot as messages to the client: support polygon, centres of mass and pressure with
 * their traces, swings, footholds, what is infeasible, and the reach of the legs. Only changes are sent.
 */

import { contactShadow } from "./contact_shadow.js";
import {
  floorOf,
  planUpdates,
  polygonUpdates,
  pressureAt,
  sampleAt,
  standing,
  troubleUpdates,
} from "./overlay.js";
import { visibleMessage } from "./viser_client.js";

export const COM = "/overlay/com";
const COP = "/overlay/cop";
const SHELLS = "/robot/body/reach";
const SHADOW = "/overlay/contact_shadow";
export const STILL = 1e-7;

/** Marks of a fixed name by the part that shows or hides them; swings and footholds have a mark a foot. */
const PARTS = {
  polygon: ["/overlay/polygon", "/overlay/polygon_edge"],
  com: [COM, "/overlay/com_trace"],
  cop: [COP, "/overlay/cop_trace"],
  trouble: ["/overlay/trouble"],
  reach: [SHELLS],
  shadow: [SHADOW],
};

export class Marks {
  #client;
  #overlay = null;
  #trouble = [];
  #shells = null;
  #caution = 0.003;
  #theme = "light";
  #isGrey = false;
  #visible = {
    polygon: true,
    com: true,
    cop: true,
    traces: true,
    footholds: true,
    trouble: true,
    robot: true,
    reach: false,
    shadow: true,
  };
  #planSent = false;
  #visibleSent = null;
  #sample = -1;
  #shellSent = null;
  #pressure = null;
  #sent = new Map();

  /** @param {import("./viser_client.js").ViserClient} client */
  constructor(client) {
    this.#client = client;
  }

  get overlay() {
    return this.#overlay;
  }

  /** Whether nothing of the plan has been sent yet. */
  get isNew() {
    return !this.#planSent;
  }

  setOverlay(overlay, trouble = this.#trouble) {
    this.#overlay = overlay;
    this.#trouble = trouble;
    this.#shells = null;
    this.#again();
  }

  setTrouble(trouble) {
    this.#trouble = trouble;
    this.#sample = -1;
  }

  setShells(shells) {
    this.#shells = shells;
    this.#shellSent = null;
    this.#sample = -1;
    this.#planSent = false;
  }

  /** The robot is drawn by another plan than the gait's own: its support is no support of the gait. */
  setGrey(isGrey) {
    this.#isGrey = isGrey;
    this.#sample = -1;
  }

  setCaution(metres) {
    this.#caution = metres;
    this.#sample = -1;
  }

  setDark(dark) {
    this.#theme = dark ? "dark" : "light";
    this.#planSent = false;
    this.#sample = -1;
  }

  show(part, visible) {
    // What is hidden does not follow the playhead.
    if (part === "reach" && visible && !this.#visible.reach) this.#sample = -1;
    this.#visible[part] = visible;
  }

  /** The client's scene is new: everything has to be sent again. */
  forget() {
    this.#visibleSent = null;
    this.#sent.clear();
    this.#again();
  }

  #again() {
    this.#planSent = false;
    this.#sample = -1;
    this.#shellSent = null;
    this.#pressure = null;
  }

  /** Messages that bring the marks up to a time. */
  messages(time) {
    return [...this.#planMessages(), ...this.#sampleMessages(time), ...this.#pressureMessages(time)];
  }

  /** What stays the same all through the plan. */
  #planMessages() {
    if (this.#planSent) return [];
    this.#planSent = true;
    const lines = this.#overlay ? this.#updates(planUpdates(this.#overlay, this.#theme)) : [];
    return [...lines, ...this.visibleMessages()];
  }

  #sampleMessages(time) {
    if (!this.#overlay) return [];
    const sample = sampleAt(this.#overlay.times, time);
    if (sample === this.#sample) return [];
    this.#sample = sample;
    return this.#updates([
      ...polygonUpdates(this.#overlay, sample, this.#caution, this.#trouble, this.#theme, this.#isGrey),
      troubleUpdates(this.#overlay, sample, this.#trouble, this.#theme),
      ...this.#shellUpdates(sample),
      [SHADOW, contactShadow(standing(this.#overlay, sample), floorOf(this.#overlay))],
    ]);
  }

  /** The reach changes with the body's height only, which seldom changes. */
  #shellUpdates(sample) {
    const height = this.#shells?.planes[sample];
    if (!this.#visible.reach || height === undefined || height === this.#shellSent) return [];
    this.#shellSent = height;
    return [[SHELLS, shellUpdate(this.#shells, sample)]];
  }

  #pressureMessages(time) {
    const at = this.#overlay ? pressureAt(this.#overlay, time) : null;
    if (
      !at
      || !this.#client.node(COP)
      || (this.#pressure && Math.hypot(at[0] - this.#pressure[0], at[1] - this.#pressure[1]) < STILL)
    )
      return [];
    this.#pressure = at;
    return [{ type: "SetPositionMessage", name: COP, owner: "", position: at }];
  }

  /** Changes of what is visible. */
  visibleMessages() {
    const known = (name) => this.#client.node(name);
    const wanted = Object.entries(PARTS).flatMap(([part, names]) =>
      names.map((name) => [name, this.#visible[part] && this.#has(part)]),
    );
    for (let foot = 1; known(`/overlay/swing${foot}`); foot += 1) {
      wanted.push(
        [`/overlay/swing${foot}`, this.#visible.traces && this.#has("traces")],
        [`/overlay/foothold${foot}`, this.#visible.footholds && this.#has("footholds")],
      );
    }
    const messages = wanted.filter(([name]) => known(name)).map(([name, on]) => visibleMessage(name, on));
    messages.push(visibleMessage("/robot", this.#visible.robot));
    // Each of these costs the client a walk over its tree and a frame: send only changes.
    const key = JSON.stringify(messages);
    if (key === this.#visibleSent) return [];
    this.#visibleSent = key;
    return messages;
  }

  #has(part) {
    if (part === "reach") return this.#shells !== null;
    return this.#overlay !== null && (part !== "cop" || Boolean(this.#overlay.cop));
  }

  #updates(updates) {
    return updates
      .filter(([name, values]) => this.#client.node(name) && this.#isNews(name, values))
      .map(([name, values]) => this.#client.updateMessage(name, values));
  }

  /** Whether a mark differs from what was sent last: it costs a new geometry, and most feet keep theirs. */
  #isNews(name, values) {
    const key = `${name} ${Object.keys(values)}`;
    const [before, now] = [
      this.#sent.get(key),
      Object.values(values).flatMap((value) =>
        ArrayBuffer.isView(value) ? [.../** @type {Float32Array} */ (value)] : value,
      ),
    ];
    this.#sent.set(key, now);
    return !before || before.length !== now.length || now.some((value, index) => value !== before[index]);
  }
}

const POSTS = 6;

/** A colour's share as light: the client takes colours of line ends for that, else it shows them paler. */
const asLight = (value) =>
  Math.round(255 * (value > 10 ? ((value / 255 + 0.055) / 1.055) ** 2.4 : value / 255 / 12.92));

/** A point of a module's frame (y outwards) in the robot's. */
function inRobot(azimuth, radius, [x, y], z) {
  const [cosine, sine] = [Math.cos(azimuth), Math.sin(azimuth)];
  return [(radius + y) * cosine + x * sine, (radius + y) * sine - x * cosine, z];
}

/** Points of a layer's outline in the module's frame; null where nothing of it can be reached. */
function outline(radii) {
  if (radii.some((radius) => radius <= 0)) return null;
  return radii.map((radius, ray) => [
    radius * Math.cos((2 * Math.PI * ray) / radii.length),
    radius * Math.sin((2 * Math.PI * ray) / radii.length),
  ]);
}

/** Index pairs [layer, ray] of the lines: round each layer, and a few posts from layer to layer. */
function* edges(rings) {
  for (let layer = 0; layer < rings.length; layer += 1) {
    if (!rings[layer]) continue;
    const rays = rings[layer].length;
    for (let ray = 0; ray < rays; ray += 1)
      yield [
        [layer, ray],
        [layer, (ray + 1) % rays],
      ];
    if (!rings[layer + 1]) continue;
    for (let ray = 0; ray < rays; ray += rays / POSTS)
      yield [
        [layer, ray],
        [layer + 1, ray],
      ];
  }
}

/**
 * Line pieces of every leg's reach at a sample, each in its foot's colour.
 * @param {Record<string, any>} shells as `GET …/reach` gives it: `radii` [sample][layer][ray]; heights of
 *   `layers` and actuator `planes` over the standing feet; how deep the `sole` is under the foot's point, m
 * @param {number} sample
 * @returns {{points: Float32Array, colors: Uint8Array}}
 */
function shellUpdate(shells, sample) {
  const { layers, planes, sole, azimuths, radius, colours } = shells;
  const rings = shells.radii[sample].map(outline);
  const [points, colors] = [[], []];
  const lights = colours.map((colour) => colour.map(asLight));
  azimuths.forEach((azimuth, leg) => {
    for (const ends of edges(rings)) {
      for (const [layer, ray] of ends) {
        points.push(...inRobot(azimuth, radius, rings[layer][ray], layers[layer] - planes[sample] - sole));
        colors.push(...lights[leg]);
      }
    }
  });
  if (points.length === 0) return { points: new Float32Array(6), colors: new Uint8Array(6) };
  return { points: Float32Array.from(points), colors: Uint8Array.from(colors) };
}
