/** The optimiser's answer for the shown gait: the state of its plan, what is missing, and remedies. */

import { byId, h, setAttribute, setText } from "../lib/dom.js";
import { fixed } from "../lib/format.js";
import { keepPlace } from "../lib/keep_place.js";
import { jobOf } from "../shell/job_list.js";
import { fallOf, isRefusedDrawing } from "../state/live_plan.js";
import { isError } from "../state/simulation.js";
import { ownPlan } from "../state/store.js";
import { remedyList } from "./remedy_list.js";
import { tryouts } from "./tryout.js";

const FAMILIES = {
  body_torque: "Balance",
  margin: "Margin",
  workspace: "Reach",
  foot_speed: "Speed",
  body_speed: "Body speed",
  clearance: "Clearance",
  body_height: "Body height",
  boundary: "Start and goal",
  motor_speed: "Motor speed",
  motor_acceleration: "Acceleration",
  friction: "Friction",
  shoe_distance: "Shoes",
};
const SHOWN_MISSING = 3;
/** Scrolled so far, the answer is out of sight. */
const SCROLLED_PX = 40;
const FOR_EVERY_MOTION = /^This is proven/;

/** The feet of an entry, counted from 1. */
const feetOf = ({ feet }) =>
  feet.length === 0
    ? ""
    : feet.length === 1
      ? `foot ${feet[0] + 1}`
      : `edge ${feet.map((foot) => foot + 1).join("–")}`;

function missingMotionItem(missing, plan, goTo) {
  const from = plan.times[missing.first];
  const place = [FAMILIES[missing.family] ?? missing.family, feetOf(missing)].filter(Boolean).join(", ");
  return h(
    "li",
    { title: missing.sentence },
    h(
      "button",
      { class: "link", "aria-label": `Go to ${place}, ${fixed(from)} s`, on: { click: () => goTo(missing) } },
      `${place}, ${fixed(from)} s`,
    ),
    h("b", { class: "number", text: `${fixed(missing.amount, missing.amount < 1 ? 2 : 1)} ${missing.unit}` }),
  );
}

/** The worst entries, and the others under a fold. */
function missingMotionList(lacks, plan, goTo) {
  const items = lacks.map((missing) => missingMotionItem(missing, plan, goTo));
  const list = h(
    "ul",
    { class: "lacks", role: "list", "aria-label": "What is missing" },
    ...items.slice(0, SHOWN_MISSING),
  );
  const rest = items.slice(SHOWN_MISSING);
  if (!rest.length) return [list];
  return [
    list,
    h(
      "details",
      { class: "lacks-more" },
      h("summary", { text: `${rest.length} more` }),
      h("ul", { class: "lacks", role: "list" }, ...rest),
    ),
  ];
}

/** The card's parts for a drawing that the live tier proves, or finds, to have no motion. */
function infeasibleParts(plan, goTo) {
  const { evidence, explanation, lacks } = plan.live;
  // The last sentence names the scope of the answer: every motion, or the live tier's model.
  const [first = "", ...rest] = explanation;
  const closing = rest.at(-1) ?? first;
  const text =
    evidence === "proven" && !FOR_EVERY_MOTION.test(closing)
      ? "proven for evenly spaced footholds"
      : (evidence ?? "");
  const sentence = h(
    "p",
    { class: "first", title: explanation.join(" ") },
    first,
    text && h("span", { class: "quiet", text: ` (${text})`, title: closing }),
  );
  return [sentence, ...(lacks.length ? missingMotionList(lacks, plan, goTo) : [])];
}

