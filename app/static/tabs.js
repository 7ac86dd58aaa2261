/**
 * The inspector's sections stand one below the other; a tab brings its section to the top.
 * So every control can be found without knowing which tab hides it.
 */

import { byId } from "./dom.js";

const NAMES = ["optimise", "segments", "check", "robot"];

/** Brings a section to the top. */
export function openTab(name, { smooth = false } = {}) {
  byId("sections").scrollTo({ top: byId(name).offsetTop, behavior: smooth ? "smooth" : "auto" });
  mark(name);
}

function mark(current) {
  for (const name of NAMES) {
    const tab = byId(`tab-${name}`);
    tab.setAttribute("aria-selected", String(name === current));
    tab.tabIndex = name === current ? 0 : -1;
  }
}

function atTop() {
  const { scrollTop, scrollHeight, clientHeight } = byId("sections");
  if (scrollTop + clientHeight >= scrollHeight - 2) return NAMES.at(-1);
  return NAMES.filter((name) => byId(name).offsetTop <= scrollTop + clientHeight * 0.4).at(-1);
}

/** Wires tabs and scrolling to each other. */
export function mountTabs() {
  const sections = byId("sections");
  mark(NAMES[0]);
  NAMES.forEach((name, index) => {
    const tab = byId(`tab-${name}`);
    tab.addEventListener("click", () => openTab(name));
    tab.addEventListener("keydown", (event) => {
      const to = { ArrowLeft: index - 1, ArrowRight: index + 1 }[event.key];
      if (to === undefined) return;
      event.preventDefault();
      event.stopPropagation();
      const next = NAMES[(to + NAMES.length) % NAMES.length];
      openTab(next);
      byId(`tab-${next}`).focus();
    });
  });
  sections.addEventListener("scroll", () => mark(atTop()), { passive: true });
}
