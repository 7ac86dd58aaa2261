/** The problem of the pattern search: gaits, cursors, limbs, rules and drawn cells. This browser keeps it. */

import { recalled, remember } from "../lib/remembered.js";
import { watchable } from "../state/store.js";

const KEY = "patterns";

/** The rules in plain words, with the thesis's own number; `scale` from what a person types to SI. */
export const RULES = [
  {
    rule: "shortest_swing",
    name: "Shortest swing",
    unit: "samples",
    usual: 2,
    help:
      "Every swing lasts at least this many samples. A swing that begins before the transition or ends "
      + "after the transition may be shorter. Rule g2 of the footfall thesis",
  },
  {
    rule: "shortest_stance",
    name: "Shortest stance",
    unit: "samples",
    usual: 3,
    help:
      "Every stance between two swings lasts at least this many samples. "
      + "Rules g9 and g10 of the footfall thesis",
  },
  {
    rule: "feet_down",
    name: "Feet down, at least",
    unit: "feet",
    usual: 3,
    help: "At every sample, at least this many feet are on the ground. Rule g3 of the footfall thesis",
  },
  {
    rule: "feet_down_each_side",
    name: "Feet down on each side",
    unit: "feet",
    usual: 1,
    help:
      "At every sample, at least this many feet are on the ground on each side (left and right of the "
      + "walking direction). A foot on the centre line counts for both sides. "
      + "Rules g4 and g5 of the footfall thesis",
  },
  {
    rule: "workload",
    name: "Workloads differ by",
    unit: "samples",
    usual: 2,
    help:
      "Largest allowed difference between the numbers of stance samples of two walking limbs. "
      + "Rules g6 and g7 of the footfall thesis",
  },
  {
    rule: "limb_changes",
    name: "Changes per limb, at most",
    unit: "times",
    usual: 2,
    help:
      "Each limb changes between stance and swing at most this many times. "
      + "Rule g8 of the footfall thesis",
  },
  {
    rule: "least_swing",
    name: "Swing per limb, at least",
    unit: "samples",
    usual: 2,
    help: "Each walking limb swings in at least this many samples. Rule g11 of the footfall thesis",
  },
  {
    rule: "balance",
    name: "Balance margin",
    unit: "mm",
    usual: null,
    first: 0,
    scale: 0.001,
    help:
      "At every sample, the body can be at least this far inside the support polygon. "
      + "The body can move from sample to sample without exceeding its largest speed. "
      + "The footfall thesis has no such rule",
  },
];

/** Why a limb that stands, or swings, at every sample of both gaits cannot be locked or unlocked. */
export const LIMB_GIVEN =
  "This limb has the same state at every sample of both gaits. "
  + "Therefore it is always locked in the transition.";

/** What a change costs; the pattern of the smallest sum is best. */
export const WEIGHTS = [
  {
    weight: "sample_changes",
    name: "A moment at which any limb changes",
    usual: 1000,
    help:
      "Cost of each moment at which any limb changes between swing and stance. "
      + "The footfall thesis minimises the number of these moments",
  },
  {
    weight: "limb_changes",
    name: "A change of one limb",
    usual: 1,
    help:
      "Cost of each change of a single limb. "
      + "With the usual number 1, this cost matters only between patterns that are otherwise equal",
  },
  {
    weight: "drawing",
    name: "A cell that differs from my drawing",
    usual: 10,
    help:
      "Cost of each cell that differs from your drawing. "
      + "This cost counts in Complete, and while “Keep my drawing if possible” is on",
  },
];

export const ROLES = { walks: "walks", held: "held up", broken: "broken", stands: "stands" };

const INITIAL = Object.freeze({
  mode: "transition",
  from: { gait: null, sample: null },
  to: { gait: null, sample: null },
  samples: 20,
  shortest: false,
  walkable: true,
  cycle: 20,
  limbs: {},
  locked: [],
  rules: {},
  weights: {},
  keep: false,
  painted: false,
  count: 5,
  cells: { transition: {}, limbs: {}, drawing: {} },
});

/** The rest of the panel's state, which is not kept. */
const TRANSIENT = Object.freeze({
  freed: {},
  result: null,
  running: null,
  error: null,
  chosen: 0,
  hovered: null,
  waiting: false,
  documents: Object.freeze({}),
});

const keep = (state) =>
  remember(KEY, Object.fromEntries(Object.keys(INITIAL).map((name) => [name, state[name]])));

/** The parts of the state that define the problem; a change of one of them starts a new search. */
export const problemParts = (state) =>
  Object.keys(INITIAL)
    .map((name) => state[name])
    .concat([state.freed]);

