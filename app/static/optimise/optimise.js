/** The section Optimise: the live tier's answer for the shown gait, options, and the exact tier's button. */

import { api } from "../api/gaits.js";
import { byId, h, onPress, setAllowed, setAttribute, setText } from "../lib/dom.js";
import { clockTime, fixed, shortHash } from "../lib/format.js";
import { attempt, toast } from "../lib/toasts.js";
import { selectGait } from "../shell/gait_list.js";
import { makeGait } from "../shell/gait_menu.js";
import { jobIsOn } from "../shell/job_list.js";
import { presetFor } from "../shell/new_gait.js";
import { fallOf } from "../state/live_plan.js";
import { hasNoMotion, ownPlan, shownDocument } from "../state/store.js";
import { clippedStrokes } from "./clipped.js";
import { mountConvergence } from "./convergence.js";
import { drawFreelyButton, fasterButton } from "./faster.js";
import { mountIterates } from "./iterates.js";
import { jobAnswer, liveAnswer } from "./live_answer.js";
import { optimiserOptions } from "./optimiser_options.js";
import { hasField } from "./pose_option_fields.js";
import { pinnedPoses } from "./pinned_poses.js";
import { poseSearch } from "./pose_search.js";
import { timingAnswer, timingButton, timingNote } from "./timing.js";

const POSES =
  "After each edit, the studio searches for the fastest motion. "
  + "Meanwhile you see the last motion, adapted to the new values.";
const nameOf = (element) => element.querySelector("[aria-label]").getAttribute("aria-label");

const TIERS =
  "The plan is updated after each edit. Optimise also improves the footholds and the body height.";

function exactButton(store) {
  const button = h("button", { class: "wide", text: "Optimise" });
  onPress(
    button,
    attempt(async () => {
      const { id } = await api.optimise(store.state.selected);
      store.set({ shownJob: id });
    }),
    (why) => toast(why),
  );
  store.watch(
    ({ jobs, view, pending, selected }) => [jobs, view, pending.length, selected],
    (state) => {
      const busy = state.jobs.some(
        (job) => job.gait === state.selected && job.kind === "optimise" && jobIsOn(job),
      );
      const why = !state.view
        ? "No gait is selected."
        : busy
          ? "This gait is being optimised. Cancel the job, or wait until the job ends."
          : null;
      setAllowed(
        button,
        why
          ?? (state.view.document.poses ? POSES : null)
          ?? (state.pending.length ? "The studio is still saving your last edit." : null),
        TIERS,
      );
    },
  );
  return button;
}

/** Shows the fields that a gait has with its values, and why a value was refused. */
function followDocument(store, fields, changed, error) {
  store.watch(
    ({ view, pending, gesture, formError }) => [view, pending, gesture, formError],
    (state) => {
      const document = shownDocument(state);
      if (!document) return;
      for (const field of fields) {
        field.element.hidden = !hasField(document, nameOf(field.element));
        if (!field.element.hidden) field.show(document);
      }
      changed.textContent = moreInShort(document);
      error.hidden = !state.formError;
      error.textContent = state.formError ?? "";
    },
  );
}

function followAnswers(store, advice, answer, timing) {
  store.watch(
    (state) => [ownPlan(state), state.remedies, fallOf(state)],
    (state) => advice.show(state),
  );
  store.watch(
    ({ jobs, shownJob, selected }) => [jobs, shownJob, selected],
    (state) => answer.show(state),
  );
  store.watch(
    ({ jobs, selected, view }) => [jobs, selected, view?.document],
    (state) => timing.show(state),
  );
}

/**
 * Builds the section.
 * @param {import("../state/store.js").Store} store
 * @param {import("../state/edits.js").Edits} edits
 * @param {(finding: {sample: number, foot: number|null}) => void} goTo shows a place on timeline and in 3D
 */
