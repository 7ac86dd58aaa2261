/** The step Run while a plan is carried out: time left, progress, Pause. */

import { api } from "../api/gaits.js";
import { h, onPress, setAllowed, setText } from "../lib/dom.js";
import { clockTime, fixed, seconds } from "../lib/format.js";
import { attempt, toast } from "../lib/toasts.js";
import { whyNotHeld } from "../state/lease.js";
import { acceptRobot, planIsOn, runIsOn, shownDocument } from "../state/store.js";

const TICK_MS = 200;
const UNKNOWN =
  "The studio does not answer, so the page does not know what the robot does now. "
  + "The robot's power switch stops the robot.";
const PAUSE_HELP = "The robot pauses at the next waypoint with all feet on the ground.";

/** What the robot does now, in a sentence. */
function nowText(state) {
  const { robot, view, selected } = state;
  const { run } = robot;
  if (robot.robot !== "moving") return robot.sentence;
  if (run.phase === "start pose") return "The robot moves slowly to the start pose.";
  const plan = view?.plan;
  const sample =
    run.gait === selected && plan
      ? plan.times.findLastIndex((time) => time <= (run.plan_time ?? 0) + 1e-6)
      : -1;
  const document = shownDocument(state);
  const [rows, isOfPoses] = [document?.timeline.feet ?? [], Boolean(document?.poses)];
  if (sample < 0 || !rows.length || run.waypoints_hash !== plan.waypoints_hash) return run.gait_name ?? "";
  const next = Math.min(sample + 1, rows[0].length - 1);
  // A pose gait's foot is in the air in both of its moves: one begins with it down, one ends with it down.
  const isUp = (row) => row[next] === "0" || (isOfPoses && row[sample] === "0");
  const feet = rows.flatMap((row, foot) => (isUp(row) ? [foot + 1] : []));
  if (!feet.length) return "All feet are on the ground. The body moves.";
  const names = feet.join(", ").replace(/, ([^,]*)$/, " and $1");
  const swinging = feet.length === 1 ? `Foot ${names} swings` : `Feet ${names} swing`;
  return `${swinging}. The other feet are on the ground.`;
}

/** A note on a run whose gait is no longer as it was approved and sent. */
function laterEdit({ robot, view, selected, pending, gesture }) {
  if (!runIsOn(robot) || !view || robot.run?.gait !== selected) return "";
  const isSame = !pending.length && !gesture && view.approval?.waypoints_hash === robot.run.waypoints_hash;
  return isSame
    ? ""
    : "The run continues with the approved version of the gait. The page shows a newer version.";
}

function actButton(store, text, verb, help) {
  const button = h("button", { class: "wide", text, "data-robot": true });
  onPress(
    button,
    attempt(async () => {
      const by = store.state.operator || undefined;
      acceptRobot(store, await api.robot(verb, by ? { by } : {}));
    }),
    (why) => toast(why, { of: "studio" }),
  );
  return {
    button,
    show: (robot) => setAllowed(button, whyNotHeld(robot) ?? robot?.allowed?.[verb] ?? null, help),
  };
}

function build(store) {
  const [left, bar, done, poses, now, later] = [
    h("b"),
    h("i"),
    h("span"),
    h("span"),
    h("p"),
    h("p", { class: "why", role: "status", "aria-label": "Later edit", data: { toneText: "caution" } }),
  ];
  const pause = actButton(store, "Pause robot", "pause", PAUSE_HELP);
  const resume = actButton(store, "Resume robot", "resume", "The run continues from the present pose.");
  const element = h(
    "div",
    { class: "running", role: "group", "aria-label": "Run", hidden: true },
    h("p", { class: "time-left number" }, left, h("span", { class: "quiet", text: " left" })),
    h("div", { class: "progress" }, bar),
    h("p", { class: "run-figures number" }, done, poses),
    now,
    later,
    pause.button,
    resume.button,
    h("p", { class: "why", text: PAUSE_HELP }),
  );
  return { element, left, bar, done, poses, now, later, pause, resume };
}

/** Builds the part; it shows itself while a plan is carried out. */
export function runningPart(store) {
  const { element, left, bar, done, poses, now, later, pause, resume } = build(store);
  let known = { seconds: null, at: 0, elapsed: 0, isStart: false };
  let heard = new Date();

  /**
   * The studio's figures come at each pose; between two of them the page's own clock counts. The way to the
   * start pose is not in the time left.
   */
  function tick() {
    const { robot, connected } = store.state;
    if (!planIsOn(robot)) return;
    if (!connected) {
      setText(left, "–");
      setText(done, `last answer of the studio at ${clockTime(heard)}`);
      return;
    }
    const since = robot.robot === "moving" ? (performance.now() - known.at) / 1000 : 0;
    const rest = known.seconds === null ? null : Math.max(known.seconds - (known.isStart ? 0 : since), 0);
    setText(left, rest === null ? "–" : `${fixed(rest)} s`);
    setText(done, `${seconds(known.elapsed + since)} s so far`);
  }

  store.watch(
    ({ robot }) => [robot?.run?.reached, robot?.run?.phase, robot?.run?.elapsed, robot?.robot],
    ({ robot }) => {
      element.hidden = !planIsOn(robot);
      if (element.hidden) return;
      const { run } = robot;
      known = {
        seconds: run.seconds_left ?? null,
        at: performance.now(),
        elapsed: run.elapsed ?? 0,
        isStart: run.phase === "start pose",
      };
      bar.style.transform = `scaleX(${run.count ? run.reached / run.count : 0})`;
      const again = run.iterations > 1 ? `iteration ${run.iteration} of ${run.iterations}, ` : "";
      setText(poses, `${again}waypoint ${run.reached} of ${run.count}`);
      const isPaused = robot.robot === "paused";
      pause.button.hidden = isPaused;
      resume.button.hidden = !isPaused;
      tick();
    },
  );
  store.watch(
    ({ robot }) => [robot],
    ({ robot }) => {
      heard = new Date();
      pause.show(robot);
      resume.show(robot);
    },
  );
  store.watch(
    (state) => [state.robot, state.view, state.pending.length, state.gesture, state.connected],
    (state) => {
      setText(later, laterEdit(state));
      if (planIsOn(state.robot)) setText(now, state.connected ? nowText(state) : UNKNOWN);
      tick();
    },
  );
  setInterval(tick, TICK_MS);
  return element;
}
