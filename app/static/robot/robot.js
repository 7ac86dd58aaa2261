/** The step Run: from the cable to a finished run, one deliberate act at a time; in a run, only that run. */

import { api } from "../api/gaits.js";
import { confirmAction } from "../lib/dialogs.js";
import { byId, h, onPress, setAllowed, setText } from "../lib/dom.js";
import { capital, counted, fixed, seconds, shortHash } from "../lib/format.js";
import { keepPlace } from "../lib/keep_place.js";
import { ticket } from "../lib/latest_only.js";
import { attempt, report, toast } from "../lib/toasts.js";
import { openDrawer } from "../shell/drawers.js";
import { robotTone } from "../shell/topbar.js";
import { leasePart, whyNotHeld } from "../state/lease.js";
import { needOperator } from "../state/operator.js";
import { overrideNote } from "../state/override.js";
import { commandedStrokes } from "../state/plan_samples.js";
import { acceptRobot, planIsOn, runIsOn, stopLimit } from "../state/store.js";
import { drivePart } from "./drive.js";
import { jogPart } from "./jog.js";
import { motorTestPart } from "./motor_test.js";
import { portChooser } from "./ports.js";
import { robotLog } from "./robot_log.js";
import { runningPart } from "./running.js";
import { robotFaults } from "./robot_faults.js";
import { isOfRunRange, runRangeOf, runRangePart } from "./run_range.js";
import { sendControl } from "./send.js";
import { strokeBars } from "./strokes.js";

const CONNECT_WARNING =
  "Connecting resets the robot's board. The motors may move for about 8 s. Keep your hands away.";

const bound = (limit) => (limit === null || limit === undefined ? "a few seconds" : `${seconds(limit)} s`);

/** Stop's worst case, in one short figure. */
const stopSentence = (limit) =>
  `Stop takes effect within ${bound(limit)}. The power switch is the emergency stop.`;
const STOP_HELP =
  "The studio sends Stop over the cable. The robot first finishes its present move. "
  + "The time shown is the longest time until the robot stops.";
const CLEAR_HELP = "Confirm that you have seen the stop or the fault. This button does not move the robot";

function act(store, verb, extra = () => ({})) {
  return attempt(async () => {
    const by = store.state.operator || undefined;
    acceptRobot(store, await api.robot(verb, { ...(by ? { by } : {}), ...extra() }));
  });
}

function robotButton(store, text, verb, options = {}) {
  const button = h("button", { text, "data-robot": true });
  onPress(button, options.act ?? act(store, verb, options.extra), (why) => toast(why, { of: "studio" }));
  return {
    button,
    allow: (robot) =>
      setAllowed(
        button,
        robot ? (whyNotHeld(robot) ?? robot.allowed?.[verb]) : "The studio has not answered yet.",
        options.help,
      ),
  };
}

function way(step, ...children) {
  return h("li", { class: "way", data: { step } }, ...children);
}

/** Why the check names another time for Stop; null where it names the same. */
function checkedStopText({ stop_seconds: stop, checked_stop_seconds: checked, scan_seconds: scan }) {
  if (seconds(stop) === seconds(checked)) return null;
  const why =
    scan === null
      ? "Check counts all waypoints of the plan."
      : "Check assumes the slowest error scan of the firmware. "
        + `This robot's error scan took ${seconds(scan)} s.`;
  return `The step Check shows ${seconds(checked)} s for Stop, because ${why}`;
}

/** Shows what Send would do; not with each state of the robot, which comes many times a second. */
function showSummary(element, state) {
  element.replaceChildren(...summaryRows(state));
  element.hidden = element.childElementCount === 0;
}

