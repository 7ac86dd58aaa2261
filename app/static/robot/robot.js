/** The Robot section: the way from the cable to a finished run, one deliberate act after the other. */

import { api } from "../api/gaits.js";
import { confirmAction } from "../lib/dialogs.js";
import { byId, h, onPress, setAllowed, setText } from "../lib/dom.js";
import { capital, counted, fixed, seconds, shortHash } from "../lib/format.js";
import { ticket } from "../lib/latest_only.js";
import { attempt, report, toast } from "../lib/toasts.js";
import { robotTone } from "../shell/topbar.js";
import { leasePart, whyNotHeld } from "../state/lease.js";
import { needOperator } from "../state/operator.js";
import { commandedStrokes } from "../state/plan_samples.js";
import { acceptRobot, planIsOn, runIsOn, stopLimit } from "../state/store.js";
import { jogPart } from "./jog.js";
import { portChooser } from "./ports.js";
import { robotFaults } from "./robot_faults.js";
import { isOfRunRange, runRangeOf, runRangePart } from "./run_range.js";
import { sendControl } from "./send.js";
import { strokeBars } from "./strokes.js";

const CONNECT_WARNING = "Connecting resets the board: its motors may move for about 8 s. Keep hands away.";

function stopSentence(limit) {
  const within = limit === null || limit === undefined ? "a few seconds" : `${seconds(limit)} s`;
  return `Stop is a software stop over the cable: it takes effect within ${within}, after the move that is running. The power switch is the emergency stop.`;
}

function act(store, verb, extra = () => ({})) {
  return attempt(async () => {
    const by = store.state.operator || undefined;
    acceptRobot(store, await api.robot(verb, { ...(by ? { by } : {}), ...extra() }));
  });
}

function robotButton(store, text, verb, options = {}) {
  const button = h("button", { text, "data-robot": true });
  onPress(button, options.act ?? act(store, verb, options.extra), (why) => toast(why, { of: "studio" }));
  return { button, allow: (robot) => setAllowed(button, robot ? (whyNotHeld(robot) ?? robot.allowed?.[verb]) : "The studio has not answered yet.", options.help) };
}

function way(step, ...children) {
  return h("li", { class: "way", data: { step } }, ...children);
}

function progressOf(run) {
  if (!run) return null;
  if (run.phase === "start pose") return { fraction: 0, text: "Moving slowly to the start pose" };
  const time = run.elapsed === null || run.elapsed === undefined ? "" : ` · ${seconds(run.elapsed)} s`;
  const what = run.gait_name ? `${run.gait_name}, ${shortHash(run.waypoints_hash)}: ` : "";
  const again = run.iterations > 1 ? `iteration ${run.iteration} of ${run.iterations}, ` : "";
  return { fraction: run.count ? run.reached / run.count : 0, text: `${what}${again}${run.reached} of ${run.count} reached, ${run.sent} sent${time}` };
}

/** Check knows no robot: where its number is another one, this says why. */
function checkedStopText({ stop_seconds: stop, checked_stop_seconds: checked, scan_seconds: scan }) {
  if (seconds(stop) === seconds(checked)) return null;
  const why = scan === null ? "of all waypoints" : `with the slowest scan known; this robot's took ${seconds(scan)} s`;
  return `Check: ${seconds(checked)} s, ${why}`;
}

function summaryRows({ runSummary: run, view, selected }) {
  if (!run || run.gait !== selected || !view) return [];
  const row = (name, value, options = {}) => [h("dt", { text: name }), h("dd", { text: value, ...options })];
  const isKnown = run.start_distance_mm !== null && run.start_distance_mm !== undefined;
  const moves = run.start_moves ? ` in ${counted(run.start_moves, "move")}` : "";
  const checked = checkedStopText(run);
  return [
    ...row("Waypoints", `${run.waypoints}`),
    ...row("Takes about", `${fixed(run.estimated_seconds, 0)} s`),
    ...(isKnown ? row("To the start pose", `${fixed(run.start_distance_mm)} mm${moves}`) : []),
    ...row("Largest move", `${fixed(run.largest_move_mm)} mm`),
    ...row("Stop acts within", `${seconds(run.stop_seconds)} s`),
    ...(checked ? [h("dd", { class: "why", text: checked })] : []),
    ...row("Hash", shortHash(run.waypoints_hash), { class: "mono", title: run.waypoints_hash }),
  ];
}

