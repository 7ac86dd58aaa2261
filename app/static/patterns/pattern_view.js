/** The pattern search: its controls at the right, and in the lower part the gaits and the pattern. */

import { byId, h, setAttribute, setInert, setText, svg } from "../lib/dom.js";
import { counted } from "../lib/format.js";
import { toast } from "../lib/toasts.js";
import { shownDocument } from "../state/store.js";
import { patternActions } from "./pattern_actions.js";
import { patternFields } from "./pattern_fields.js";
import { patternGaitStrip } from "./pattern_gait_strip.js";
import { mountPatternGaits, timelineOf, transitionGaits } from "./pattern_gaits.js";
import { patternGrid } from "./pattern_grid.js";
import { patternGridModel } from "./pattern_grid_model.js";
import { createProblem, drawnCells, LIMB_GIVEN, limbsOf, withCells } from "./pattern_problem.js";
import { patternResult } from "./pattern_result.js";
import { patternRules } from "./pattern_rules.js";
import { mountSearch, shownRows } from "./pattern_search.js";

const TITLES = { transition: "Transition", limbs: "One cycle", drawing: "Completed" };

/** The style sheet comes with the panel. */
function withStyles() {
  const address = new URL("./patterns.css", import.meta.url).pathname;
  return new Promise((resolve) => {
    document.head.append(
      h("link", { rel: "stylesheet", href: address, on: { load: resolve, error: resolve } }),
    );
  });
}

/** Lines from the cursors to the transition's ends. */
function bridge(name) {
  const path = svg("path", { d: "" });
  const element = h(
    "div",
    { class: "pattern-bridge", "aria-hidden": "true", data: { name } },
    svg("svg", { viewBox: "0 0 100 10", preserveAspectRatio: "none" }, path),
  );
  return {
    element,
    show: (cursor, end) =>
      path.setAttribute(
        "d",
        name === "from"
          ? `M${cursor * 100} 0 C${cursor * 100} 6 ${end} 4 ${end} 10`
          : `M${end} 0 C${end} 6 ${cursor * 100} 4 ${cursor * 100} 10`,
      ),
  };
}

const hatch = () =>
  svg(
    "svg",
    { class: "sprite", "aria-hidden": "true" },
    svg(
      "defs",
      {},
      svg(
        "pattern",
        {
          id: "pattern-hatch",
          width: 0.4,
          height: 0.4,
          patternUnits: "userSpaceOnUse",
          patternTransform: "rotate(45)",
        },
        svg("line", { x1: 0, y1: 0, x2: 0, y2: 0.4, "stroke-width": 0.22, class: "pattern-hatch-line" }),
      ),
    ),
  );

function gaitParts(store, problem) {
  const part = (side, name) =>
    patternGaitStrip({
      side,
      name,
      help: `The transition ${side === "from" ? "starts in" : "ends in"} this gait`,
      choose: (gait) => problem.set({ [side]: { gait, sample: null } }),
      move: (sample) => problem.set({ [side]: { ...problem.state[side], sample } }),
    });
  const parts = { from: part("from", "Gait A"), to: part("to", "Gait B") };
  return {
    ...parts,
    show() {
      const gaits = transitionGaits(store.state);
      for (const side of ["from", "to"])
        parts[side].show({
          gaits,
          ...problem.state[side],
          document: timelineOf(store, problem, problem.state[side].gait),
        });
    },
  };
}

/** What a click on a limb's name does: it locks the limb of a transition, and holds up that of a cycle. */
function limbLocking(store, problem, shown) {
  const hold = (foot) => {
    const { robot, timeline } = shownDocument(store.state);
    const limbs = [...limbsOf(problem.state, { robot, legs: timeline.feet.length })];
    limbs[foot] = limbs[foot] === "walks" ? "held" : "walks";
    problem.set({ limbs: { ...problem.state.limbs, [robot]: limbs } });
  };
  const lock = (foot) => {
    const now = shown();
    const { locked } = problem.state;
    const refusal = now?.given(foot) ? LIMB_GIVEN : now?.lockRefusal(foot);
    if (locked.includes(foot)) problem.set({ locked: locked.filter((one) => one !== foot) });
    else if (refusal) toast(refusal);
    else problem.set({ locked: [...locked, foot] });
  };
  return (foot) => ({ transition: lock, limbs: hold })[problem.state.mode]?.(foot);
}

