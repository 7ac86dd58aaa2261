/** Computes what the grid shows: the current pattern, and which of its cells are fixed and why. */

import { timelineOf } from "./pattern_gaits.js";
import { drawnCells, limbsOf } from "./pattern_problem.js";
import { shownDocument } from "../state/store.js";

/** Limbs that do one thing all along in both gaits: a transition leaves them so. */
function given(first, second, foot) {
  const rows = [first, second].map(({ timeline }) => timeline.feet[foot]);
  return rows.every((row) => row && row === row[0].repeat(row.length)) && rows[0][0] === rows[1][0];
}

function ofTransition(store, problem) {
  const { from, to, locked, result, shortest, samples } = problem.state;
  const [first, second] = [from, to].map(({ gait }) => timelineOf(store, problem, gait));
  if (!first || !second || first.timeline.feet.length !== second.timeline.feet.length) return null;
  const count = shortest ? (result?.samples ?? samples) : samples;
  const at = ({ timeline }, { sample }) => Math.min(sample, timeline.feet[0].length - 1);
  const ends = (foot) => [
    first.timeline.feet[foot][at(first, from)],
    second.timeline.feet[foot][at(second, to)],
  ];
  const isLocked = (foot) =>
    given(first, second, foot) || (locked.includes(foot) && ends(foot)[0] === ends(foot)[1]);
  return {
    legs: first.timeline.feet.length,
    samples: count,
    isLocked,
    limbHelp:
      "Click to lock or unlock this limb. "
      + "A locked limb stays in swing or in stance during the whole transition",
    given: (foot) => given(first, second, foot),
    lockRefusal: (foot) =>
      ends(foot)[0] === ends(foot)[1]
        ? null
        : "This limb cannot be locked, because it stands at one end of the transition "
          + "and swings at the other end. "
          + "Move the cursor in one of the two gaits first.",
    base: (foot, sample) =>
      sample === 0
        ? ["end", ends(foot)[0]]
        : sample === count - 1
          ? ["end", ends(foot)[1]]
          : isLocked(foot)
            ? ["limb", ends(foot)[0]]
            : null,
  };
}

function ofLimbs(store, problem) {
  const document = shownDocument(store.state);
  const limbs = limbsOf(problem.state, { robot: document.robot, legs: document.timeline.feet.length });
  const isLocked = (foot) => limbs[foot] !== "walks";
  return {
    legs: limbs.length,
    samples: problem.state.cycle,
    isLocked,
    limbHelp: "Click to hold this limb up, or to let the limb walk",
    base: (foot) => (isLocked(foot) ? ["limb", limbs[foot] === "stands" ? "1" : "0"] : null),
  };
}

function ofDrawing(store, problem) {
  const { feet, locked } = shownDocument(store.state).timeline;
  const [count, painted] = [feet[0].length, problem.state.painted];
  const stays = (foot, sample) => locked?.[foot]?.[sample] === "1" || (painted && feet[foot][sample] === "0");
  return {
    legs: feet.length,
    samples: count,
    isLocked: () => false,
    limbHelp: null,
    before: feet,
    base: (foot, sample) =>
      sample === 0 || sample === count - 1
        ? ["end", feet[foot][sample]]
        : stays(foot, sample)
          ? ["given", feet[foot][sample]]
          : null,
  };
}

const SOURCES = { transition: ofTransition, limbs: ofLimbs, drawing: ofDrawing };

/** Rows of the best pattern yet, else of the last result, if they have this size. */
function rowsOf({ result, running, chosen, hovered }, { legs, samples }) {
  const rows = running?.pattern?.feet ?? result?.patterns[hovered ?? chosen]?.feet ?? null;
  return rows?.length === legs && rows[0].length === samples ? rows : null;
}

/**
 * What `patternGrid` shows, or null while the gaits are not known yet. `rows` are of 1 and 0, or null while
 * nothing is known; `fixed` returns why a cell is fixed, or null; `before` are the rows of the drawing.
 * @param {import("../state/store.js").Store} store
 * @param {Record<string, any>} problem
 */
export function patternGridModel(store, problem) {
  if (!store.state.view) return null;
  const source = SOURCES[problem.state.mode](store, problem);
  if (!source) return null;
  const [drawn, { freed, waiting, running }] = [drawnCells(problem.state), problem.state];
  const given = (foot, sample) => (`${foot},${sample}` in freed ? null : source.base(foot, sample));
  const own = (foot, sample) =>
    given(foot, sample)
    ?? (`${foot},${sample}` in drawn ? ["drawn", String(drawn[`${foot},${sample}`])] : null);
  return {
    ...source,
    roles: store.state.view.roles ?? [],
    rows: rowsOf(problem.state, source),
    stale: waiting && !running?.pattern,
    isFree: (foot, sample) =>
      foot < source.legs
      && (problem.state.shortest || sample < source.samples)
      && given(foot, sample) === null,
    fixed: (foot, sample) => own(foot, sample)?.[0] ?? null,
    fixedValue: (foot, sample) => {
      const found = own(foot, sample);
      return found ? Number(found[1]) : null;
    },
  };
}