export function mountOptimise(store, edits, goTo) {
  const show = (id) => selectGait(store, id);
  const { robot, order, main, more } = optimiserOptions(
    store,
    edits,
    attempt((other, document) => makeGait(store, show, presetFor(other, document))),
  );
  const fields = [robot, order, ...main, ...more];
  const goToMissing = ({ first, last, feet }) =>
    goTo({ sample: Math.floor((first + last) / 2), foot: feet.length === 1 ? feet[0] : null });
  const [advice, answer] = [liveAnswer(store, edits, goToMissing), jobAnswer()];
  const timing = timingAnswer(store, edits);
  const error = h("p", { class: "box-note", role: "alert", data: { tone: "bad" }, hidden: true });
  const section = byId("optimise");
  const why = h("p", { class: "why" });
  const changed = h("span", { class: "quiet" });
  section.append(
    advice.element,
    h("div", { class: "fields" }, robot.element, order.element, ...main.map(({ element }) => element)),
    error,
    poseSearch(store),
    pinnedPoses(store, edits, goTo),
    answer.element,
    h(
      "details",
      { class: "more" },
      h("summary", {}, "More", changed),
      h("div", { class: "fields" }, ...more.map(({ element }) => element)),
    ),
    h("div", { class: "solve" }, exactButton(store), timingButton(store)),
    h("div", { class: "solve" }, fasterButton(store, edits, show), drawFreelyButton(store, edits)),
    timingNote(store),
    timing.element,
    why,
    noteLine(store),
    clippedStrokes(store, edits, goTo),
    originLine(store),
  );
  store.watch(
    ({ view }) => [Boolean(view?.document.poses)],
    ({ view }) => setText(why, view?.document.poses ? POSES : TIERS),
  );
  mountConvergence(store, section);
  const iterates = mountIterates(store, section);

  followDocument(store, fields, changed, error);
  // A refusal is of the document that was edited; another one, or a later version, is not concerned.
  store.watch(
    ({ selected, view }) => [selected, view?.revision],
    () => store.set({ formError: null }),
  );
  followAnswers(store, advice, answer, timing);
  return { cancel: () => fields.some((field) => field.cancel?.()) || iterates.leave() };
}

/** What differs from the usual under the fold, so that it is not forgotten. */
function moreInShort({ direction, options, held, poses }) {
  const ofPoses = [poses?.overlap && "overlapping swings", direction > 1 && `direction ${direction}`];
  const parts = poses
    ? ofPoses
    : [
        options.workspace !== "stroke" && "cylinder",
        options.cost !== "gentle" && `cost ${options.cost}`,
        direction > 1 && `direction ${direction}`,
        options.boundary === "periodic" && "cycle",
        options.friction !== null && "friction",
        options.motor_speed !== null && "motor speed",
        options.motor_acceleration !== null && "motor acceleration",
        options.turning === "return" && "turns at the end",
        held && "feet held up",
      ];
  const said = parts.filter(Boolean);
  return said.length ? `: ${said.join(", ")}` : "";
}

/** What there is to say of the plan beside its figures. */
function noteLine(store) {
  const element = h("p", { class: "why", role: "status", "aria-label": "Plan" });
  store.watch(
    (state) => [state.iterate, ownPlan(state), state.view === null],
    (state) => {
      // Not that of a way out: the panel would move under the pointer.
      const plan = state.iterate?.plan ?? ownPlan(state);
      setText(
        element,
        hasNoMotion(plan)
          ? ""
          : plan
            ? plan.note.replace(/^\w+: /, "")
            : state.view
              ? "This gait has no plan yet. Press Optimise to see the gait move."
              : "",
      );
    },
  );
  return element;
}

const QUIET = { text: "", title: null, tone: null };

function ofFile({ file, form, assumed }) {
  const text =
    form === "waypoints"
      ? `This motion was read from the waypoints in ${file}. Optimise replaces the motion.`
      : `This motion was recorded in ${file}. Optimise replaces the motion.`;
  return { text, title: assumed.join("\n") || null, tone: null };
}

function details({ solver, method, program, motion, trajectory }) {
  return (
    `Solver ${solver}, method ${method}, Footfall Studio ${program}\nHash of the problem `
    + `${shortHash(motion)}, hash of the result ${shortHash(trajectory)}`
  );
}

function ofResult(provenance, source, isEdited) {
  const { made, seconds, matches, at_hand: isHere } = provenance;
  const [when, title] = [clockTime(made), details(provenance)];
  if (!matches || isEdited)
    return {
      text:
        `The result of Optimise (${when}) is for another version of `
        + `this gait. The result is out of date.`,
      title,
      tone: "caution",
    };
  if (isHere) return { text: `Optimised ${when} in ${fixed(seconds * 1000, 0)} ms.`, title, tone: null };
  if (source === "optimised")
    return {
      text: `Another studio optimised this gait (${when}). This studio computed the shown motion again.`,
      title,
      tone: null,
    };
  return {
    text:
      `Another studio optimised this gait (${when}). This studio does not have the result. `
      + `Press Optimise to compute the result again.`,
    title,
    tone: "caution",
  };
}

function words({ view, pending, gesture }) {
  if (!view) return QUIET;
  const isEdited = pending.length > 0 || Boolean(gesture);
  if (view.document.recorded) return isEdited ? QUIET : ofFile(view.document.recorded);
  return view.provenance ? ofResult(view.provenance, view.plan?.source, isEdited) : QUIET;
}

/** Builds the line and keeps it current. */
function originLine(store) {
  const element = h("p", { class: "why", role: "note", "aria-label": "Origin of the motion" });
  store.watch(
    ({ view, pending, gesture }) => [view, pending.length, gesture],
    (state) => {
      const { text, title, tone } = words(state);
      setText(element, text);
      setAttribute(element, "title", title);
      setAttribute(element, "data-tone-text", tone);
    },
  );
  return element;
}
