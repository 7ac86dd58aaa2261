/** The state of a plan in a word or two, with its tone. */

/** @type {Record<string, string[]>} */
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

/** Half of what a shown margin is rounded to, m: a motion runs along the margin that it was asked for. */
const SHOWN_M = 5e-5;

/** @typedef {Record<string, any>} Plan */

/**
 * Plans that are not what their source promises; the first that is true of a plan names its state.
 * @type {[(plan: Plan) => any, string, string][]}
 */
const EXCEPTIONS = [
  [({ live }) => live?.status === "infeasible", "No motion", "bad"],
  [({ poses }) => poses?.explanation.length, "No motion", "bad"],
  [({ source }) => source === "adapted", "Adapted, not solved", "caution"],
  [({ times }) => !times.length, "No motion", "bad"],
  [hasFinishedParts, "No motion", "bad"],
  [({ source }) => source === "draft", "No answer", "bad"],
  [({ source, refusal }) => source === "recorded" && refusal, "Recorded, out of reach", "bad"],
  [({ source, refusal }) => source === "manual" && refusal, "By hand, out of reach", "bad"],
  [({ source, balance }) => source === "manual" && balance < -ROUNDING_M, "By hand, off balance", "bad"],
];

/** Whether a draft has parts, each of which the solver finished. @param {Plan} plan */
function hasFinishedParts({ source, parts }) {
  return (
    source === "draft"
    && parts?.length
    && !parts.some((/** @type {Record<string, any>} */ part) => part.broke_off)
  );
}

/** Whether a drawing's motion has less than the margin that its robot needs as sent. @param {Plan} plan */
export const isThin = ({ source, balance, robot_margin: needed }) =>
  ["live", "optimised"].includes(source) && balance !== null && balance < needed - SHOWN_M;

/**
 * Word and tone of a plan's state.
 * @param {Plan|null|undefined} plan
 * @returns {string[]}
 */
export function planState(plan) {
  if (!plan) return ["No plan", "quiet"];
  const exception = EXCEPTIONS.find(([applies]) => applies(plan));
  if (!exception) return TEXTS[plan.source] ?? [plan.source, "quiet"];
  const [, words, tone] = exception;
  return [words, tone];
}