/** What will move, how long, and how soon it stops. */
function summaryRows({ runSummary: run, view, selected }) {
  if (!run || run.gait !== selected || !view) return [];
  const row = (name, value, options = {}) => [h("dt", { text: name }), h("dd", { text: value, ...options })];
  const isKnown = run.start_distance_mm !== null && run.start_distance_mm !== undefined;
  const moves = run.start_moves
    ? `, ${counted(run.start_moves, "move")}${run.start_seconds ? `, ${fixed(run.start_seconds, 0)} s` : ""}`
    : "";
  const checked = checkedStopText(run);
  return [
    ...row("Gait", view.document.name),
    ...row("Takes", `about ${fixed(run.estimated_seconds + (run.start_seconds ?? 0), 0)} s`),
    ...row("Waypoints", `${run.waypoints}, largest move ${fixed(run.largest_move_mm)} mm`),
    ...(isKnown ? row("To the start pose", `${fixed(run.start_distance_mm)} mm${moves}`) : []),
    ...row("Stop acts within", `${seconds(run.stop_seconds)} s`),
    ...(checked ? [h("dd", { class: "why", text: checked })] : []),
    ...row("Hash", shortHash(run.waypoints_hash), { class: "mono", title: run.waypoints_hash }),
  ];
}

function build(store) {
  const ports = portChooser(store, () => connect.button.click());
  const connect = robotButton(store, "Connect", "connect", {
    extra: () => ({ device: ports.value() }),
    help: CONNECT_WARNING,
  });
  const reset = attempt(async () => {
    if (
      await confirmAction(
        "Reset the robot?",
        "Reset moves all 12 motors to 0.5 mm, at full speed and at the same time.",
        "Move all motors to 0.5 mm",
      )
    )
      await act(store, "reset")();
  });
  const arm = attempt(async () => {
    if (await needOperator(store, "All users see who has armed the robot.")) await act(store, "arm")();
  });
  return {
    ports,
    connect,
    dot: h("span", { class: "dot" }),
    word: h("b"),
    sentence: h("p"),
    disconnect: robotButton(store, "Disconnect", "disconnect"),
    arm: robotButton(store, "Arm", "arm", { act: arm, help: "Allow the studio to move this robot" }),
    clear: robotButton(store, "Clear", "clear", { help: CLEAR_HELP }),
    reset: robotButton(store, "Reset", "reset", {
      act: reset,
      help: "Move all motors to 0.5 mm at full speed",
    }),
    armed: h("span"),
    connectNote: h("p", { class: "why" }),
    armNote: h("p", { class: "why" }),
    sendNote: h("p", { class: "why" }),
    summary: h("dl", { class: "summary" }),
    last: h("p", { class: "why number" }),
    runs: h("button", {
      class: "link",
      text: "Open Runs",
      title: "Show all recorded runs. You can compare two runs",
      hidden: true,
      on: { click: () => openDrawer("runs") },
    }),
    record: h("p", { class: "why", role: "status", "aria-label": "Record", data: { toneText: "caution" } }),
    bars: strokeBars(),
    stopText: h("p", { class: "stop-text", title: STOP_HELP }),
  };
}

function assemble({ store, edits, playback }, parts, send) {
  const connect = way(
    1,
    parts.ports.offer,
    h("div", { class: "device" }, parts.ports.element, parts.disconnect.button),
    parts.connectNote,
  );
  const arm = way(2, h("div", { class: "buttons" }, parts.armed, parts.reset.button), parts.armNote);
  const start = way(3, parts.summary, runRangePart(store, playback));
  const before = h(
    "div",
    { class: "before-run" },
    h("div", { class: "robot-state" }, parts.dot, parts.word, parts.sentence),
    parts.last,
    parts.runs,
    h("ol", { class: "steps", role: "list", "aria-label": "Steps to a run" }, connect, arm, start),
  );
  const key = h("span", { text: "bar: measured, line: target, in mm" });
  const strokes = h("div", { class: "measured-strokes" }, h("h3", {}, "Strokes", key), parts.bars.element);
  const byHand = [jogPart(store, edits), drivePart(store), motorTestPart(store)];
  const more = h("div", { class: "after-run" }, ...byHand, robotFaults(store));
  const above = [leasePart(store), overrideNote(store), before, runningPart(store), parts.record, strokes];
  byId("robot").append(...above, more, robotLog(store));
  keepPlace(
    above,
    () => more.offsetTop,
    () => byHand.some((part) => part.contains(document.activeElement) || part.matches(":hover")),
  );
  const acts = h("div", { class: "solve" }, parts.connect.button, parts.clear.button, parts.arm.button);
  byId("foot-run").append(
    h("div", { class: "before-run" }, acts, send.element, parts.sendNote),
    parts.stopText,
  );
  return { connect, arm, start };
}

