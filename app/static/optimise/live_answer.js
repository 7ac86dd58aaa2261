/** The optimiser's answer for the shown gait: the live tier's state in a line, what is missing, and remedies. */

import { byId, h, setAttribute, setText } from "../lib/dom.js";
import { fixed, mm } from "../lib/format.js";
import { jobOf } from "../shell/job_list.js";
import { shownPlan } from "../state/store.js";

const TEXTS = {
  live: ["Feasible", "good"], optimised: ["Optimised", "good"], manual: ["By hand", "good"], sequence: ["Sequence", "good"], iterate: ["An iteration, not the plan", "caution"],
  recorded: ["Recorded", "good"], poses: ["Feasible", "good"],
};
const FAMILIES = {
  body_torque: "Balance", margin: "Margin", workspace: "Reach", foot_speed: "Speed", body_speed: "Body speed", clearance: "Clearance",
  body_height: "Body height", boundary: "Start and goal", motor_speed: "Motor speed", motor_acceleration: "Acceleration", friction: "Friction",
  shoe_distance: "Shoes",
};
const SHOWN_MISSING = 3;
const ROUNDING_M = 1e-6;
const FOR_EVERY_MOTION = /^This is proven/;

/** Word and tone of a plan's state. */
export function planState(plan) {
  if (!plan) return ["No plan", "quiet"];
  if (plan.live?.status === "infeasible") return ["Infeasible", "bad"];
  if (plan.poses?.explanation.length) return ["Infeasible", "bad"];
  if (plan.source === "adapted") return ["Adapted, not solved", "caution"];
  if (!plan.times.length) return ["No motion", "bad"];
  if (plan.source === "draft" && plan.parts?.length && !plan.parts.some((part) => part.broke_off)) return ["Infeasible", "bad"];
  if (plan.source === "draft") return ["No answer", "caution"];
  if (plan.source === "recorded" && plan.refusal) return ["Recorded, out of reach", "bad"];
  if (plan.source === "manual" && plan.refusal) return ["By hand, out of reach", "bad"];
  if (plan.source === "manual" && plan.balance < -ROUNDING_M) return ["By hand, off balance", "caution"];
  return TEXTS[plan.source] ?? [plan.source, "quiet"];
}

const TIER = { live: "live", optimised: "exact", poses: "" };

/** The live line: dot, word, margin and time. */
export function statusLine() {
  const [dot, word, margin, time] = [h("span", { class: "dot" }), h("b"), h("span", { class: "number" }), h("span", { class: "number quiet", "aria-hidden": "true" })];
  const element = h("div", { class: "live-line", role: "status", "aria-label": "Live answer" }, dot, word, margin, time);
  return {
    element,
    show(plan) {
      const [text, tone] = planState(plan);
      dot.dataset.tone = tone;
      setText(word, tone === "good" && plan?.source in TIER ? `${text}, checked` : text);
      setText(margin, plan && plan.balance !== null && plan.times.length && text !== "Infeasible" ? `${mm(plan.balance)} mm` : "");
      margin.title = "Least distance of the balance point from the edge of the support polygon";
      margin.dataset.toneText = plan?.balance < 0 ? "bad" : "";
      const tier = plan?.source === "poses" ? `${fixed(plan.speed_mm_s ?? 0, 2)} mm/s` : TIER[plan?.source] ?? (plan?.live ? "live" : "");
      // The exact tier's time stands in the line of origin, where there is room for it.
      setText(time, tier === "live" && plan.seconds !== null ? `${tier} ${fixed(plan.seconds * 1000, 0)} ms` : tier);
    },
  };
}

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

function remedyParts(edits, remedies) {
  if (!remedies) return [h("p", { class: "why", text: "Looking for ways out…" })];
  const buttons = remedies.list.map(({ label, sentence, document }) =>
    h("button", { text: label, title: sentence, on: { click: () => edits.edit(({ name, notes }) => ({ ...document, name, notes }), label) } }));
  const none = remedies.sentence ?? "No single change was found that makes it feasible.";
  const note = !remedies.complete ? "The search was cut short; it goes on when nothing else is asked." : buttons.length ? null : none;
  return [
    buttons.length > 0 && h("div", { class: "buttons", role: "group", "aria-label": "Ways out" }, ...buttons),
    note && h("p", { class: "why", text: note }),
  ].filter(Boolean);
}

function liveParts(state, plan, edits, goTo) {
  const { evidence, explanation, lacks } = plan.live;
  // The last sentence names the scope of the answer: every motion, or the live tier's model.
  const [first = "", ...rest] = explanation;
  const closing = rest.at(-1) ?? first;
  const text = evidence === "proven" && !FOR_EVERY_MOTION.test(closing) ? "proven for the live model" : evidence ?? "";
  const head = [
    h("p", { class: "first", title: explanation.join(" ") }, first, text && h("span", { class: "quiet", text: ` (${text})`, title: closing })),
    ...remedyParts(edits, state.remedies),
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
export function liveAnswer(edits, goTo) {
  const [head, details] = [h("div", {}), h("div", { class: "why-details" })];
  const element = h("div", { class: "box-note why-not", role: "region", "aria-label": "Why it is infeasible", data: { tone: "bad" }, hidden: true }, head, details);
  keepVisible(element, details);
  return {
    element,
    show(state) {
      const plan = shownPlan(state);
      const why = plan?.poses?.explanation ?? [];
      element.hidden = plan?.live?.status !== "infeasible" && !why.length;
      if (element.hidden) return;
      if (why.length) {
        head.replaceChildren(...why.map((text) => h("p", { text })));
        details.replaceChildren();
        return;
      }
      const parts = liveParts(state, plan, edits, goTo);
      head.replaceChildren(...parts.head);
      details.replaceChildren(...parts.details);
    },
  };
}

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
      element.replaceChildren(h("h4", { text: `Exact tier: ${job.state}` }), h("p", { text: job.sentence }), ...sentences.map((text) => h("p", { text })));
    },
  };
}
