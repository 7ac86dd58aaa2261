/**
 * The height of the lower part: dragged by its upper edge, or set by keys while the edge has the focus. Rows
 * and plots grow and shrink with it; where they cannot shrink further, the part scrolls. Its usual height
 * leaves the robot room: what is more than that is seen by scrolling. Remembered in this browser.
 */

import { clamp } from "../lib/clamp.js";
import { remember, remembered } from "../lib/remembered.js";
import { byId, h, setAttribute } from "../lib/dom.js";

const KEY = "lower";
const STEP_PX = 16;
const BORDER_PX = 1;
const LEAST_PX = 150;
const LEAST_STAGE_PX = 220;
/** How far rows and plots shrink before the part scrolls, and how far they grow. */
const [LEAST_SCALE, MOST_SCALE] = [0.8, 3];
/** Share of the window for the chart at its usual height; of a low window two plots are in sight. */
const [USUAL_SHARE, LOW_SHARE, LOW_PX] = [0.5, 0.43, 800];
/** Narrower pages scroll as a whole. */
const NARROW_PX = 900;
const HELP =
  "To change the height, drag this edge or press Up or Down. "
  + "Home and End set the smallest and the largest height. Double click or Enter restores the usual height";

const most = () =>
  Math.max(LEAST_PX, window.innerHeight - byId("stop").closest("header").offsetHeight - LEAST_STAGE_PX);

/** The height that was chosen before in this browser, or null. */
function recalledHeight() {
  const { height } = remembered(KEY);
  return Number.isFinite(height) ? height : null;
}

/** Height of what grows: the rows of feet and the plots. */
function growing() {
  const strips = [...byId("plots").querySelectorAll(".strip")];
  return byId("timeline").offsetHeight + strips.reduce((sum, strip) => sum + strip.offsetHeight, 0);
}

/** The most that the chart takes at its usual height, px. */
function mostUsual() {
  const { innerWidth, innerHeight } = window;
  return innerWidth <= NARROW_PX ? Infinity : innerHeight * (innerHeight <= LOW_PX ? LOW_SHARE : USUAL_SHARE);
}

/** Gives the lower part a height, or its usual one for null. */
function apply(lower, height) {
  const scale = Number(lower.style.getPropertyValue("--scale") || 1);
  const natural = growing();
  if (!natural) return;
  const [above, chart] = [byId("chart").offsetTop, byId("chart").scrollHeight];
  const fixed = above + chart + parseFloat(getComputedStyle(lower).paddingBottom) + BORDER_PX - natural;
  const wanted = height === null ? 1 : (scale * (clamp(height, LEAST_PX, most()) - fixed)) / natural;
  const next = clamp(wanted, LEAST_SCALE, MOST_SCALE);
  if (Math.abs(next - scale) > 0.003) lower.style.setProperty("--scale", next.toFixed(4));
  const usual = above + mostUsual();
  const scrolls = height === null ? fixed + natural / scale > usual + BORDER_PX : wanted < LEAST_SCALE;
  lower.toggleAttribute("data-scrolls", scrolls);
  lower.style.height = scrolls
    ? `${Math.round(height === null ? usual : clamp(height, LEAST_PX, most()))}px`
    : "";
  // What lies over the chart, such as the playhead, goes down to its end.
  byId("overlay").style.height = scrolls ? `${byId("chart").scrollHeight}px` : "";
}

function showHeight(edge, lower) {
  const height = Math.round(lower.offsetHeight);
  setAttribute(edge, "aria-valuemin", String(LEAST_PX));
  setAttribute(edge, "aria-valuemax", String(Math.round(Math.max(most(), height))));
  setAttribute(edge, "aria-valuenow", String(height));
  setAttribute(edge, "aria-valuetext", `${height} pixels high`);
}

function mountDragging(edge, now, setTo, keep) {
  let drag = null;
  edge.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    drag = { y: event.clientY, from: now() };
    edge.setPointerCapture(event.pointerId);
    edge.dataset.held = "";
  });
  edge.addEventListener("pointermove", (event) => {
    if (drag) setTo(drag.from + drag.y - event.clientY);
  });
  const end = () => {
    if (drag) keep();
    drag = null;
    delete edge.dataset.held;
  };
  edge.addEventListener("pointerup", end);
  edge.addEventListener("pointercancel", end);
}

/** Puts the edge over the lower part. */
export function mountSplitter() {
  const lower = byId("chart").parentElement;
  const edge = h("div", {
    class: "edge lower-edge",
    role: "separator",
    tabindex: "0",
    "aria-orientation": "horizontal",
    "aria-label": "Height of timeline and plots",
    "aria-description": HELP,
    title: `Height of timeline and plots. ${HELP}`,
    data: { arrows: "" },
  });
  document.querySelector(".lower").prepend(edge);
  let height = recalledHeight();
  const show = () => {
    apply(lower, height);
    showHeight(edge, lower);
  };
  const setTo = (next) => {
    height = next === null ? null : clamp(next, LEAST_PX, most());
    show();
  };
  const keep = () => remember(KEY, { height });
  mountDragging(edge, () => lower.offsetHeight, setTo, keep);
  const usual = () => {
    setTo(null);
    keep();
  };
  edge.addEventListener("dblclick", usual);
  edge.addEventListener("keydown", (event) => {
    const far = event.shiftKey ? 4 : 1;
    const actions = {
      ArrowUp: () => setTo(lower.offsetHeight + STEP_PX * far),
      ArrowDown: () => setTo(lower.offsetHeight - STEP_PX * far),
      PageUp: () => setTo(lower.offsetHeight + STEP_PX * 4),
      PageDown: () => setTo(lower.offsetHeight - STEP_PX * 4),
      Home: () => setTo(LEAST_PX),
      End: () => setTo(most()),
      Enter: usual,
    };
    if (!actions[event.key] || event.ctrlKey || event.altKey || event.metaKey) return;
    event.preventDefault();
    actions[event.key]();
    keep();
  });
  const resized = new ResizeObserver(show);
  [lower, byId("timeline"), byId("plots"), document.body].forEach((one) => resized.observe(one));
}