/** Gives each lane its share of one time axis, 0 to 1: the longest lane is as wide as there is room. */
function shareAxis(lanes, seconds) {
  const longest = Math.max(...Object.values(seconds));
  const shares = Object.fromEntries(
    Object.entries(seconds).map(([name, value]) => [name, longest > 0 ? value / longest : 1]),
  );
  for (const [name, share] of Object.entries(shares)) lanes[name].style.setProperty("--share", share);
  return shares;
}

function lowerPart(store, problem, lock) {
  const [parts, grid] = [gaitParts(store, problem), patternGrid(problem, { lockLimb: lock })];
  const [title, note] = [h("b"), h("span", { class: "quiet pattern-state" })];
  const clear = h("button", {
    class: "link",
    text: "Free drawn cells",
    title: "Frees all cells that you drew here, so that the search chooses their values again",
    on: { click: () => problem.set({ ...withCells(problem.state, {}), freed: {} }) },
  });
  const [above, below] = [bridge("from"), bridge("to")];
  const empty = h("p", { class: "teach", hidden: true });
  const sought = h(
    "div",
    { class: "pattern-lane pattern-sought" },
    h("div", { class: "pattern-head" }, title, note, clear),
    grid.element,
    empty,
  );
  const element = h(
    "div",
    { class: "pattern-view", role: "group", "aria-label": "Pattern search" },
    hatch(),
    parts.from.element,
    above.element,
    sought,
    below.element,
    parts.to.element,
  );
  const lanes = { from: parts.from.element, sought, to: parts.to.element };
  return {
    element,
    cancel: grid.cancel,
    lanes,
    show(shown) {
      const isTransition = problem.state.mode === "transition";
      for (const one of [parts.from, above, below, parts.to]) one.element.hidden = !isTransition;
      setText(title, TITLES[problem.state.mode]);
      clear.hidden = !Object.keys({ ...drawnCells(problem.state), ...problem.state.freed }).length;
      element.toggleAttribute("data-alone", !isTransition);
      if (isTransition) parts.show();
      empty.hidden = Boolean(shown);
      setText(empty, shown ? "" : "Loading the two gaits…");
      grid.element.hidden = !shown;
      if (!shown) return;
      grid.show(shown);
      element.dataset.feet = shown.legs;
      setText(note, `${shown.samples} samples · ${drawnText(problem.state)}`);
      const seconds = {
        from: parts.from.seconds(),
        sought: shown.samples * parts.from.sampleTime(),
        to: parts.to.seconds(),
      };
      const share = shareAxis(lanes, isTransition ? seconds : { from: 1, sought: 1, to: 1 });
      above.show(parts.from.cursorAt() * share.from, (50 / shown.samples) * share.sought);
      below.show(parts.to.cursorAt() * share.to, (100 - 50 / shown.samples) * share.sought);
    },
  };
}

function drawnText(state) {
  const count = Object.keys(drawnCells(state)).length;
  return count ? `${counted(count, "cell")} drawn` : "click a cell to draw swing or stance";
}

function panelOf(parts, actions) {
  return h(
    "div",
    { class: "pattern-panel", role: "tabpanel", id: "patterns", "aria-labelledby": "view-patterns" },
    h(
      "header",
      { class: "inspector-head" },
      h("h2", { text: "Pattern search" }),
      h("p", {
        class: "quiet",
        text: "The search finds which feet stand at each sample. To close this panel, open the tab Cells.",
      }),
    ),
    h("div", { class: "pattern-scroll" }, ...parts),
    actions,
  );
}

/** The panel and the lower part on the page; `setOpen` shows them or hides them. */
function place(panel, lower) {
  const inspector = byId("inspector");
  const covered = [".inspector-head", ".sections", ".inspector-foot"].map((part) =>
    inspector.querySelector(`:scope > ${part}`),
  );
  const setOpen = (on) => {
    document.body.toggleAttribute("data-patterns", on);
    setAttribute(panel, "hidden", !on);
    setAttribute(lower, "hidden", !on);
    // The panel lies over the step.
    for (const part of covered) setInert(part, "patterns", on);
  };
  // Another view may have been opened while the style sheet was loading.
  setOpen(false);
  byId("chart").after(lower);
  inspector.append(panel);
  byId("view-patterns").setAttribute("aria-controls", "patterns");
  return setOpen;
}

/** The problem's change when a mode is chosen: a transition starts in the shown gait. */
function changeTo(mode, { selected: gait }, { from }) {
  if (mode !== "transition" || !gait) return { mode };
  return { mode, from: { gait, sample: from.gait === gait ? from.sample : null } };
}

