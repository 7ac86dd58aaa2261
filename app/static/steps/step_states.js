/** How far the shown gait is on its way to the robot: the state of each step, for tabs, strip and buttons. */

import { isThin, planState } from "../state/plan_state.js";
import { simulationJob, simulationOf, simulationOver, simulationText } from "../state/simulation.js";
import { planIsOn, shownPlan } from "../state/store.js";
import { jobIsOn } from "../shell/job_list.js";
import { lowered } from "../lib/format.js";

/** Marks of a state: `done`, `running` (with a share), `old` (out of date), `failed`, `none` (not yet). */
const state = (mark, word, share = null) => ({ mark, word, share });

/**
 * The parts of the store that a state depends on, but for those of the robot.
 * @param {Record<string, any>} now the store's state
 */
export const gaitParts = ({
  view,
  jobs,
  simulation,
  selected,
  live,
  tryout,
  checked,
  pending,
  gesture,
  iterate,
  preview,
  poseSearch,
  seenWarnings,
}) => [
  view,
  jobs,
  simulation,
  selected,
  live,
  tryout,
  checked,
  pending.length,
  gesture === null,
  iterate,
  preview === null,
  poseSearch?.state,
  seenWarnings,
];

const MARK_OF = { good: "done", caution: "old", bad: "failed", quiet: "none" };

function designState(now) {
  const busy = now.jobs.some(
    (job) => job.gait === now.selected && ["optimise", "timing"].includes(job.kind) && jobIsOn(job),
  );
  if (busy) return state("running", "being optimised", 0.25);
  if (now.view?.search?.state === "running" && !now.view.plan?.times.length)
    return state("running", "being searched", 0.25);
  const plan = shownPlan(now);
  const [word, tone] = planState(plan);
  // Below the margin that the robot needs only physics can say whether it walks.
  if (tone === "good" && isThin(plan) && !simulationOver(now)) {
    return state("old", "small stability margin, not simulated yet");
  }
  return state(MARK_OF[tone], lowered(word));
}

/** True while an edit is under way, so that nothing that was computed is of what is shown. */
const isEdited = ({ view, pending, gesture, live }) =>
  Boolean(pending.length || gesture || (live && live.plan !== view?.plan));

/** The state of physics for the shown gait, with its word. */
export function simulateState(now) {
  const job = simulationJob(now);
  if (job)
    return state(
      "running",
      job.state === "running" ? `${Math.round((job.share ?? 0) * 100)} %` : job.state,
      job.share ?? 0,
    );
  const last = now.jobs.find((one) => one.gait === now.selected && one.kind === "simulate");
  if (!now.view?.simulation)
    return last?.state === "failed" ? state("failed", "failed") : state("none", "not yet");
  const simulation = simulationOf(now);
  const isFresh = now.view.simulation.fresh && !isEdited(now);
  if (!simulation) return isFresh ? state("running", "being fetched", 0) : state("old", "before this edit");
  if (!isFresh || !simulationOver(now)) return state("old", "before this edit");
  const [word, tone] = simulationText(simulation);
  return state(tone === "bad" ? "failed" : "done", lowered(word));
}

const warnings = (verdict) => verdict.findings.filter(({ severity }) => severity === "warning").length;

/** The state of the check, with its word. */
export function checkState(now) {
  const { view, checked } = now;
  if (!view) return state("none", "not yet");
  if (view.verdict && !isEdited(now)) {
    if (!view.verdict.passed) return state("failed", "failed");
    const count = warnings(view.verdict);
    return state("done", count ? `passed, ${count === 1 ? "1 warning" : `${count} warnings`}` : "passed");
  }
  const before = checked[view.id];
  const isBeforeEdit = isEdited(now) || (before && before.revision !== view.revision);
  if (view.verdict || view.revoked || before) {
    return state("old", isBeforeEdit ? "before this edit" : "out of date");
  }
  return state("none", "not yet");
}

/** The state of the approval, with who gave it. */
export function approvalState(now) {
  const { view, checked } = now;
  if (view?.approval && !isEdited(now)) {
    const { by, override } = view.approval;
    return state("done", override ? `by ${by}, with errors` : `by ${by}`);
  }
  if (view?.approval || view?.revoked || (view && checked[view.id]?.word === "approved"))
    return state("old", "no longer valid");
  return state("none", "not yet");
}

/** Check and approval as one step. */
function checkAndApprovalState(now) {
  const [check, approval] = [checkState(now), approvalState(now)];
  if (approval.mark === "done") return state("done", `approved ${approval.word}`);
  if (check.mark === "done") return state("running", `${check.word}, not approved yet`, 0.5);
  return check.mark === "none" ? approval : check;
}

const RUN_MARKS = { done: "done", fault: "failed", stopped: "failed", lost: "failed", interrupted: "failed" };

/** The state while a plan runs; of another gait than the shown one with its name. */
function underWay({ robot, run }, selected) {
  const word = run.gait === selected || !run.gait_name ? robot : `${robot}: ${run.gait_name}`;
  return state("running", word, run.count ? run.reached / run.count : 0);
}

function runState(now) {
  const { robot, view, selected } = now;
  if (planIsOn(robot)) return underWay(robot, selected);
  const run = robot?.run;
  const last = run?.gait ? { ...run, state: run.end } : robot?.previous_run;
  if (!last || !view || last.gait !== selected) return state("none", "not yet");
  if (last.waypoints_hash !== view.plan?.waypoints_hash || isEdited(now)) {
    return state("old", "last run was before this edit");
  }
  return state(RUN_MARKS[last.state] ?? "none", last.state);
}

/**
 * The state of each step.
 * @param {Record<string, any>} now the store's state
 * @returns {Record<"design"|"simulate"|"check"|"run", {mark: string, word: string, share: number|null}>}
 */
export function stepStates(now) {
  return {
    design: designState(now),
    simulate: simulateState(now),
    check: checkAndApprovalState(now),
    run: runState(now),
  };
}