/** Whether the last run, of the shown waypoints, came to its end. */
const hasRun = ({ robot, selected, view }) =>
  robot?.robot === "done"
  && robot.run?.gait === selected
  && robot.run.waypoints_hash === view?.plan?.waypoints_hash;

function showSteps(parts, ways, state) {
  const { robot } = state;
  const ready = robot?.link === "ready";
  const armed = ready && !["unknown", "disarmed", "stopped", "fault", "done"].includes(robot.robot);
  const marks = { connect: ready, arm: armed, start: planIsOn(robot) || (armed && hasRun(state)) };
  const next = Object.keys(marks).find((name) => !marks[name]);
  setText(parts.armed, armed ? "Armed: the robot moves when you send a run." : "Not armed.");
  const mayClear = robot?.allowed?.clear === null;
  parts.connect.button.classList.toggle("primary", next === "connect" && !mayClear);
  parts.clear.button.classList.toggle("primary", mayClear);
  parts.arm.button.classList.toggle("primary", next === "arm" && !mayClear);
  for (const [name, element] of Object.entries(ways)) {
    element.toggleAttribute("data-done", marks[name]);
    element.toggleAttribute("data-next", name === next);
  }
}

/** What the robot says, and what ended a run that was interrupted. */
function stateSentence(robot, ready) {
  const before = robot?.previous_run;
  const broken =
    !ready && before?.state === "interrupted"
      ? `The last run was interrupted. Its gait was “${before.gait_name}”. ${before.sentence}`
      : null;
  const stop =
    robot?.stop_text && !robot.sentence?.includes(robot.stop_text) ? `${capital(robot.stop_text)}.` : null;
  return [robot?.sentence, broken, stop].filter(Boolean).join(" ");
}

/** Why the robot cannot be armed; nothing while it is armed. */
const armText = (robot) => whyNotHeld(robot) ?? (robot.robot === "armed" ? "" : (robot.allowed?.arm ?? ""));

function showRobot(parts, ways, state) {
  const { robot } = state;
  const ready = ["ready", "connecting"].includes(robot?.link);
  const on = runIsOn(robot);
  parts.dot.dataset.tone = robotTone(robot);
  setText(parts.word, robot ? `${robot.robot}${robot.emulated ? " · emulated robot" : ""}` : "unknown");
  setText(parts.sentence, stateSentence(robot, ready));
  for (const name of ["connect", "disconnect", "arm", "clear", "reset"]) parts[name].allow(robot);
  parts.connect.button.hidden = ready;
  parts.disconnect.button.hidden = !ready;
  setText(parts.connectNote, ready ? (robot.link === "connecting" ? CONNECT_WARNING : "") : CONNECT_WARNING);
  setText(parts.armNote, ready && !on ? armText(robot) : "");
  setText(parts.last, lastRun(robot));
  parts.runs.hidden = !lastRun(robot);
  parts.clear.button.hidden = robot?.allowed?.clear !== null;
  byId("run").toggleAttribute("data-running", planIsOn(robot));
  byId("foot-run").toggleAttribute("data-running", planIsOn(robot));
  setText(parts.record, robot?.record_trouble ?? "");
  showSteps(parts, ways, state);
}