function build(store) {
  const ports = portChooser(store, () => connect.button.click());
  const connect = robotButton(store, "Connect", "connect", { extra: () => ({ device: ports.value() }), help: CONNECT_WARNING });
  const reset = attempt(async () => {
    if (await confirmAction("Reset the robot?", "Reset moves all 12 motors to 0.5 mm, at full speed and at the same time.", "Move all motors to 0.5 mm")) await act(store, "reset")();
  });
  const arm = attempt(async () => {
    if (await needOperator(store, "Everyone sees who arms the robot and is in control of it.")) await act(store, "arm")();
  });
  return {
    ports, connect,
    dot: h("span", { class: "dot" }), word: h("b"), sentence: h("p"),
    disconnect: robotButton(store, "Disconnect", "disconnect"),
    arm: robotButton(store, "Arm", "arm", { act: arm, help: "Allow this robot to be moved from here" }),
    pause: robotButton(store, "Pause robot", "pause", { help: "Stands still at the next pose with all feet down" }),
    resume: robotButton(store, "Resume robot", "resume"),
    clear: robotButton(store, "Clear", "clear", { help: "Acknowledge the stop or fault; nothing moves" }),
    reset: robotButton(store, "Reset", "reset", { act: reset, help: "Moves all motors to 0.5 mm" }),
    connectNote: h("p", { class: "why" }), armNote: h("p", { class: "why" }), sendNote: h("p", { class: "why" }),
    summary: h("dl", { class: "summary" }),
    bar: h("i"), later: h("p", { class: "why", role: "status", "aria-label": "Later edit", data: { toneText: "caution" } }), progress: h("p", { class: "why number" }),
    record: h("p", { class: "why", role: "status", "aria-label": "Record", data: { toneText: "caution" } }),
    bars: strokeBars(),
    stopText: h("p", { class: "stop-text" }),
  };
}

function assemble({ store, edits, playback }, parts, send) {
  const connect = way(1, parts.ports.offer, h("div", { class: "device" }, parts.ports.element, parts.connect.button, parts.disconnect.button), parts.connectNote);
  const arm = way(2, h("div", { class: "buttons" }, parts.arm.button, parts.clear.button, parts.armNote));
  const start = way(3, runRangePart(store, playback), parts.summary, send.element, parts.sendNote);
  const run = way(4, h("div", { class: "progress" }, parts.bar), parts.progress, parts.later, parts.record,
    h("div", { class: "buttons" }, parts.pause.button, parts.resume.button, parts.reset.button));
  byId("robot").append(h("div", { class: "robot-state" }, parts.dot, parts.word, parts.sentence), leasePart(store),
    h("ol", { class: "steps", role: "list", "aria-label": "The robot's way" }, connect, arm, start, run), jogPart(store, edits),
    h("h3", {}, "Strokes measured", h("span", { text: "mm" })), parts.bars.element, parts.stopText, robotLog(store), robotFaults(store));
  return { connect, arm, start, run };
}

function showSteps(ways, robot) {
  const ready = robot?.link === "ready";
  const armed = ready && !["unknown", "disarmed", "stopped", "fault", "done"].includes(robot.robot);
  const done = robot?.robot === "done";
  const on = runIsOn(robot);
  const marks = { connect: ready, arm: armed, start: on, run: done };
  const next = Object.keys(marks).find((name) => !marks[name]);
  for (const [name, element] of Object.entries(ways)) {
    element.toggleAttribute("data-done", marks[name]);
    element.toggleAttribute("data-next", name === next);
  }
}

function showRobot(parts, ways, robot) {
  const ready = ["ready", "connecting"].includes(robot?.link);
  const on = runIsOn(robot);
  parts.dot.dataset.tone = robotTone(robot);
  setText(parts.word, robot ? `${robot.robot}${robot.emulated ? " · emulated robot" : ""}` : "unknown");
  const before = robot?.previous_run;
  const broken = !ready && before?.state === "interrupted" ? `The last run, ${before.gait_name}, was interrupted. ${before.sentence}` : null;
  setText(parts.sentence, [robot?.sentence, broken, robot?.stop_text && !robot.sentence?.includes(robot.stop_text) ? `${capital(robot.stop_text)}.` : null].filter(Boolean).join(" "));
  for (const name of ["connect", "disconnect", "arm", "pause", "resume", "clear", "reset"]) parts[name].allow(robot);
  parts.connect.button.hidden = ready;
  parts.disconnect.button.hidden = !ready;
  const paused = robot?.robot === "paused";
  parts.pause.button.hidden = paused;
  parts.resume.button.hidden = !paused;
  setText(parts.connectNote, ready ? (robot.link === "connecting" ? CONNECT_WARNING : "") : CONNECT_WARNING);
  setText(parts.armNote, ready && !on ? (whyNotHeld(robot) ?? (robot.robot === "armed" ? "" : robot.allowed?.arm ?? "")) : "");
  const progress = progressOf(robot?.run);
  parts.bar.style.transform = `scaleX(${progress?.fraction ?? 0})`;
  setText(parts.progress, progress?.text ?? (before ? `Last run: ${before.gait_name}, ${before.state}.` : "No run yet."));
  setText(parts.record, robot?.record_trouble ?? "");
  showSteps(ways, robot);
}

