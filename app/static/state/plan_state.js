/** The state of a plan in a word or two, with its tone. */

const TEXTS = {
  live: ["Plan found", "good"],
  optimised: ["Optimised", "good"],
  manual: ["By hand", "good"],
  sequence: ["Sequence", "good"],
  iterate: ["Optimiser iteration", "caution"],
  recorded: ["Recorded", "good"],
  poses: ["Plan found", "good"],
};
const ROUNDING_M = 1e-6;

/** Half of what a margin is rounded to where it is shown, m: a motion runs along the margin that it was asked for. */
const SHOWN_M = 5e-5;

/** Whether a drawing's motion has less than the margin that its robot needs as sent. */
export const isThin = ({ source, balance, robot_margin: needed }) =>
  ["live", "optimised"].includes(source) && balance !== null && balance < needed - SHOWN_M;

/** Word and tone of a plan's state. */
export function planState(plan) {
  if (!plan) return ["No plan", "quiet"];
  if (plan.live?.status === "infeasible") return ["No motion", "bad"];
  if (plan.poses?.explanation.length) return ["No motion", "bad"];
  if (plan.source === "adapted") return ["Adapted, not solved", "caution"];
  if (!plan.times.length) return ["No motion", "bad"];
  if (plan.source === "draft" && plan.parts?.length && !plan.parts.some((part) => part.broke_off))
    return ["No motion", "bad"];
  if (plan.source === "draft") return ["No answer", "bad"];
  if (plan.source === "recorded" && plan.refusal) return ["Recorded, out of reach", "bad"];
  if (plan.source === "manual" && plan.refusal) return ["By hand, out of reach", "bad"];
  if (plan.source === "manual" && plan.balance < -ROUNDING_M) return ["By hand, off balance", "bad"];
  return TEXTS[plan.source] ?? [plan.source, "quiet"];
}
