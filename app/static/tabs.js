/**
 * The inspector's sections stand one below the other; a tab brings its section to the top.
 * So every control can be found without knowing which tab hides it.
 */

import { byId } from "./dom.js";

const NAMES = ["optimise", "segments", "check", "robot"];
const place = { name: NAMES[0], offset: 0 };

function keepPlace() {
  const [sections, section] = [byId("sections"), byId(place.name)];
  place.offset = Math.min(place.offset, Math.max(0, section.offsetHeight - sections.clientHeight));
  sections.scrollTop = section.offsetTop + place.offset;
}

/** Brings a section to the top. */
export function openTab(name) {
  Object.assign(place, { name, offset: 0 });
  keepPlace();
  mark(name);
}

function mark(current) {
  for (const name of NAMES) {
    const tab = byId(`tab-${name}`);
    tab.setAttribute("aria-selected", String(name === current));
    tab.tabIndex = name === current ? 0 : -1;
  }
}

/** Takes note of where a person has scrolled to; the section that fills most of the view is the current one. */
function notePlace() {
  const { scrollTop, clientHeight } = byId("sections");
  const name = NAMES.filter((one) => byId(one).offsetTop <= scrollTop + clientHeight * 0.4).at(-1);
  Object.assign(place, { name, offset: scrollTop - byId(name).offsetTop });
  mark(name);
}

function mountTab(name, index) {
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
}

/** Wires tabs and scrolling to each other; what grows or shrinks above the view does not move it. */
export function mountTabs() {
  const sections = byId("sections");
  const resized = new ResizeObserver(keepPlace);
  resized.observe(sections);
  mark(NAMES[0]);
  NAMES.forEach((name, index) => {
    mountTab(name, index);
    resized.observe(byId(name));
    byId(name).addEventListener("click", () => { if (byId(name).offsetTop > sections.scrollTop + 8) openTab(name); });
  });
  sections.addEventListener("scroll", notePlace, { passive: true });
}
