/**
 * The jog: one motor, one foot or the body moved by small steps. The buttons − and + move only the target,
 * which is shown as a ghost in 3D and in numbers; the robot moves when Move is pressed.
 */

import { api } from "../api/gaits.js";
import { isSequence } from "../document/sequence_edits.js";
import { h, onPress, setAllowed, setText } from "../lib/dom.js";
import { counted, fixed, seconds } from "../lib/format.js";
import { latestOnly } from "../lib/latest_only.js";
import { attempt, report, toast } from "../lib/toasts.js";
import { whyNotHeld } from "../state/lease.js";
import { needOperator } from "../state/operator.js";
import { segmentDraftOf } from "../state/segment_draft.js";
import { acceptRobot, shownDocument, watchable } from "../state/store.js";
import { jogRows } from "./jog_rows.js";
import { handlesOf, PARTS, withStep } from "./jog_steps.js";

const STEP_MM = { least: 0.1, most: 10, first: 2 };
const BEGINS = {
  measured: "The jog starts at the present strokes of the motors.",
  standing: "The present strokes are not known. The jog starts with every motor at 8 mm.",
};

const robotOf = ({ view }) => view?.document.robot ?? "deltawalker";

/** The server's answer to the current choice, or null if the answer is older. */
const answerOf = ({ answer, requested }, key) => (requested === key ? answer : null);

function build(change) {
  const parts = PARTS.map(([value, text]) =>
    h("button", { text, "aria-pressed": "false", on: { click: () => change({ part: value }) } }),
  );
  const foot = h("select", {
    "aria-label": "Foot to jog",
    on: { change: () => change({ foot: Number(foot.value) }) },
  });
  const size = h("input", {
    type: "number",
    min: STEP_MM.least,
    max: STEP_MM.most,
    step: "0.1",
    value: STEP_MM.first,
    "aria-label": "Jog step",
  });
  return {
    parts,
    foot,
    size,
    findings: h("ul", { class: "jog-findings" }),
    target: h("p", { class: "why" }),
    why: h("p", { class: "why" }),
    move: h("button", { class: "primary", text: "Move", "data-robot": true }),
    back: h("button", { text: "Target to present pose" }),
  };
}

function choiceRow({ parts, foot, size }) {
  return h(
    "div",
    { class: "jog-choice" },
    h("div", { class: "jog-parts", role: "group", "aria-label": "What to jog" }, ...parts),
    foot,
    h(
      "label",
      { title: `The buttons − and + move the target by this step, ${STEP_MM.least} to ${STEP_MM.most} mm` },
      h("span", { text: "Step" }),
      h("span", { class: "box", data: { unit: "mm" } }, size),
    ),
  );
}

function showChoice({ parts, foot }, { part, foot: chosen }, feet) {
  parts.forEach((button, index) => button.setAttribute("aria-pressed", String(PARTS[index][0] === part)));
  if (foot.options.length !== feet)
    foot.replaceChildren(
      ...Array.from({ length: feet }, (_, index) =>
        h("option", { value: String(index + 1), text: `Foot ${index + 1}` }),
      ),
    );
  foot.value = String(chosen);
  foot.hidden = part === "body";
}

function targetText(
  { wired, moves, seconds: takes, stop_seconds: stop, margin_mm: margin, from, residual_mm: residual },
  steps,
) {
  if (!steps.length) return BEGINS[from] ?? "";
  const off = Math.max(0, ...(residual ?? []).map(Math.abs));
  if (!wired) {
    return (
      "This program cannot move this robot, so only the 3D preview shows the target. "
      + "The motors are coupled, so the achievable strokes differ from your target by up to "
      + `${fixed(off)} mm.`
    );
  }
  if (!moves) return "";
  const balance = margin === null ? "" : ` Margin ${fixed(margin)} mm.`;
  return (
    `${counted(moves, "move")}, about ${seconds(takes)} s. `
    + `Stop acts within ${seconds(stop)} s.${balance}`
  );
}

const findingRow = ({ severity, sentence }) =>
  h("li", { data: { toneText: severity === "error" ? "bad" : "caution" }, text: sentence });

/** Why nothing can be moved now; null where Move may be pressed. */
function whyNotMove({ robot }, answer) {
  if (!answer) return "The studio has not answered yet.";
  return (answer.wired && robot && whyNotHeld(robot)) || answer.reason;
}

/** Requests where the steps lead, for the newest steps only. */
function asking(own) {
  return latestOnly(async ({ key, body }) => {
    try {
      const answer = await api.robot("jog", { ...body, preview: true });
      own.set({ requested: key, answer });
    } catch (error) {
      own.set({ requested: key, answer: null });
      report(error);
    }
  });
}

/** Everything that an answer depends on; strokes to a tenth of a millimetre, which no motor shakes by. */
const keyOf = ({ robot, view }, { part, foot, steps }) =>
  JSON.stringify([
    robotOf({ view }),
    part,
    foot,
    steps,
    robot?.robot,
    robot?.link,
    robot?.strokes_mm?.map((one) => one.toFixed(1)),
  ]);

function moving(store, own, body) {
  return attempt(async () => {
    const by = await needOperator(store, "The studio records your name with every movement that you start.");
    const { answer } = own.state;
    if (!by || !answer) return;
    acceptRobot(store, await api.robot("jog", { ...body(), seen_mm: answer.target_mm, by }));
    own.set({ steps: [] });
  });
}

