/** The fields of the pattern problem: its kind, its length, its limbs, and whether to keep a drawing. */

import { h, setAllowed, setAttribute, setText } from "../lib/dom.js";
import { shownDocument } from "../state/store.js";
import { LIMB_GIVEN, limbsOf, ROLES } from "./pattern_problem.js";

const MODES = {
  transition: ["Transition", "Searches for a transition from one gait to another gait"],
  limbs: ["Some limbs", "Searches for a gait in which only some limbs walk"],
  drawing: ["Complete", "Keeps the locked cells of the open gait and searches for the other cells"],
};
const TEACH = {
  transition:
    "Choose gait A and gait B below. "
    + "Move the cursor in each gait to the sample where the transition starts or ends. "
    + "Click cells to draw swing or stance. The search finds the other cells.",
  limbs: "Choose the limbs that do not walk. The search finds a repeating pattern for the other limbs.",
  drawing:
    "The search keeps the locked cells of the open gait, its first sample and its last sample. "
    + "The search finds the other cells.",
};
const [LEAST, MOST] = [2, 240];

function modes(problem) {
  const buttons = Object.entries(MODES).map(([mode, [text, title]]) =>
    h("button", {
      text,
      title,
      "aria-pressed": "false",
      data: { mode },
      on: { click: () => problem.set({ mode }) },
    }),
  );
  return {
    element: h(
      "div",
      { class: "segmented pattern-modes", role: "group", "aria-label": "Kind of pattern" },
      ...buttons,
    ),
    show: ({ mode }) =>
      buttons.forEach((button) => setAttribute(button, "aria-pressed", String(button.dataset.mode === mode))),
  };
}

function lengthField(name, help, take) {
  const input = h("input", {
    type: "number",
    min: LEAST,
    max: MOST,
    step: 1,
    "aria-label": name,
    title: `${help}. ${LEAST} to ${MOST}`,
  });
  input.addEventListener("input", () => {
    if (input.validity.valid && input.value) take(input.valueAsNumber);
  });
  input.addEventListener("blur", () => {
    input.value = input.dataset.shown;
  });
  const element = h(
    "label",
    { class: "field" },
    h("span", { class: "name", text: name }),
    h("span", { class: "box", data: { unit: "samples" } }, input),
  );
  return {
    element,
    input,
    show(value) {
      input.dataset.shown = String(value);
      if (document.activeElement !== input) input.value = value;
    },
  };
}

/** The boxes, each named as the part of the problem that it sets. */
const CHECKS = {
  shortest: [
    "Shortest that works",
    "The search chooses the length. The transition gets as few samples as the rules allow",
  ],
  walkable: [
    "Swings that the feet can do",
    "Makes every swing long enough for the steps of both gaits, "
      + "also swings at the start and end of the transition. The footfall thesis has no such rule",
  ],
  painted: ["Keep the painted swings", "The search keeps all swings and all locked cells of the open gait"],
  keep: ["Keep my drawing if possible", "The search prefers patterns that are similar to the shown pattern"],
};

function check(name, take) {
  const [text, title] = CHECKS[name];
  const box = h("input", { type: "checkbox", on: { change: () => take({ [name]: box.checked }) } });
  return {
    element: h("label", { class: "pattern-check", title }, box, h("span", { text })),
    show: (state) => {
      box.checked = state[name];
    },
  };
}

/** The open gait's robot and the names of its feet, or null without a gait. */
function openGait({ state }) {
  const document = state.view && shownDocument(state);
  return document
    ? { robot: document.robot, legs: document.timeline.feet.length, roles: state.view.roles ?? [] }
    : null;
}

/**
 * Builds the fields.
 * @param {import("../state/store.js").Store} store
 * @param {Record<string, any>} problem
 * @param {(foot: number) => void} lock locks a limb of the transition, or unlocks it
 */
