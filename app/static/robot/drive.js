/**
 * Drive by keys: a region that is entered by a click. A key makes one step of the jog. While it is held, the
 * keyboard's own repetition makes the next one once the last has ended.
 */

import { api } from "../api/gaits.js";
import { h, onPress, setAttribute, setText } from "../lib/dom.js";
import { toast } from "../lib/toasts.js";
import { isHolder, whyNotHeld } from "../state/lease.js";
import { needOperator } from "../state/operator.js";
import { acceptRobot, watchable } from "../state/store.js";
import { CHOICE_KEYS, stepOf } from "./drive_keys.js";
import { keyMap } from "./drive_map.js";

/** A motor needs one message for 3 mm. At 2 mm ahead, the motors move less than the firmware's 1 mm. */
const SIZES_MM = [2, 3, 5];
const FIRST_MM = 3;

/** The robot has to stand for 0.3 s before the next step; readings come at 20 Hz at most. */
const SETTLE_MS = 450;

const INVITATION = "Click here, or press Enter, to drive by keys.";
const DRIVING = "Keys act. Hold a key for step after step. Tab or Esc leaves.";
const NO_CONTROL = "You are not in control of the robot. Press Arm to take control.";

/** Why no key may move the robot now; null where one may. A step that is under way is no reason. */
export function whyNotDrive({ connected, robot }) {
  if (!connected) return "The studio does not answer.";
  if (!robot) return "The studio has not answered yet.";
  const why = whyNotHeld(robot);
  if (why) return why;
  if (robot.jog) return null;
  return robot.allowed?.jog ?? (isHolder(robot) ? null : NO_CONTROL);
}

/**
 * Steps by keys, without the page: what a key does, and what ends it.
 * @param {import("../state/store.js").Store} store
 * @param {import("../state/store.js").Watchable<any>} own
 * @param {() => number} [clock] ms
 */
export function driver(store, own, clock = () => performance.now()) {
  let [isAsking, readyAt] = [false, 0];
  store.watch(
    ({ robot }) => [robot?.robot],
    () => {
      readyAt = clock() + SETTLE_MS;
    },
  );
  const say = (sentence) => own.set({ sentence });
  const isHeld = (code) => own.state.isIn && own.state.held === code && !whyNotDrive(store.state);

  async function make(step, code) {
    const body = { robot: store.state.view?.document.robot ?? "deltawalker", steps: [step] };
    const seen = await api.robot("jog", { ...body, preview: true });
    if (!isHeld(code)) return;
    if (seen.reason) return own.set({ held: null, sentence: seen.reason });
    say("");
    acceptRobot(
      store,
      await api.robot("jog", { ...body, seen_mm: seen.target_mm, by: store.state.operator }),
    );
    if (!isHeld(code)) await api.robot("jog/end");
  }

  /** Ends the hold: the message that is on goes to its end, and no further one is sent. */
  function release() {
    if (own.state.held === null) return;
    own.set({ held: null });
    if (store.state.robot?.jog && isHolder(store.state.robot)) api.robot("jog/end").catch(() => {});
  }

  return {
    release,
    leave(sentence = "") {
      release();
      own.set({ isIn: false, sentence });
    },
    /** A key went down, or repeats; only one that went down here and was not refused may repeat. */
    async press(code, repeats) {
      const step = stepOf(code, own.state.chosen, own.state.size);
      if (!step || (repeats && own.state.held !== code)) return;
      const why = whyNotDrive(store.state);
      own.set({ held: why ? null : code });
      if (why) return say(why);
      if (isAsking || store.state.robot.robot !== "armed" || clock() < readyAt) return;
      isAsking = true;
      try {
        await make(step, code);
      } catch (error) {
        own.set({ held: null, sentence: error.message });
      } finally {
        isAsking = false;
      }
    },
  };
}