/**
 * Builds the panel when it is first opened.
 * @param {import("../state/store.js").Store} store
 * @param {import("./pattern_actions.js").Page} page
 * @returns {Promise<{open: (mode: string|null) => void, close: () => void, cancel: () => boolean}>}
 */
export async function mountPatterns(store, page) {
  const problem = createProblem();
  let open = false;
  const isOpen = () => open;
  const gaits = mountPatternGaits(store, problem, isOpen);
  const search = mountSearch(store, problem, isOpen);
  const shown = () => patternGridModel(store, problem);
  const lock = limbLocking(store, problem, shown);
  const lower = lowerPart(store, problem, lock);
  patternPlayhead(store, problem, page.playback, lower.lanes);
  const fields = patternFields(store, problem, lock);
  const actions = patternActions(store, problem, page);
  const result = patternResult(problem, search, (hovered) => problem.set({ hovered }));
  const panel = panelOf([fields.element, ...result, ...patternRules(problem)], actions.element);
  await withStyles();
  const showParts = place(panel, lower.element);
  const setOpen = (on) => {
    open = on;
    showParts(on);
  };

  const render = () => {
    if (!open) return;
    const now = shown();
    lower.show(now);
    fields.show(now);
    actions.show();
  };
  problem.watch((state) => Object.values(state), render);
  store.watch((state) => [state.view, state.pending, state.gaits, state.iterate], render);

  return {
    open(mode) {
      setOpen(true);
      if (mode) problem.set(changeTo(mode, store.state, problem.state));
      gaits.choose();
      search.submit();
      render();
    },
    close() {
      actions.leave();
      setOpen(false);
    },
    cancel: () => lower.cancel(),
  };
}

/** Whether a limb is in the air at an end for one sample alone: the motion then has that sample twice. */
const isCut = (rows, end, beside) => rows.some((row) => row.at(end) === "0" && row.at(beside) === "1");

/**
 * The stretches of a transition's motion: a lane each, its samples, and which of them comes first.
 * @param {Record<string, any>} problem
 * @param {Record<string, any>[]} gaits
 * @param {string[]} rows
 */
function stretchesOf({ from, to }, [first, second], rows) {
  const [whole, after] = [first.timeline.feet[0].length, second.timeline.feet[0].length];
  const [start, end] = [Math.min(from.sample, whole - 1), Math.min(to.sample, after - 1)];
  return [
    { lane: "from", of: whole, at: 0, samples: start === 0 && isCut(rows, 0, 1) ? 1 : start },
    { lane: "sought", of: rows[0].length, at: 0, samples: rows[0].length },
    { lane: "to", of: after, at: Math.min(end + 1, after - 1), samples: Infinity },
  ];
}

/** The playhead's lane, and its place as a share of the width; null where the motion has other samples. */
function placeOf(store, problem, time) {
  const { iterate } = store.state;
  const rows = shownRows(problem.state);
  if (!iterate?.pattern || !rows || problem.state.mode === "limbs") return null;
  const { times } = iterate.plan;
  let sample = time / (times[1] - times[0]);
  if (problem.state.mode === "drawing") return { lane: "sought", share: (sample + 0.5) / rows[0].length };
  const gaits = [problem.state.from, problem.state.to].map(({ gait }) => timelineOf(store, problem, gait));
  if (gaits.includes(null)) return null;
  for (const { lane, of, at, samples } of stretchesOf(problem.state, gaits, rows)) {
    if (sample < samples) return { lane, share: Math.min(at + sample + 0.5, of) / of };
    sample -= samples;
  }
  return null;
}

/**
 * Shows the playhead in the lower part while a pattern walks.
 * @param {import("../state/store.js").Store} store
 * @param {Record<string, any>} problem
 * @param {import("../preview/playback.js").Playback} playback
 * @param {{from: HTMLElement, sought: HTMLElement, to: HTMLElement}} lanes
 */
function patternPlayhead(store, problem, playback, lanes) {
  const line = h("div", { class: "pattern-playhead", "aria-hidden": "true", hidden: true });
  const move = () => {
    const place = placeOf(store, problem, playback.time);
    line.hidden = !place;
    if (!place) return;
    if (line.parentNode !== lanes[place.lane]) lanes[place.lane].append(line);
    line.style.setProperty("--at", place.share.toFixed(5));
  };
  playback.addEventListener("time", move);
  store.watch(({ iterate }) => [iterate], move);
}