export function patternFields(store, problem, lock) {
  let shown = null;
  const choice = modes(problem);
  const teach = h("p", { class: "teach" });
  const samples = lengthField(
    "Length",
    "Number of samples of the transition, including its first and last sample",
    (value) => problem.set({ samples: value }),
  );
  const cycle = lengthField("Length of a cycle", "The pattern repeats after this many samples", (value) =>
    problem.set({ cycle: value }),
  );
  const shortest = check("shortest", (change) =>
    problem.set({ ...change, ...(change.shortest || !shown ? {} : { samples: shown.samples }) }),
  );
  const [walkable, painted, keep] = ["walkable", "painted", "keep"].map((name) => check(name, problem.set));
  const limbs = limbChoices(problem, () => openGait(store));
  const locks = limbLocks(problem, { lock, refusal: (foot) => shown?.lockRefusal?.(foot) ?? null });
  const locking = h(
    "div",
    { class: "pattern-locking" },
    h("span", { class: "quiet", text: "Locked limbs" }),
    locks.element,
  );
  /** @type {[HTMLElement, string][]} */
  const parts = [
    [samples.element, "transition"],
    [shortest.element, "transition"],
    [walkable.element, "transition"],
    [locking, "transition"],
    [cycle.element, "limbs"],
    [limbs.element, "limbs"],
    [painted.element, "drawing"],
  ];
  return {
    element: h(
      "div",
      { class: "pattern-fields" },
      choice.element,
      teach,
      ...parts.map(([part]) => part),
      keep.element,
    ),
    show(now) {
      shown = now;
      const { state } = problem;
      choice.show(state);
      setText(teach, TEACH[state.mode]);
      for (const [part, mode] of parts) part.hidden = mode !== state.mode;
      keep.element.hidden = state.mode === "drawing";
      samples.show(now?.samples && state.shortest ? now.samples : state.samples);
      samples.input.disabled = state.shortest;
      cycle.show(state.cycle);
      for (const one of [shortest, walkable, painted, keep]) one.show(state);
      if (state.mode === "limbs") limbs.show();
      if (state.mode === "transition" && now) locks.show({ legs: now.legs, given: now.given });
    },
  };
}

const HELP = {
  walks: "takes steps",
  held: "stays in the air, free for another task",
  broken: "cannot move, and stays in the air",
  stands: "stays on the ground",
};

const sameLength = (own, count, build) => {
  if (own.length === count) return own;
  own.splice(0, own.length, ...Array.from({ length: count }, (_, foot) => build(foot)));
  return own;
};

/** A choice a limb; `aboutOf` returns the open gait's robot and the names of its feet. */
function limbChoices(problem, aboutOf) {
  const element = h("ul", { class: "pattern-limbs", "aria-label": "What each limb does" });
  const choices = [];

  function choice(foot) {
    const select = h(
      "select",
      { "aria-label": `Limb ${foot + 1}` },
      ...Object.entries(ROLES).map(([value, text]) => h("option", { value, text, title: HELP[value] })),
    );
    const role = h("span", { class: "quiet" });
    select.addEventListener("change", () => {
      const about = aboutOf();
      const limbs = [...limbsOf(problem.state, about)];
      limbs[foot] = select.value;
      problem.set({ limbs: { ...problem.state.limbs, [about.robot]: limbs } });
    });
    return {
      select,
      role,
      element: h(
        "li",
        { data: { foot: foot + 1 } },
        h("span", { class: "pattern-limb" }, h("i", { class: "foot-dot" }), String(foot + 1), role),
        select,
      ),
    };
  }

  return {
    element,
    show() {
      const about = aboutOf();
      if (!about) return;
      const limbs = limbsOf(problem.state, about);
      if (choices.length !== limbs.length)
        element.replaceChildren(...sameLength(choices, limbs.length, choice).map((one) => one.element));
      choices.forEach(({ select, role, element: line }, foot) => {
        select.value = limbs[foot];
        select.title = `Limb ${foot + 1}: ${HELP[limbs[foot]]}`;
        setText(role, about.roles[foot] ?? "");
        line.toggleAttribute("data-own", limbs[foot] !== "walks");
      });
    },
  };
}

/** Buttons that lock a limb of a transition to the value that it has at both ends. */
function limbLocks(problem, { refusal, lock }) {
  const element = h("div", { class: "pattern-locks", role: "group", "aria-label": "Locked limbs" });
  const buttons = [];
  const build = (foot) => {
    const button = h("button", {
      class: "pattern-lock",
      "aria-label": `Lock limb ${foot + 1}`,
      text: String(foot + 1),
      data: { foot: foot + 1 },
    });
    button.addEventListener("click", () => lock(foot));
    return button;
  };
  return {
    element,
    show({ legs, given }) {
      if (buttons.length !== legs) element.replaceChildren(...sameLength(buttons, legs, build));
      buttons.forEach((button, foot) => {
        const isGiven = given(foot);
        setAttribute(button, "aria-pressed", String(isGiven || problem.state.locked.includes(foot)));
        setAllowed(
          button,
          isGiven ? LIMB_GIVEN : refusal(foot),
          "Locks this limb. "
            + "A locked limb stays in swing or in stance during the whole transition. "
            + "It does not count as a walking limb",
        );
      });
    },
  };
}