/** Listens to the keys of the region, and to everything that ends them. */
function listen(region, own, drive) {
  region.addEventListener("keydown", (event) => {
    if (event.key === "Tab" || event.ctrlKey || event.altKey || event.metaKey) return;
    if (event.key === "Escape") {
      region.blur();
      return;
    }
    // Keys of the page do not act here, nor do they scroll it.
    event.preventDefault();
    if (!own.state.isIn) {
      if (event.key === "Enter") region.click();
    } else if (event.code in CHOICE_KEYS) own.set({ chosen: CHOICE_KEYS[event.code] });
    else drive.press(event.code, event.repeat);
  });
  region.addEventListener("keyup", ({ code }) => {
    if (code === own.state.held) drive.release();
  });
  region.addEventListener("blur", () => drive.leave());
  window.addEventListener("blur", () => drive.leave());
  document.addEventListener("visibilitychange", () => document.hidden && drive.leave());
}

/** The sentence of the region: what it is for, what hinders it, or what moves. */
function sentenceOf({ isIn, sentence }, state) {
  if (sentence) return sentence;
  if (!isIn) return whyNotDrive(state) ?? INVITATION;
  return state.robot?.jog ? `Moving ${state.robot.jog.text}.` : DRIVING;
}

function build() {
  const size = h(
    "select",
    { "aria-label": "Step of a key" },
    ...SIZES_MM.map((mm) => h("option", { value: mm, text: `${mm} mm`, selected: mm === FIRST_MM })),
  );
  const map = keyMap();
  const says = h("p", { class: "drive-says", role: "status", "aria-label": "Drive by keys says" });
  const region = h(
    "div",
    {
      class: "drive-region",
      tabindex: "0",
      role: "application",
      "aria-label": "Keys that drive the robot",
      "aria-describedby": "drive-help",
      data: { drive: "", ownEscape: "" },
    },
    says,
    map.element,
  );
  const help =
    "The number row draws motors 1 to 12 up, the row below lets them down. "
    + "A, S, D and F choose foot 1 to 4, G the body. The arrows and Page Up and Page Down move it. "
    + "The place of a key counts, not its letter. "
    + "Releasing the key ends the driving after the present short move, which the robot cannot break off. "
    + "Esc during a move is Stop.";
  const element = h(
    "details",
    { class: "more jog drive", role: "group", "aria-label": "Drive by keys" },
    h("summary", { text: "Drive by keys: hold a key to move" }),
    h(
      "div",
      {},
      h("div", { class: "drive-choice" }, h("label", {}, h("span", { text: "Step" }), size)),
      region,
      h("p", { class: "why", id: "drive-help", text: help }),
    ),
  );
  return { element, region, size, map, says };
}

/**
 * Builds its group in the step Run.
 * @returns {HTMLElement}
 */
export function drivePart(store) {
  const own = watchable({ isIn: false, held: null, chosen: 0, size: FIRST_MM, sentence: "" });
  const drive = driver(store, own);
  const { element, region, size, map, says } = build();
  listen(region, own, drive);
  size.addEventListener("change", () => own.set({ size: Number(size.value) }));
  element.addEventListener("toggle", () => element.open || drive.leave());
  onPress(region, async () => {
    const why = whyNotDrive(store.state);
    if (why) return own.set({ sentence: why });
    if (!(await needOperator(store, "The studio records your name with every movement that you start.")))
      return;
    region.focus({ preventScroll: true });
    own.set({ isIn: document.activeElement === region, sentence: "" });
  });

  function show() {
    const [state, now] = [store.state, own.state];
    setAttribute(region, "data-in", now.isIn);
    setText(says, sentenceOf(now, state));
    map.show(now.held, now.chosen);
  }
  own.watch((state) => Object.values(state), show);
  store.watch(
    ({ robot, connected }) => [connected, robot?.robot, robot?.link, robot?.lease?.page, robot?.jog?.text],
    (state) => {
      const why = own.state.isIn && whyNotDrive(state);
      if (why) {
        drive.leave(`Driving by keys has ended. ${why}`);
        toast(why, { of: "studio" });
      }
      show();
    },
  );
  return element;
}
