/** Which robot to connect: the emulated one, a serial device of this computer, or another address. */

import { api } from "../api/gaits.js";
import { h, onPress, setAttribute, setText } from "../lib/dom.js";
import { latestOnly } from "../lib/latest_only.js";
import { report } from "../lib/toasts.js";

const EMULATOR = "emulator";
const OTHER = "other";
const POLL_MS = 2000;

const shortName = (device) => device.replace(/^\/dev\//, "");

function portName({ device, description, serial_number: number }, last) {
  const detail = [
    description,
    number ? `no. ${number}` : null,
    last?.device === device ? "last used" : null,
  ].filter(Boolean);
  return [shortName(device), ...detail].join(" · ");
}

/** What can be chosen: value and text of each option. */
function choices({ ports, last }, device) {
  const known = ports.map((port) => [port.device, portName(port, last)]);
  const extra = [device, last?.device].filter(
    (one, index, all) =>
      one && one !== EMULATOR && all.indexOf(one) === index && !ports.some((port) => port.device === one),
  );
  return [
    [EMULATOR, "Emulated robot"],
    ...known,
    ...extra.map((one) => [one, `${shortName(one)}${one === last?.device ? " · last used" : ""}`]),
    [OTHER, "Another device or address…"],
  ];
}

function showChoices(select, options) {
  const known = JSON.stringify(options);
  if (select.dataset.known === known) return;
  select.dataset.known = known;
  select.replaceChildren(...options.map(([value, text]) => h("option", { value, text })));
}

/** The fields of the chooser; `words` and `again` stand in `offer`. */
function deviceFields() {
  const select = h("select", { "aria-label": "Device" });
  const title = "Enter a serial device such as /dev/ttyACM0, or a network address socket://HOST:PORT";
  const address = h("input", {
    "aria-label": "Address",
    title,
    placeholder: "/dev/… or socket://HOST:PORT",
    spellcheck: "false",
    autocomplete: "off",
    hidden: true,
  });
  const [words, again] = [h("span"), h("button", { text: "Connect there" })];
  const offer = h(
    "div",
    { class: "offer", role: "status", "aria-label": "Where the robot is now", hidden: true },
    words,
    again,
  );
  return { select, address, offer, words, again };
}

/**
 * Builds the chooser.
 * @param {() => void} connect connects what is chosen
 * @returns {{element: HTMLElement, offer: HTMLElement, value: () => string|undefined}} `offer` says where a
 *   board that hung up is plugged in now
 */
export function portChooser(store, connect) {
  const { select, address, offer, words, again } = deviceFields();
  let found = { ports: [], last: null, again: null };
  let chosen = null;
  let timer = null;

  function render() {
    const { robot } = store.state;
    showChoices(select, choices(found, robot?.device));
    select.value = chosen ?? robot?.device ?? EMULATOR;
    address.hidden = select.value !== OTHER;
    offer.hidden = robot?.link !== "lost" || !found.again;
    setText(words, found.again?.sentence ?? "");
  }

  const poll = latestOnly(async () => {
    try {
      found = await api.ports();
      render();
    } catch (error) {
      if (error.status) report(error); // a studio that does not answer is said in the top bar
    }
  });

  function choose(device) {
    chosen = device;
    render();
  }

  select.addEventListener("focus", poll);
  select.addEventListener("change", () => {
    choose(select.value);
    if (chosen === OTHER) address.focus();
  });
  address.addEventListener("keydown", (event) => {
    if (event.key === "Enter") connect();
  });
  onPress(again, () => {
    choose(found.again.device);
    connect();
  });
  store.watch(
    ({ robot }) => [robot?.device, robot?.link],
    ({ robot }) => {
      const fixed = ["ready", "connecting"].includes(robot?.link);
      if (fixed) chosen = null;
      select.disabled = fixed;
      const title = fixed ? "Disconnect before you choose another robot" : "Choose the robot to connect";
      setAttribute(select, "title", title);
      clearInterval(timer);
      timer = robot?.link === "lost" ? setInterval(poll, POLL_MS) : null;
      render();
      if (robot && !fixed) poll(null);
    },
  );
  return {
    element: h("div", { class: "device-choice" }, select, address),
    offer,
    value: () => (select.value === OTHER ? address.value.trim() : select.value) || undefined,
  };
}
