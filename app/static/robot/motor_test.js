/** The motor test: all motors one after the other, and a table with the verdict on each. */

import { api } from "../api/gaits.js";
import { h, onPress, setAllowed, setText } from "../lib/dom.js";
import { attempt, toast } from "../lib/toasts.js";
import { whyNotHeld } from "../state/lease.js";
import { needOperator } from "../state/operator.js";

const MOTORS = 12;
const HELP =
  "Each motor makes a small move out and back, one after the other. The test takes about 45 s. "
  + "Let the robot stand free on its feet. Keep your hands away and look whether the named motor moves.";

/** A motor by its number and its place. */
const nameOf = (motor) => `${motor} (foot ${Math.ceil(motor / 3)})`;

function row(motor, finding, isNow) {
  const verdict = finding?.verdict ?? (isNow ? "moves now" : "–");
  const tone = finding ? (finding.verdict === "good" ? "good" : "bad") : null;
  return h(
    "tr",
    { data: isNow ? { now: "" } : {} },
    h("th", { scope: "row", text: nameOf(motor) }),
    h("td", {}, h("b", { text: verdict, data: tone ? { toneText: tone } : {} })),
    h(
      "td",
      {},
      finding && h("span", { text: finding.sentence }),
      finding?.remedy && h("span", { class: "why", text: finding.remedy }),
    ),
  );
}

function showTable(body, { findings, motor: now }) {
  const byMotor = new Map(findings.map((one) => [one.motor, one]));
  const motors = Array.from({ length: MOTORS }, (_, index) => index + 1);
  body.replaceChildren(...motors.map((motor) => row(motor, byMotor.get(motor), motor === now)));
}

/** When the last result was found, and by whom. */
const origin = ({ at, by, state }) =>
  state && state !== "running"
    ? ` ${by}, ${new Date(at * 1000).toLocaleTimeString([], { hour12: false })}.`
    : "";

function build() {
  const body = h("tbody");
  const heads = ["Motor", "Verdict", "What was seen"].map((text) => h("th", { scope: "col", text }));
  const table = h(
    "table",
    { class: "motor-test", "aria-label": "Motors" },
    h("thead", {}, h("tr", {}, ...heads)),
    body,
  );
  const start = h("button", { class: "primary", text: "Test all motors", "data-robot": true });
  const end = h("button", { text: "End after this motor" });
  const says = h("p", { role: "status", "aria-label": "Motor test says" });
  const why = h("p", { class: "why" });
  const element = h(
    "details",
    { class: "more jog", role: "group", "aria-label": "Motor test" },
    h("summary", { text: "Motor test: find a motor that fails" }),
    h(
      "div",
      {},
      h("p", { class: "why", text: HELP }),
      h("div", { class: "buttons" }, start, end),
      why,
      says,
      table,
    ),
  );
  return { element, body, table, start, end, says, why };
}

/**
 * Builds its group in the step Run.
 * @returns {HTMLElement}
 */
export function motorTestPart(store) {
  const { element, body, table, start, end, says, why } = build();
  const ask = (verb, content) => api.robot(verb, content).then((motorTest) => store.set({ motorTest }));
  const begin = attempt(async () => {
    const by = await needOperator(store, "The studio records your name with every movement that you start.");
    const robot = store.state.view?.document.robot;
    if (by) await ask("motor-test", { by, ...(robot ? { robot } : {}) });
  });
  const explain = (reason) => toast(reason, { of: "studio" });
  onPress(start, begin, explain);
  onPress(
    end,
    attempt(() => ask("motor-test/cancel", {})),
    explain,
  );
  store.watch(
    ({ motorTest, robot }) => [motorTest, robot?.allowed?.motor_test, robot?.lease],
    ({ motorTest, robot }) => {
      const isOn = motorTest?.state === "running";
      const refusal = robot
        ? (whyNotHeld(robot) ?? robot.allowed?.motor_test)
        : "The studio has not answered yet.";
      setAllowed(start, refusal, HELP);
      setText(why, isOn ? "" : (refusal ?? ""));
      start.hidden = isOn;
      end.hidden = !isOn;
      table.hidden = !motorTest?.state;
      setText(says, motorTest ? motorTest.sentence + origin(motorTest) : "");
      if (motorTest?.state) showTable(body, motorTest);
    },
  );
  return element;
}