/** What to know of a run whose gait is no longer as it was approved and sent. */
function laterEdit({ robot, view, selected, pending, gesture }) {
  if (!runIsOn(robot) || !view || robot.run?.gait !== selected) return "";
  const same = !pending.length && !gesture && view.approval?.waypoints_hash === robot.run.waypoints_hash;
  return same ? "" : "The run goes on with the approved version; what you see is a later edit.";
}

function whyNotSend(state) {
  const { robot, view, runSummary } = state;
  if (runSummary?.unwired && runSummary.waypoints_hash === view?.plan?.waypoints_hash) return runSummary.unwired;
  if (!robot) return "The studio has not answered yet.";
  if (!view?.approval) return "Only an approved plan can be sent: check and approve it first.";
  if (whyNotHeld(robot)) return whyNotHeld(robot);
  if (robot.allowed?.send) return robot.allowed.send;
  if (!runSummary || runSummary.waypoints_hash !== view.approval.waypoints_hash || !isOfRunRange(runSummary, state)) return "The summary of this plan is not there yet.";
  return runSummary.reason ?? null;
}

/** Keeps the summary of what would be sent that of the shown plan. */
function followSummary(store) {
  const begin = ticket();
  store.watch(({ selected, view, robot, runRange }) => [selected, runRange, view?.plan?.waypoints_hash, view?.approval?.waypoints_hash, robot?.link, robot?.robot], async (state) => {
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
  });
}

/** Builds the section; returns what Esc may cancel. */
export function mountRobot(store, edits, playback) {
  const send = sendControl({
    prepare: async () => Boolean(await needOperator(store, "The run is kept with the name of who started it.")),
    send: attempt(async () => {
      const { selected, runSummary, operator } = store.state;
      acceptRobot(store, await api.robot("send", { gait: selected, waypoints_hash: runSummary.waypoints_hash, from: runSummary.from, iterations: runSummary.iterations, by: operator }));
    }),
  });
  const parts = build(store);
  const ways = assemble({ store, edits, playback }, parts, send);
  store.watch(({ robot }) => [robot], ({ robot }) => showRobot(parts, ways, robot));
  store.watch(({ robot, view, jog }) => [robot?.strokes_mm, robot?.run, view?.plan, jog?.target_mm], ({ robot, view, jog }) => {
    const target = jog?.wired ? jog.target_mm : null;
    parts.bars.show(robot?.strokes_mm ?? null, target ?? commandedStrokes(robot, view));
  });
  store.watch((state) => [laterEdit(state)], (state) => setText(parts.later, laterEdit(state)));
  store.watch(({ robot, view, runSummary, selected, runRange }) => [robot, view, runSummary, selected, runRange], (state) => {
    const reason = whyNotSend(state);
    send.allow(reason);
    setText(parts.sendNote, reason ?? "Hold for a second, or click for a countdown.");
    parts.summary.replaceChildren(...summaryRows(state));
    setText(parts.stopText, stopSentence(stopLimit(state)));
    ways.start.hidden = planIsOn(state.robot);
    parts.summary.hidden = parts.summary.childElementCount === 0;
  });
  followSummary(store);
  return send.cancel;
}

const MOST = 50;

function timeOf(at) {
  return new Date(at * 1000).toLocaleTimeString([], { hour: "2-digit", minute: "2-digit", second: "2-digit", hour12: false });
}

function row({ at, link, robot, cause }) {
  return h("li", {}, h("time", { class: "number quiet", text: timeOf(at) }), h("span", {}, h("b", { text: `${link}, ${robot}` }), ` ${cause}`));
}

/** Builds the list; it is read when it is open and something changed. */
function robotLog(store) {
  const list = h("ul", { class: "robot-log", "aria-label": "What happened", tabindex: "0" });
  const element = h("details", { class: "more" }, h("summary", { text: "What happened" }), list);
  const read = attempt(async () => {
    if (!element.open) return;
    const { transitions } = await api.transitions();
    list.replaceChildren(...transitions.slice(-MOST).reverse().map(row));
    if (!transitions.length) list.replaceChildren(h("li", { class: "quiet", text: "Nothing yet: every change of link and robot stands here, with its cause." }));
  });
  element.addEventListener("toggle", read);
  store.watch(({ robot }) => [robot?.link, robot?.robot, robot?.sentence], read);
  return element;
}
