/** Shows the search: its progress, then the best patterns, or why there is none and what would help. */

import { h, onPress, setAllowed, setAttribute, setText, svg } from "../lib/dom.js";
import { counted, fixed, seconds } from "../lib/format.js";
import { picture } from "./pattern_gait_strip.js";
import { relaxed, ruleOf, RULES } from "./pattern_problem.js";
import { announce, toast } from "../lib/toasts.js";

const TEXTS = {
  optimal: ["Optimal", "good", "This pattern keeps all rules. No better pattern exists"],
  feasible: ["Feasible", "caution", "This pattern keeps the rules. A better pattern may exist"],
  infeasible: ["Infeasible", "caution", "No pattern keeps all rules"],
  cancelled: ["Cancelled", "quiet", "The search was cancelled before it found a pattern"],
};

/** "4 moments of change · 8 foot changes": a pattern's score in words. */
function scoreText({ sample_changes: changes, limb_changes: single, redrawn }, kept) {
  return [
    `${counted(changes, "moment")} of change`,
    `${single} foot changes`,
    kept && `${counted(redrawn, "cell")} redrawn`,
  ]
    .filter(Boolean)
    .join(" · ");
}

/** How far the best pattern may be from the best there is, as a percentage. */
const gapOf = ({ objective, bound }) =>
  objective > 0 ? fixed((100 * (objective - Math.max(bound, 0))) / objective, 0) : "0";

const bestText = (running) =>
  `best so far: ${scoreText(running.pattern, false)} · score ${fixed(running.objective, 0)}, `
  + `lower bound ${fixed(running.bound, 0)} · gap ${gapOf(running)} %`;

function progressBox(search) {
  const [text, bar] = [h("p"), h("i")];
  const useNow = h("button", { text: "Use this now" });
  onPress(useNow, search.useNow, (why) => toast(why));
  const cancel = h("button", {
    text: "Cancel",
    "aria-label": "Cancel the search",
    on: { click: search.cancel },
  });
  const element = h(
    "div",
    { class: "box-note pattern-progress", role: "status", "aria-label": "Search", hidden: true },
    text,
    h("div", { class: "progress" }, bar),
    h("div", { class: "buttons" }, useNow, cancel),
  );
  return {
    element,
    show(running) {
      element.hidden = !running;
      if (!running) return;
      const { objective, bound, seconds: past } = running;
      const known = objective !== null && objective !== undefined;
      setText(
        text,
        `Searching for ${seconds(past ?? 0)} s · ${known ? bestText(running) : "no pattern yet"}`,
      );
      const share = known && objective > 0 ? Math.min(Math.max(bound, 0) / objective, 1) : 0;
      bar.style.transform = `scaleX(${share})`;
      setAllowed(
        useNow,
        known ? null : "No pattern has been found yet.",
        "Ends the search and uses the best pattern found so far",
      );
    },
  };
}

/** Why the reasons may name longer swings than the rules: the feet need them. */
function longerSwings(state, explanation) {
  const needed = Math.max(
    ...explanation.map((text) => Number(/swings? .*?at least (\d+) samples/.exec(text)?.[1] ?? 0)),
  );
  const required = ruleOf(
    state,
    RULES.find(({ rule }) => rule === "least_swing"),
  ).value;
  return state.mode === "transition" && state.walkable && needed > required
    ? [
        h("p", {
          class: "quiet",
          text:
            `By your rule “Swing per limb, at least”, each walking limb must swing in ${required} samples. `
            + `“Swings that the feet can do” requires at least ${needed} samples, `
            + "because of the step lengths of these gaits.",
        }),
      ]
    : [];
}

function conflictBox(problem) {
  const element = h("div", { class: "box-note", role: "alert", data: { tone: "caution" }, hidden: true });
  let shown = null;
  const apply = (relaxation) => {
    problem.set(relaxed(problem.state, relaxation));
    announce(`${relaxation.words}.`);
  };
  return {
    element,
    show(result) {
      element.hidden = result?.status !== "infeasible";
      if (element.hidden || shown === result) return;
      shown = result;
      element.replaceChildren(
        h("h3", { text: "No pattern keeps all rules and fixed cells" }),
        ...result.explanation.map((text) => h("p", { text })),
        ...longerSwings(problem.state, result.explanation),
        h(
          "div",
          { class: "buttons", role: "group", "aria-label": "Changes that make a pattern possible" },
          ...result.relaxations.map((one) =>
            h("button", {
              text: one.words,
              title: "Makes this change and searches again",
              on: { click: () => apply(one) },
            }),
          ),
        ),
      );
    },
  };
}

