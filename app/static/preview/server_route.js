/**
 * The slow way to the 3D scene, for a Viser client whose inside can't be reached: the page sends each pose to
 * the server, which moves the nodes. One pose is on its way at a time, so that a busy server is not buried.
 */

export class ServerRoute {
  #socket = null;
  #waiting = true;
  #nodes = null;
  #again = 0;
  #address;

  /** @param {string} robot the scene's robot */
  constructor(robot) {
    const scheme = location.protocol === "https:" ? "wss" : "ws";
    this.#address = `${scheme}://${location.host}/viser/poses?robot=${encodeURIComponent(robot)}`;
    this.#open();
  }

  /** Sends a pose if the server has taken the one before; returns whether it was sent. */
  send(nodes, pose) {
    if (this.#waiting) return false;
    if (nodes !== this.#nodes) this.#socket.send(JSON.stringify(nodes));
    this.#nodes = nodes;
    this.#waiting = true;
    this.#socket.send(pose.slice());
    return true;
  }

  close() {
    clearTimeout(this.#again);
    this.#socket.onclose = null;
    this.#socket.close();
    this.#waiting = true;
  }

  #open() {
    const socket = new WebSocket(this.#address);
    this.#socket = socket;
    this.#nodes = null;
    socket.onopen = () => {
      this.#waiting = false;
    };
    socket.onmessage = () => {
      this.#waiting = false;
    };
    socket.onclose = () => {
      this.#waiting = true;
      this.#again = setTimeout(() => this.#open(), 2000);
    };
  }
}
