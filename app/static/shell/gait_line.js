/** A line of the list of gaits: its state, its name, its footfalls as a picture, its pace on the robot. */

import { h, setAttribute, setText } from "../lib/dom.js";
import { SPEED_UNIT, pace, timesText } from "../lib/format.js";
import { thumbnail } from "./footfalls.js";

const SETTLING_FRAMES = 10;

/** States of a gait, each with the mark before its name and a sentence. */
const STATES = {
  unreadable: { mark: "bad", sentence: "This gait cannot be shown" },
  outside: { mark: "bad", sentence: "" },
  infeasible: { mark: "bad", sentence: "No motion of this gait keeps every limit" },
  edited: { mark: "edited", sentence: "Unsaved changes" },
  timed: { mark: "good", sentence: "The studio has computed how long the robot takes for this gait" },
  unknown: {
    mark: "unknown",
    sentence: "The studio has not yet computed how long the robot takes for this gait",
  },
};

/**
 * @typedef {Record<string, any>} Line
 * @property {HTMLLIElement} element
 * @property {HTMLButtonElement} button
 * @property {HTMLElement} dot
 * @property {HTMLElement} name
 * @property {HTMLElement} picture
 * @property {HTMLElement} tag
 * @property {string[]} columns of the picture that is wanted
 * @property {string} drawn of the picture that is shown
 */

const ROW = h(
  "li",
  {},
  h(
    "button",
    { class: "gait" },
    h("i", { class: "state", "aria-hidden": "true" }),
    h("span", { class: "name", data: { userText: "" } }),
    h("span", { class: "picture", "aria-hidden": "true" }),
    h("span", { class: "tag" }),
  ),
);

/** @type {WeakMap<Element, Line>} */
const lines = new WeakMap();

/** Pictures are drawn when their lines come into sight: most of hundreds never do. */
const inSight = new IntersectionObserver((entries) => {
  for (const { isIntersecting, target } of entries) if (isIntersecting) draw(lines.get(target));
});

function draw(line) {
  const key = line.columns.join();
  line.isSeen = true;
  if (line.drawn === key) return;
  line.drawn = key;
  line.picture.replaceChildren(...(line.columns.length ? [thumbnail(line.columns)] : []));
}

/**
 * A line, as a copy: hundreds are made before anything else is seen.
 * @param {{id: string}} gait
 * @returns {Line}
 */
export function gaitLine(gait) {
  const element = /** @type {HTMLLIElement} */ (ROW.cloneNode(true));
  const button = /** @type {HTMLButtonElement} */ (element.firstElementChild);
  const [dot, name, picture, tag] = button.children;
  button.dataset.gait = gait.id;
  const line = { element, button, dot, name, picture, tag, columns: [], drawn: "", isSeen: false };
  lines.set(element, line);
  inSight.observe(element);
  return line;
}

function stateOf(gait) {
  if (gait.problem) return "unreadable";
  if (gait.outside) return "outside";
  if (gait.walks === false) return "infeasible";
  if (gait.edited) return "edited";
  return pace(gait) ? "timed" : "unknown";
}

/** The last word of a line: the trouble of the gait, else its pace on the robot. */
function tagOf(gait, state) {
  if (state === "unreadable" || state === "infeasible") return state;
  if (state === "outside") return "changed";
  const known = pace(gait);
  // The group's heading has the unit of speeds.
  if (known) return known.unit === SPEED_UNIT ? known.value : known.value + known.unit;
  return gait.source === "sequence" ? "seq." : "–";
}

function titleOf(gait, state) {
  if (gait.problem) return gait.problem;
  const { name, robot, orientation, source, kind, order, edited, outside } = gait;
  const orders = source === "sequence" ? "" : `foot order ${order.join(" ")}`;
  const facts = [robot, orientation, source, kind, orders, edited ? "unsaved changes" : ""];
  const trouble = state === "infeasible" || state === "unknown" ? STATES[state].sentence : "";
  const whole = `${name}: ${facts.filter(Boolean).join(", ")}`;
  const sentences = [whole, timesText(gait), outside, trouble, "Double click to change the name"];
  return sentences.filter(Boolean).join(". ");
}

/**
 * Shows a gait in its line.
 * @param {Line} line
 * @param {Record<string, any>} listed
 * @param {string|null} selected
 * @param {Record<string, any>|null} view of the shown gait: newer than the list
 */
export function showLine(line, listed, selected, view) {
  const { plan_seconds, robot_seconds, speed, turn_rate } = view ?? {};
  const gait = view?.id === listed.id ? { ...listed, plan_seconds, robot_seconds, speed, turn_rate } : listed;
  const state = stateOf(gait);
  const { mark, sentence } = STATES[state];
  setText(line.name, gait.name);
  setText(line.tag, tagOf(gait, state));
  setAttribute(line.dot, "data-state", mark);
  setAttribute(line.dot, "title", sentence || gait.outside);
  setAttribute(line.button, "data-stuck", mark === "bad");
  setAttribute(line.button, "aria-current", gait.id === selected && !gait.problem ? "true" : null);
  setAttribute(line.button, "title", titleOf(gait, state));
  line.columns = gait.footfalls;
  if (line.isSeen) draw(line);
}

/** Whether the pointer is over a row's list, where no row may move away from a click; a row may have none. */
export const isPointedAt = (row) => row.parentElement?.matches(":hover") ?? false;

/** Scrolls to a row, for some frames: rows above it have their true height only once they are drawn. */
export function bringIntoSight(row, frames = SETTLING_FRAMES) {
  row.scrollIntoView({ block: "nearest" });
  const goOn = () => {
    if (row.isConnected && row.firstChild.getAttribute("aria-current") && !isPointedAt(row))
      bringIntoSight(row, frames - 1);
  };
  if (frames > 0) requestAnimationFrame(goOn);
}

/**
 * Shows a cut name in full over its line, while the pointer or the focus is on it.
 * @param {HTMLElement} list
 */
export function mountWholeNames(list) {
  const whole = h("span", { class: "whole-name", "aria-hidden": "true", hidden: true });
  list.after(whole);
  const hide = () => {
    whole.hidden = true;
  };
  const show = ({ target }) => {
    const name = target.closest(".gait")?.querySelector(".name");
    if (!name || name.scrollWidth <= name.clientWidth) return hide();
    const { left, top, height } = name.parentElement.getBoundingClientRect();
    whole.textContent = name.textContent;
    whole.hidden = false;
    Object.assign(whole.style, { left: `${left}px`, top: `${top}px`, height: `${height}px` });
    return undefined;
  };
  list.addEventListener("pointerover", show);
  list.addEventListener("focusin", show);
  list.addEventListener("pointerleave", hide);
  list.addEventListener("focusout", hide);
  list.closest(".drawer").addEventListener("scroll", hide, { passive: true });
}