/** A pattern as small as its line, which distinguishes patterns of the same cost. */
const thumbnail = (feet) =>
  svg(
    "svg",
    {
      class: "pattern-thumbnail",
      viewBox: `0 0 ${feet[0].length} ${feet.length}`,
      preserveAspectRatio: "none",
      "aria-hidden": "true",
    },
    ...picture({ timeline: { feet } }, null),
  );

function patternLine(pattern, index, kept, { choose, preview }) {
  return h(
    "li",
    {
      role: "option",
      id: `pattern-${index}`,
      on: { click: () => choose(index), pointerenter: () => preview(index) },
    },
    h("span", { class: "number", text: String(index + 1) }),
    thumbnail(pattern.feet),
    h("span", { text: scoreText(pattern, kept) }),
    h("span", {
      class: "number quiet",
      text: fixed(pattern.score, 0),
      title: "Score: the weighted sum of all changes. A smaller score is better",
    }),
  );
}

function press(event, { result, chosen }, choose) {
  const last = (result?.patterns.length ?? 1) - 1;
  const goals = {
    ArrowDown: Math.min(chosen + 1, last),
    ArrowUp: Math.max(chosen - 1, 0),
    Home: 0,
    End: last,
  };
  if (goals[event.key] === undefined) return;
  event.preventDefault();
  event.stopPropagation();
  choose(goals[event.key]);
}

/** The best patterns: pointing at one, or going through them by keys, shows it; a click chooses it. */
function alternatives(problem, preview) {
  const choose = (chosen) => {
    preview(null);
    problem.set({ chosen });
  };
  const list = h("ul", {
    class: "pattern-choices",
    role: "listbox",
    tabindex: "0",
    "aria-label": "Best patterns",
    data: { arrows: "" },
    on: { keydown: (event) => press(event, problem.state, choose), pointerleave: () => preview(null) },
  });
  const title = h("h3", {}, "Best patterns", h("span", { text: "click a pattern to choose it" }));
  const element = h("div", { hidden: true }, title, list);
  let shown = null;
  return {
    element,
    show({ result, chosen, keep, mode }) {
      element.hidden = !result?.patterns.length;
      if (element.hidden) return;
      const kept = keep || mode === "drawing";
      if (shown !== result)
        list.replaceChildren(
          ...result.patterns.map((pattern, index) => patternLine(pattern, index, kept, { choose, preview })),
        );
      shown = result;
      [...list.children].forEach((one, index) =>
        setAttribute(one, "aria-selected", String(index === chosen)),
      );
      setAttribute(list, "aria-activedescendant", `pattern-${chosen}`);
    },
  };
}

/**
 * Builds the result's part of the panel.
 * @param {Record<string, any>} problem
 * @param {{useNow: Function, cancel: Function}} search
 * @param {(index: number|null) => void} preview shows one of the best patterns, or the chosen one again
 */
export function patternResult(problem, search, preview) {
  const [dot, word, sentence, time] = [
    h("span", { class: "dot" }),
    h("b"),
    h("span", { class: "quiet" }),
    h("span", { class: "number quiet" }),
  ];
  const line = h(
    "div",
    { class: "pattern-line", role: "status", "aria-label": "Pattern found" },
    dot,
    word,
    sentence,
    time,
  );
  const error = h("p", { class: "box-note", role: "alert", data: { tone: "bad" }, hidden: true });
  const [progress, conflict, best] = [
    progressBox(search),
    conflictBox(problem),
    alternatives(problem, preview),
  ];
  problem.watch(
    ({ result, running, error: refusal, chosen, waiting, keep, mode }) => [
      result,
      running,
      refusal,
      chosen,
      waiting,
      keep,
      mode,
    ],
    (state) => {
      const { result, running } = state;
      const [text, tone, meaning] = running
        ? ["Searching", "accent", ""]
        : result
          ? TEXTS[result.status]
          : [state.waiting ? "Searching" : "No pattern", "quiet", ""];
      const pattern = result?.patterns[state.chosen];
      dot.dataset.tone = tone;
      setText(word, text);
      setText(sentence, running || !result ? "" : pattern ? counted(pattern.sample_changes, "change") : "");
      line.title = meaning;
      setText(time, running || !result ? "" : `${seconds(result.seconds)} s`);
      error.hidden = !state.error;
      setText(error, state.error?.sentence ?? "");
      progress.show(running);
      conflict.show(running ? null : result);
      best.show(state);
    },
  );
  return [line, error, progress.element, conflict.element, best.element];
}
