/** The optimiser's answer for the shown gait: the state of its plan, what is missing, and remedies. */

import { byId, h, setAttribute } from "../lib/dom.js";
import { fixed, mm } from "../lib/format.js";
import { jobOf } from "../shell/job_list.js";
import { hasNoMotion, ownPlan } from "../state/store.js";
import { tryouts } from "./tryout.js";

const FAMILIES = {
  body_torque: "Balance", margin: "Margin", workspace: "Reach", foot_speed: "Speed", body_speed: "Body speed", clearance: "Clearance",
  body_height: "Body height", boundary: "Start and goal", motor_speed: "Motor speed", motor_acceleration: "Acceleration", friction: "Friction",
  shoe_distance: "Shoes",
};
const SHOWN_MISSING = 3;
const FOR_EVERY_MOTION = /^This is proven/;

/** The feet of an entry, counted from 1. */
const feetOf = ({ feet }) => (feet.length === 0 ? "" : feet.length === 1 ? `foot ${feet[0] + 1}` : `edge ${feet.map((foot) => foot + 1).join("–")}`);

function missingMotionItem(missing, plan, goTo) {
  const from = plan.times[missing.first];
  const place = [FAMILIES[missing.family] ?? missing.family, feetOf(missing)].filter(Boolean).join(", ");
  return h("li", { title: missing.sentence },
    h("button", { class: "link", "aria-label": `Go to ${place}, ${fixed(from)} s`, on: { click: () => goTo(missing) } },
      `${place}, ${fixed(from)} s`),
    h("b", { class: "number", text: `${fixed(missing.amount, missing.amount < 1 ? 2 : 1)} ${missing.unit}` }));
}

/** The worst entries, and the others under a fold. */
function missingMotionList(lacks, plan, goTo) {
  const items = lacks.map((missing) => missingMotionItem(missing, plan, goTo));
  const list = h("ul", { class: "lacks", role: "list", "aria-label": "What is missing" }, ...items.slice(0, SHOWN_MISSING));
  const rest = items.slice(SHOWN_MISSING);
  if (!rest.length) return [list];
  return [list, h("details", { class: "lacks-more" }, h("summary", { text: `${rest.length} more` }), h("ul", { class: "lacks", role: "list" }, ...rest))];
}

/** One way out: its name, what it gives, and its price; pointing at it or focusing it shows where it leads. */
function wayOut({ label, sentence, caution, document, balance, robot_seconds: robotSeconds }, edits, tryout) {
  const take = () => {
    tryout.end();
    edits.edit(({ name, notes }) => ({ ...document, name, notes }), label);
  };
  const margin = balance === null ? "" : `margin ${mm(balance)} mm`;
  const price = robotSeconds === null ? "" : ` ${fixed(robotSeconds)} s on the robot.`;
  return h("li", { class: "remedy", on: { pointerenter: () => tryout.show(document), pointerleave: tryout.end } },
    h("button", { text: label, title: "Takes it; Undo brings your drawing back.", on: { click: take, focus: () => tryout.show(document), blur: tryout.end, keydown: ({ key }) => { if (key === "Escape") tryout.end(); } } }),
    h("span", { class: "number", data: caution ? { toneText: "caution" } : {}, text: caution || margin }),
    h("p", { class: "quiet", text: `${sentence}${price}` }));
}

function remedyParts(edits, remedies, tryout) {
  if (!remedies) return [h("p", { class: "why", text: "Looking for ways out…" })];
  const ways = remedies.list.map((remedy) => wayOut(remedy, edits, tryout));
  const none = remedies.sentence ?? "No change was found that makes it walk.";
  const note = !remedies.complete ? "The search was cut short; it goes on when nothing else is asked." : ways.length ? null : none;
  return [
    ways.length > 0 && h("ul", { class: "remedies", role: "group", "aria-label": "Ways out" }, ...ways),
    note && h("p", { class: "why", text: note }),
  ].filter(Boolean);
}

/** A drawing that is refused before any search; its reason stands at the timeline. */
function refusedParts(state, edits, tryout) {
  return { head: [h("p", { class: "first", text: "This drawing has no motion." }), ...remedyParts(edits, state.remedies, tryout)], details: [] };
}

function liveParts(state, plan, edits, goTo, tryout) {
  const { evidence, explanation, lacks } = plan.live;
  // The last sentence names the scope of the answer: every motion, or the live tier's model.
  const [first = "", ...rest] = explanation;
  const closing = rest.at(-1) ?? first;
  const text = evidence === "proven" && !FOR_EVERY_MOTION.test(closing) ? "proven for even footholds" : evidence ?? "";
  const head = [
    h("p", { class: "first", title: explanation.join(" ") }, first, text && h("span", { class: "quiet", text: ` (${text})`, title: closing })),
    ...remedyParts(edits, state.remedies, tryout),
  ];
  return { head, details: lacks.length ? missingMotionList(lacks, plan, goTo) : [] };
}

/**
 * Keeps the reason and the ways out in sight at the lower edge of the panel, where the fields leave them no room above it.
 * The details may lie below the edge; a focused field is scrolled above the answer.
 */
function keepVisible(element, details) {
  const panel = byId("sections");
  const measure = () => {
    const hang = element.hidden ? 0 : element.getBoundingClientRect().bottom - details.getBoundingClientRect().top;
    element.style.setProperty("--hang", `${hang}px`);
    panel.style.scrollPaddingBottom = element.hidden ? "" : `${element.offsetHeight - hang + 8}px`;
  };
  const resized = new ResizeObserver(measure);
  [element, details].forEach((one) => resized.observe(one));
}

/** The box that explains why there is no motion, with remedies. */
export function liveAnswer(store, edits, goTo) {
  const tryout = tryouts(store);
  const [head, details] = [h("div", {}), h("div", { class: "why-details" })];
  const element = h("div", { class: "box-note why-not", role: "region", "aria-label": "Why it is infeasible", data: { tone: "bad" }, hidden: true }, head, details);
  keepVisible(element, details);
  return {
    element,
    show(state) {
      const plan = ownPlan(state);
      const why = plan?.poses?.explanation ?? [];
      const infeasible = plan?.live?.status === "infeasible";
      const mendable = hasNoMotion(plan) && Boolean(state.remedies?.list.length);
      element.hidden = !infeasible && !mendable && !why.length;
      if (element.hidden) return;
      if (why.length) {
        head.replaceChildren(...why.map((text) => h("p", { text })));
        details.replaceChildren();
        return;
      }
      const parts = infeasible ? liveParts(state, plan, edits, goTo, tryout) : refusedParts(state, edits, tryout);
      head.replaceChildren(...parts.head);
      details.replaceChildren(...parts.details);
    },
  };
}

const TITLES = { infeasible: "Optimise found no motion either", failed: "Optimise failed", interrupted: "Optimise was interrupted" };

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
      element.replaceChildren(h("h4", { text: TITLES[job.state] }), h("p", { text: job.sentence }), ...sentences.map((text) => h("p", { text })));
    },
  };
}
