/** Which limbs walk: for a gait of some limbs each limb's part, for a transition the limbs that are locked. */

import { h, setAllowed, setAttribute, setText } from "../lib/dom.js";
import { limbsOf, ROLES } from "./pattern_problem.js";

const HELP = { walks: "takes steps", held: "held up, for another task", broken: "does not move any more; it is held up", stands: "stays on the ground" };

const sameLength = (own, count, build) => {
  if (own.length === count) return own;
  own.splice(0, own.length, ...Array.from({ length: count }, (_, foot) => build(foot)));
  return own;
};

/** A choice a limb; `aboutOf` returns the open gait's robot and the names of its feet. */
export function limbChoices(problem, aboutOf) {
  const element = h("ul", { class: "pattern-limbs", "aria-label": "What each limb does" });
  const choices = [];

  function choice(foot) {
    const select = h("select", { "aria-label": `Limb ${foot + 1}` }, ...Object.entries(ROLES).map(([value, text]) => h("option", { value, text, title: HELP[value] })));
    const role = h("span", { class: "quiet" });
    select.addEventListener("change", () => {
      const about = aboutOf();
      const limbs = [...limbsOf(problem.state, about)];
      limbs[foot] = select.value;
      problem.set({ limbs: { ...problem.state.limbs, [about.robot]: limbs } });
    });
    return { select, role, element: h("li", { data: { foot: foot + 1 } }, h("span", { class: "pattern-limb" }, h("i", { class: "foot-dot" }), String(foot + 1), role), select) };
  }

  return {
    element,
    show() {
      const about = aboutOf();
      if (!about) return;
      const limbs = limbsOf(problem.state, about);
      if (choices.length !== limbs.length) element.replaceChildren(...sameLength(choices, limbs.length, choice).map((one) => one.element));
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
export function limbLocks(problem, { refusal, lock }) {
  const element = h("div", { class: "pattern-locks", role: "group", "aria-label": "Locked limbs" });
  const buttons = [];
  const build = (foot) => {
    const button = h("button", { class: "pattern-lock", "aria-label": `Lock limb ${foot + 1}`, text: String(foot + 1), data: { foot: foot + 1 } });
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
        setAllowed(button, isGiven ? "Both gaits leave this limb as it is, and so does the transition." : refusal(foot), "Keeps the value that it has at both ends; it then counts as no walking limb");
      });
    },
  };
}