/** Takes a new step's size from its field; one that is out of range is refused. */
function followSize(size, own) {
  size.addEventListener("change", () => {
    const requested = Number(size.value);
    if (requested >= STEP_MM.least && requested <= STEP_MM.most) own.set({ size: requested });
    else
      toast(
        `Enter a step between ${STEP_MM.least} and ${STEP_MM.most} mm. `
          + `The step stays at ${own.state.size} mm.`,
      );
    size.value = String(own.state.size);
  });
}

/** The group, with `poseButton` below what moves the robot. */
function assemble(parts, rows, poseButton) {
  return h(
    "details",
    { class: "more jog", role: "group", "aria-label": "Jog" },
    h("summary", { text: "Jog: move a motor, a foot or the body in small steps" }),
    h(
      "div",
      {},
      choiceRow(parts),
      rows.element,
      h("div", { role: "status", "aria-label": "Jog findings" }, parts.findings),
      parts.target,
      h("div", { class: "buttons" }, parts.move, parts.back),
      parts.why,
      poseButton,
    ),
  );
}

/** Shows the answer to the present choice; until it comes, the words of the last one stay. */
function showAnswer(parts, state, now, answer) {
  parts.findings.replaceChildren(...(answer?.findings ?? []).map(findingRow));
  const why = whyNotMove(state, answer);
  setAllowed(parts.move, why, "Moves the robot to the target, slowly and in small moves");
  if (answer || !now.answer) {
    setText(parts.target, answer ? targetText(answer, now.steps) : "");
    setText(parts.why, why && !answer?.findings.some(({ sentence }) => sentence === why) ? why : "");
  }
  setAllowed(
    parts.back,
    now.steps.length ? null : "The target is already the present pose of the robot.",
    "Set the target back to the present pose of the robot. The robot does not move",
  );
}

/** What the rest of the page knows of the jog, from the newest answer. */
function jogOf(body, { target_mm: pose = null, wired = false }) {
  return { ...body, pose_mm: pose, target_mm: body.steps.length ? pose : null, wired };
}

/**
 * Builds its group in the step Run.
 * @returns {HTMLElement}
 */
export function jogPart(store, edits) {
  const own = watchable({
    isOpen: false,
    part: "foot",
    foot: 1,
    steps: [],
    size: STEP_MM.first,
    requested: null,
    answer: null,
  });
  const parts = build((patch) => own.set(patch));
  const rows = jogRows((index, sign) => {
    const { state } = own;
    own.set({ steps: withStep(state.steps, handlesOf(state)[index], sign * state.size) });
  });
  const body = () => ({ robot: robotOf(store.state), steps: own.state.steps });
  const ask = asking(own);
  let sent = null;
  const element = assemble(parts, rows, poseToSegment(store, edits));

  element.addEventListener("toggle", () => own.set({ isOpen: element.open }));
  followSize(parts.size, own);
  onPress(parts.move, moving(store, own, body), (why) => toast(why));
  onPress(
    parts.back,
    () => own.set({ steps: [] }),
    (why) => toast(why),
  );

  function show() {
    const [state, now] = [store.state, own.state];
    const feet = state.view?.roles?.length ?? 4;
    if (now.foot > feet) return own.set({ foot: 1 });
    if (!now.isOpen) return state.jog && store.set({ jog: null });
    const key = keyOf(state, now);
    if (now.requested !== key && key !== sent)
      ask({ key, body: { ...body(), look: { part: now.part, foot: now.foot } } });
    sent = key;
    const answer = answerOf(now, key);
    const newest = answer ?? now.answer;
    showChoice(parts, now, feet);
    rows.show(handlesOf(now), newest?.handles ?? null, now.size);
    showAnswer(parts, state, now, answer);
    store.set({ jog: jogOf(body(), newest ?? {}) });
    return undefined;
  }

  own.watch((state) => Object.values(state), show);
  store.watch(({ robot, view }) => [robot, view?.document.robot, view?.roles], show);
  return element;
}

const HELP =
  "Add a segment to the end of the segment table. In this segment every foot moves to the target. "
  + "Without a target, every foot moves to the present pose";

/** Why the pose cannot be taken; null where it can. */
function whyNot(state) {
  const document = shownDocument(state);
  if (!document) return "No gait is selected.";
  if (isSequence(document))
    return "A sequence has no segment table. Choose one of the gaits in the sequence.";
  if (!document.segment_table) {
    return (
      "This gait has no segment table. "
      + "Make a table in the view Segments, or choose a gait of the group By hand."
    );
  }
  if (segmentDraftOf(state).steps.length) {
    return (
      "Some segments of the segment table do not fit together. "
      + "Repair the table in the view Segments first."
    );
  }
  return state.jog?.pose_mm ? null : "The robot cannot reach the target. Choose another target.";
}

/** Builds the button; `edits` makes the change an edit of the gait. */
function poseToSegment(store, edits) {
  const button = h("button", { class: "wide", text: "Take this pose as a waypoint" });
  const take = attempt(async () => {
    const [document, { selected: gait }] = [shownDocument(store.state), store.state];
    const { table, name, segment, sentences } = await api.poseTable({
      document,
      strokes_mm: store.state.jog.pose_mm,
    });
    const label = `Add ${name} as segment ${segment}`;
    edits.edit((now) => ({ ...now, segment_table: table }), label, { drawing: true, gait });
    const added = `“${name}” was added to the segment table as segment ${segment}.`;
    toast([added, ...sentences].join(" "), { of: "studio" });
  });
  onPress(button, take, (why) => toast(why));
  store.watch(
    (state) => [state.view, state.pending, state.gesture, state.segmentDrafts, state.jog],
    (state) => setAllowed(button, whyNot(state), HELP),
  );
  return button;
}
