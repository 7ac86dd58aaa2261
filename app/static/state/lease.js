/**
 * The lease of the robot: one person at a time moves it; everybody else can watch, ask for it and stop it.
 */

import { api } from "../api/gaits.js";
import { pageId } from "../api/author.js";
import { h, onPress, setAttribute, setText } from "../lib/dom.js";
import { needOperator } from "./operator.js";
import { acceptRobot, runIsOn } from "./store.js";
import { attempt, toast } from "../lib/toasts.js";

/** @typedef {import("./store.js").Store} Store */

const FREE = "No one is in control. You get control when you press Connect or Arm.";

/** @param {any} lease */
const isMine = (lease) => lease?.page === pageId();
/** @param {any} lease */
const isTaken = (lease) => Boolean(lease?.page);

/** Why this tab may not move the robot; null where it may. @param {any} robot */
export function whyNotHeld(robot) {
  const lease = robot?.lease;
  return isTaken(lease) && !isMine(lease) ? lease.refusal : null;
}

/** Whether this tab is in control of the robot. @param {any} robot */
export const isHolder = (robot) => isMine(robot?.lease);

/** Who holds the robot, in a sentence; nothing where nobody does. @param {any} robot */
export function holderSentence(robot) {
  const lease = robot?.lease;
  if (!isTaken(lease)) return "";
  if (isMine(lease)) return "You are in control.";
  return lease.is_gone ? `${lease.name} left without releasing control.` : `${lease.name} is in control.`;
}

/**
 * Asks for the robot, gives it, keeps it, takes it over or lets it go, in the name of who sits here.
 * @param {Store} store
 * @param {"ask"|"give"|"keep"|"take"|"release"} act
 */
function handOver(store, act) {
  return attempt(async () => {
    const why = "Other people see your name while you are in control of the robot.";
    if (!(await needOperator(store, why))) return;
    acceptRobot(store, await api.lease(act, store.state.operator));
  });
}

/** What becomes of a run when another person takes control. @param {Record<string, any>} robot */
function runSentence(robot) {
  if (robot.robot === "paused") return " The run stays paused until you resume it.";
  return runIsOn(robot) ? " The run continues, and you can pause the run." : "";
}

/** The question before a take-over, in the panel, with what becomes of the run. @param {Store} store */
function takeOverQuestion(store) {
  const sentence = h("p");
  const [yes, no] = [
    h("button", { class: "primary", text: "Take control" }),
    h("button", { text: "Cancel" }),
  ];
  const element = h(
    "div",
    {
      class: "box-note",
      role: "group",
      "aria-label": "Take over",
      data: { tone: "caution", ownEscape: "" },
      hidden: true,
    },
    sentence,
    h("div", { class: "buttons" }, yes, no),
  );
  /** @type {any} */
  let opener = null;
  const close = () => {
    element.hidden = true;
    opener?.focus();
  };
  onPress(yes, async () => {
    close();
    await handOver(store, "take")();
  });
  onPress(no, close);
  element.addEventListener("keydown", (event) => {
    if (event.key === "Escape" && !runIsOn(store.state.robot)) close();
  });
  return {
    element,
    /** @param {Event} event */
    open({ currentTarget }) {
      const { robot } = store.state;
      setText(
        sentence,
        `If you take control, ${robot.lease.name} can no longer move the robot.${runSentence(robot)} `
          + "Look at the robot before you take control.",
      );
      opener = currentTarget;
      element.hidden = false;
      no.focus();
    },
    /** @param {boolean} isOffered */
    show: (isOffered) => {
      if (!isOffered) setAttribute(element, "hidden", true);
    },
  };
}

/** @typedef {ReturnType<typeof build>} Parts */

