/**
 * The robot's shadow on the floor, where there is a GPU (none on itself, since clear plates would
 * keep the light from all below them). Without a GPU it costs more than all the rest.
 */

import { visibleMessage } from "./viser_client.js";

const FLOOR = "/floor/shadow";
const LAMP = "/light/lamp";

/**
 * Messages that turn the shadow on.
 * @param {import("./viser_client.js").ViserClient} client
 * @returns {Record<string, any>[]} none where the client draws in software
 */
export function shadowMessages(client) {
  if (client.drawsInSoftware || !client.node(FLOOR)) return [];
  const parts = client.meshes("/robot/").map((name) => client.updateMessage(name, { cast_shadow: true }));
  return [...parts, client.updateMessage(LAMP, { cast_shadow: true }), visibleMessage(FLOOR, true)];
}