/** Creates the state of the panel, which is watched like the page's store. */
export function createProblem() {
  const problem = watchable({ ...recalled(KEY, INITIAL), ...TRANSIENT });
  problem.watch(problemParts, keep);
  return problem;
}

/** A rule's number as a person sees it, and whether it holds. */
export function ruleOf({ rules }, { rule, usual, first = usual }) {
  const own = rules[rule];
  return { value: own?.value ?? first, on: own?.on ?? usual !== null, usual: own === undefined };
}

/** The rules as they are sent: SI, null for off. */
function rulesOf(state) {
  return Object.fromEntries(
    RULES.map((one) => {
      const { value, on } = ruleOf(state, one);
      return [one.rule, on ? (one.scale ? Number((value * one.scale).toPrecision(9)) : value) : null];
    }),
  );
}

/** What each limb does in the mode for some limbs; a robot that is new to the panel walks on all of them. */
export function limbsOf(problem, { robot, legs }) {
  const own = problem.limbs[robot];
  return own?.length === legs ? own : Array.from({ length: legs }, () => "walks");
}

/**
 * The drawn cells of the shown mode.
 * @param {Record<string, any>} state
 */
export const drawnCells = ({ cells, mode }) => cells[mode];

/** The state's change that gives the shown mode other drawn cells. */
export const withCells = (state, changed) => ({ cells: { ...state.cells, [state.mode]: changed } });

const tuples = (cells) => Object.entries(cells).map(([key, value]) => [...key.split(",").map(Number), value]);

/**
 * The requested length of the pattern, or null if the search chooses it.
 * @param {Record<string, any>} state
 */
export const lengthOf = ({ mode, samples, shortest, cycle }) =>
  mode === "limbs" ? cycle : mode === "transition" && !shortest ? samples : null;

/**
 * The problem as the request's body.
 * @param {Record<string, any>} state of `createProblem`
 * @param {{
 *   gait: string,
 *   limbs: string[],
 *   document: Record<string, any>|null,
 *   drawing: string[]|null,
 *   isFree: (limb: number, sample: number) => boolean,
 * }} page the open gait, what its limbs do, its document where an edit is under way, the rows to keep where
 *   that can be, and which cells are not given: what was drawn beyond the end waits for a longer pattern
 */
export function bodyOf(state, { gait, limbs, document, drawing, isFree }) {
  const { mode, from, to, count, locked, painted } = state;
  const samples = lengthOf(state);
  const cells = tuples(drawnCells(state)).filter(([limb, sample]) => isFree(limb, sample));
  const common = {
    kind: mode,
    count,
    cells,
    rules: rulesOf(state),
    weights: Object.fromEntries(WEIGHTS.map(({ weight, usual }) => [weight, state.weights[weight] ?? usual])),
    freed: tuples(state.freed).map(([limb, sample]) => [limb, sample]),
    drawing: state.keep ? drawing : null,
    once_an_order: true,
  };
  if (mode === "transition")
    return {
      ...common,
      gait: from.gait,
      sample: from.sample,
      to: to.gait,
      to_sample: to.sample,
      samples,
      locked,
      walkable: state.walkable,
    };
  if (mode === "limbs") return { ...common, gait, samples, limbs };
  return { ...common, gait, painted, ...(document ? { document } : {}) };
}

/** The change of state that a relaxation proposes, with those that go with it. */
export const relaxed = (state, relaxation) =>
  relaxation.also.reduce(
    (change, further) => ({ ...change, ...applied({ ...state, ...change }, further) }),
    applied(state, relaxation),
  );

function applied(state, { rule, value, cells, samples }) {
  if (samples) return state.mode === "limbs" ? { cycle: samples } : { samples, shortest: false };
  if (rule !== "fixed") {
    const { scale, usual, first = usual } = RULES.find((one) => one.rule === rule);
    // Such a relaxation allows swings shorter than the feet need.
    const walkable = state.walkable && !["shortest_swing", "least_swing"].includes(rule);
    return {
      walkable,
      rules: {
        ...state.rules,
        [rule]:
          value === null
            ? { on: false, value: ruleOf(state, { rule, usual, first }).value }
            : { on: true, value: scale ? Number((value / scale).toPrecision(9)) : value },
      },
    };
  }
  const drawn = { ...drawnCells(state) };
  const freed = { ...state.freed };
  const limbs = new Set(cells.map(([limb]) => limb));
  for (const [limb, sample] of cells) {
    if (state.locked.includes(limb)) continue;
    if (`${limb},${sample}` in drawn) delete drawn[`${limb},${sample}`];
    else freed[`${limb},${sample}`] = 1;
  }
  return { ...withCells(state, drawn), freed, locked: state.locked.filter((limb) => !limbs.has(limb)) };
}