/** @param {Store} store */
function build(store) {
  /** @param {string} text @param {(event: any) => void} act */
  const button = (text, act) => {
    const element = h("button", { text });
    onPress(element, act);
    return element;
  };
  const question = takeOverQuestion(store);
  return {
    question,
    sentence: h("p"),
    policy: h("p", { class: "why" }),
    ask: button("Ask for control", handOver(store, "ask")),
    take: button("Take over", question.open),
    give: button("Give control", handOver(store, "give")),
    keep: button("Keep control", handOver(store, "keep")),
    release: button("Release control", handOver(store, "release")),
  };
}

/** @param {any} lease @param {any} robot */
function words(lease, robot) {
  if (!isTaken(lease)) return FREE;
  if (isMine(lease) && lease.asker) return `You are in control. ${lease.asker.name} asks for control.`;
  if (lease.asker?.page === pageId())
    return `${holderSentence(robot)} You have asked for control. Wait for the answer.`;
  return holderSentence(robot);
}

/**
 * Offers what the holder can do.
 * @param {Parts} parts
 * @param {any} lease
 * @param {boolean} isOn whether a run is on
 */
function offerToHolder({ give, keep, release }, lease, isOn) {
  const mine = isMine(lease);
  give.hidden = keep.hidden = !(mine && lease.asker);
  setText(give, `Give control to ${lease?.asker?.name ?? ""}`);
  release.hidden = !mine || Boolean(lease.asker) || isOn;
}

/** Offers what everybody else can do. @param {Parts} parts @param {any} lease */
function offerToOthers({ take, ask, question }, lease) {
  const isOther = isTaken(lease) && !isMine(lease);
  take.hidden = !isOther || !lease.can_be_taken;
  question.show(!take.hidden);
  ask.hidden = !isOther || lease.can_be_taken || lease.asker?.page === pageId();
}

/** @param {Parts} parts @param {any} robot */
function show(parts, robot) {
  const lease = robot?.lease;
  setText(parts.sentence, robot ? words(lease, robot) : "");
  setText(parts.policy, robot?.link === "ready" ? (lease?.policy ?? "") : "");
  offerToHolder(parts, lease, runIsOn(robot));
  offerToOthers(parts, lease);
}

/**
 * Notifies the holder of a request, and the asker of the answer, in any part of the page.
 * @param {Store} store
 */
function tell(store) {
  let before = store.state.robot?.lease ?? null;
  store.watch(
    ({ robot }) => [robot?.lease?.page, robot?.lease?.asker?.page],
    ({ robot }) => {
      const now = robot?.lease ?? null;
      const isRequested = isMine(now) && now.asker && now.asker.page !== before?.asker?.page;
      if (isRequested)
        toast(`${now.asker.name} asks for control of the robot. Answer in the Run step.`, { of: "studio" });
      if (isMine(now) && isTaken(before) && !isMine(before)) {
        toast("You are now in control of the robot.", { of: "studio" });
      }
      if (isMine(before) && isTaken(now) && !isMine(now)) {
        toast(`${now.name} is now in control of the robot.`, { of: "studio" });
      }
      before = now;
    },
  );
}

/**
 * Builds the part of the step Run that shows who is in control. While a run is on it is there for whoever
 * has to act on it.
 * @param {Store} store
 */
export function leasePart(store) {
  const parts = build(store);
  store.watch(
    ({ robot }) => [robot?.lease, robot?.robot, robot?.run?.phase],
    ({ robot }) => show(parts, robot),
  );
  tell(store);
  const element = h(
    "div",
    { class: "lease", role: "group", "aria-label": "Who is in control" },
    parts.sentence,
    h("div", { class: "buttons" }, parts.ask, parts.take, parts.give, parts.keep, parts.release),
    parts.question.element,
    parts.policy,
  );
  store.watch(
    ({ robot }) => [robot?.lease],
    ({ robot }) => {
      const lease = robot?.lease;
      element.toggleAttribute("data-to-decide", isTaken(lease) && (!isMine(lease) || Boolean(lease.asker)));
    },
  );
  return element;
}