/** What the card says of a state: its title, what it is about, and its parts; null where nothing is wrong. */
function verdictOf(state, goTo) {
  const plan = ownPlan(state);
  const why = plan?.poses?.explanation ?? [];
  if (why.length)
    return {
      title: "No motion for this gait",
      about: why,
      build: () => why.map((text) => h("p", { text })),
      mendable: false,
    };
  const title = "No motion for this drawing";
  const { status, evidence, explanation, lacks } = plan?.live ?? {};
  if (status === "infeasible")
    return {
      title,
      about: [evidence, explanation, lacks, plan.times],
      build: () => infeasibleParts(plan, goTo),
      mendable: true,
    };
  const first = (text) => () => [h("p", { class: "first", text })];
  if (isRefusedDrawing(state))
    return { title, about: plan.refusal.sentence, build: first(plan.refusal.sentence), mendable: true };
  if (plan?.misfit)
    return {
      title: plan.refusal ? "The recording does not fit the robot" : "Heights in another frame?",
      about: plan.misfit,
      build: first(plan.misfit),
      mendable: true,
    };
  const fall = fallOf(state);
  const fallTitle = fall && isError(fall) ? "The robot would tip over" : "The robot would rock";
  return fall
    ? { title: fallTitle, about: fall.sentence, build: first(fall.sentence), mendable: true }
    : null;
}

/** Whether a person works below the card: in a field with the focus, or on a number that is dragged. */
function worksBelow({ gesture }, card) {
  const panel = byId("sections");
  const { activeElement } = document;
  const hasFocus = panel.contains(activeElement) && !card.contains(activeElement);
  return (hasFocus || (gesture && panel.matches(":hover"))) && !card.matches(":hover");
}

/** The card: what is wrong, where, and what would help. It stands first, and its title stays in sight. */
export function liveAnswer(store, edits, goTo) {
  const tryout = tryouts(store);
  const use = (document, label) => {
    tryout.end();
    // Its button goes. The step's title is no control: Space plays there, and the next Tab leads on from it.
    if (element.contains(window.document.activeElement)) byId("step-title").focus({ preventScroll: true });
    edits.edit(({ name, notes }) => ({ ...document, name, notes }), label);
  };
  const remedies = remedyList({ use, show: tryout.show, end: tryout.end });
  const [title, up] = [
    h("span", {}),
    h("button", {
      class: "link",
      text: "↑",
      "aria-label": "What would help",
      title: "Scroll up to “What would help”",
      hidden: true,
    }),
  ];
  const panel = byId("sections");
  const top = () => {
    up.hidden = panel.scrollTop < SCROLLED_PX;
  };
  up.addEventListener("click", () => {
    panel.scrollTop = 0;
  });
  panel.addEventListener("scroll", top, { passive: true });
  const why = h("div", { class: "advice-why" });
  const body = h("div", { class: "advice" }, why, remedies.element);
  const element = h(
    "div",
    { class: "advice-card", role: "region", "aria-label": "Why the gait is infeasible", hidden: true },
    h("h3", { class: "advice-title" }, title, up),
    body,
  );
  let shown = null;
  keepPlace(
    [body],
    () => body.offsetHeight,
    () => worksBelow(store.state, body),
  );
  const show = (state) => {
    const verdict = verdictOf(state, goTo);
    element.hidden = body.hidden = !verdict;
    if (!verdict) return;
    setText(title, verdict.title);
    top();
    const about = JSON.stringify(verdict.about);
    if (about !== shown) why.replaceChildren(...verdict.build());
    shown = about;
    remedies.element.hidden = !verdict.mendable;
    if (verdict.mendable) remedies.show(state.remedies);
  };
  return { element, show };
}

const TITLES = {
  infeasible: "Optimise also found no motion",
  failed: "Optimise failed",
  interrupted: "Optimise was interrupted",
};

/** The box with the exact tier's refusal. */
export function jobAnswer() {
  const element = h("div", { class: "box-note", hidden: true });
  return {
    element,
    show(state) {
      const job = jobOf(state);
      const bad = Boolean(job?.fresh) && ["infeasible", "failed", "interrupted"].includes(job.state);
      element.hidden = !bad;
      if (!bad) return;
      const sentences = (job.result?.explanation ?? []).filter((sentence) => sentence !== job.sentence);
      setAttribute(element, "data-tone", job.state === "failed" ? "bad" : "caution");
      element.replaceChildren(
        h("h4", { text: TITLES[job.state] }),
        h("p", { text: job.sentence }),
        ...sentences.map((text) => h("p", { text })),
      );
    },
  };
}
