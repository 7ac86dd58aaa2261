/** Faults of the emulated robot, on request: a list that opens, and is not there with a real robot. */

import { api } from "../api/gaits.js";
import { h, onPress, setAllowed } from "../lib/dom.js";
import { acceptRobot } from "../state/store.js";
import { attempt, toast } from "../lib/toasts.js";

const FAULTS = {
  stall: "stall: the firmware hangs, the motors continue",
  unplug: "unplug: the cable is pulled out",
  reset: "reset: the board restarts",
  drop: "drop: bytes get lost",
  garble: "garble: bits flip",
  split: "split: messages arrive in pieces",
  delay: "delay: bytes arrive late",
  "weak-motor": "weak-motor: motor 8 is slow",
  "stuck-motor": "stuck-motor: motor 5 does not move",
  "dead-pot": "dead-pot: sensor of motor 2 stays constant",
  "reversed-motor": "reversed-motor: motor 7 turns the wrong way",
  "swapped-motors": "swapped-motors: the cables of motors 4 and 5 are exchanged",
  noise: "noise: sensor readings are noisy",
};

/** Builds the list; a fault that lasts goes on until it is mended or the robot is connected anew. */
export function robotFaults(store) {
  const choice = h(
    "select",
    { "aria-label": "Fault" },
    ...Object.entries(FAULTS).map(([value, text]) => h("option", { value, text })),
  );
  const strike = h("button", { text: "Cause this fault" });
  const mend = h("button", { text: "Repair all" });
  const element = h(
    "details",
    { class: "more robot-faults" },
    h("summary", { text: "Faults of the emulated robot" }),
    h(
      "div",
      {},
      choice,
      h("div", { class: "buttons" }, strike, mend),
      h("p", {
        class: "why",
        text:
          "Stall, unplug and reset happen once. "
          + "Every other fault stays until you press Repair all or connect again.",
      }),
    ),
  );
  const ask = (name, done) =>
    attempt(async () => {
      acceptRobot(store, await api.robot("fault", { name: name() }));
      toast(done(), { of: "studio" });
    });
  const explain = (why) => toast(why, { of: "studio" });
  onPress(
    strike,
    ask(
      () => choice.value,
      () => `The emulated robot has the fault “${choice.value}”.`,
    ),
    explain,
  );
  onPress(
    mend,
    ask(
      () => "none",
      () => "The emulated robot and its cable work again.",
    ),
    explain,
  );
  store.watch(
    ({ robot }) => [robot?.emulated, robot?.link],
    ({ robot }) => {
      element.hidden = !robot?.emulated;
      const why = ["ready", "connecting"].includes(robot?.link) ? null : "Connect the emulated robot first.";
      for (const button of [strike, mend]) setAllowed(button, why);
    },
  );
  return element;
}