/** The last run in a line: how far it came, and how long it took. */
function lastRun(robot) {
  const [run, before] = [robot?.run, robot?.previous_run];
  const name = (gait) => `Last run${gait ? ` of “${gait}”` : ""}`;
  if (run) {
    return (
      `${name(run.gait_name)}: ${run.reached} of ${run.count} waypoints reached `
      + `in ${seconds(run.elapsed)} s, including the moves to the start pose.`
    );
  }
  return before ? `${name(before.gait_name)}: ${before.state}.` : "";
}

const NO_SUMMARY = "The summary of this run is not ready yet. Wait until the page shows the summary.";

/** Whether the summary is of what Send would send: the approved waypoints in the chosen range. */
const hasSummary = (state) =>
  Boolean(state.runSummary)
  && state.runSummary.waypoints_hash === state.view.approval.waypoints_hash
  && isOfRunRange(state.runSummary, state);

function whyNotSend(state) {
  const { robot, view, runSummary, connected } = state;
  if (!connected) return "The studio does not answer.";
  if (runSummary?.unwired && runSummary.waypoints_hash === view?.plan?.waypoints_hash)
    return runSummary.unwired;
  if (!robot) return "The studio has not answered yet.";
  if (!view?.approval) return "Check and approve the gait first.";
  if (whyNotHeld(robot)) return whyNotHeld(robot);
  if (robot.allowed?.send) return robot.allowed.send;
  return hasSummary(state) ? (runSummary.reason ?? null) : NO_SUMMARY;
}

/** Keeps the summary of what would be sent that of the shown plan. */
function followSummary(store) {
  const begin = ticket();
  store.watch(
    ({ selected, view, robot, runRange }) => [
      selected,
      runRange,
      view?.plan?.waypoints_hash,
      view?.approval?.waypoints_hash,
      robot?.link,
      robot?.robot,
    ],
    async (state) => {
      const isOld = begin();
      const { selected, view } = state;
      if (!selected || !view?.plan || view.plan.refusal) return store.set({ runSummary: null });
      try {
        const summary = await api.run(selected, runRangeOf(state));
        if (!isOld()) store.set({ runSummary: { ...summary, gait: selected } });
      } catch (error) {
        if (isOld()) return undefined;
        store.set({ runSummary: null });
        if (error.status !== 409 && error.status !== 422) report(error);
      }
      return undefined;
    },
  );
}

/** Builds the section; returns what Esc may cancel. */
export function mountRobot(store, edits, playback) {
  const send = sendControl({
    prepare: async () => Boolean(await needOperator(store, "The studio records your name with this run.")),
    send: attempt(async () => {
      const { selected, runSummary, operator } = store.state;
      acceptRobot(
        store,
        await api.robot("send", {
          gait: selected,
          waypoints_hash: runSummary.waypoints_hash,
          from: runSummary.from,
          iterations: runSummary.iterations,
          by: operator,
        }),
      );
    }),
  });
  const parts = build(store);
  const ways = assemble({ store, edits, playback }, parts, send);
  store.watch(
    ({ robot, selected, view }) => [robot, selected, view?.plan],
    (state) => showRobot(parts, ways, state),
  );
  store.watch(
    ({ robot, view, jog }) => [robot?.strokes_mm, robot?.run, view?.plan, jog?.target_mm],
    ({ robot, view, jog }) => {
      const target = jog?.wired ? jog.target_mm : null;
      parts.bars.show(robot?.strokes_mm ?? null, target ?? commandedStrokes(robot, view));
    },
  );
  store.watch(
    ({ robot, view, runSummary, selected, runRange, connected }) => [
      robot,
      view,
      runSummary,
      selected,
      runRange,
      connected,
    ],
    (state) => {
      const reason = whyNotSend(state);
      send.allow(reason);
      setText(
        parts.sendNote,
        reason
          ?? "To send the gait, hold the button or the key Enter for one second. "
            + "Or click once to start a countdown.",
      );
      setText(parts.stopText, stopSentence(stopLimit(state)));
    },
  );
  store.watch(
    ({ view, runSummary, selected }) => [view, runSummary, selected],
    (state) => showSummary(parts.summary, state),
  );
  followSummary(store);
  return send.cancel;
}
