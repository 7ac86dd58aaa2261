/**
 * The inspector's sections stand one below the other; a tab brings its section to the top.
 * So every control can be found without knowing which tab hides it.
 */

import { byId } from "./dom.js";

const NAMES = ["optimise", "segments", "check", "simulate", "robot"];
/** The last tab opens a part of its own over the sections, with the pattern search. */
const TABS = [...NAMES, "patterns"];

/** A tab's section; a sequence has its parts where other gaits have their segment table. */
const sectionOf = (name) => (name === "segments" && !byId("sequence").hidden ? byId("sequence") : byId(name));

const place = { name: NAMES[0], offset: 0, scroll: 0 };
let onOpened = () => {};

/** Calls `act` with the name of each tab that is opened. */
export function onTab(act) {
  onOpened = act;
}

function keepPlace() {
  const [sections, section] = [byId("sections"), sectionOf(place.name)];
  place.offset = Math.min(place.offset, Math.max(0, section.offsetHeight - sections.clientHeight));
  sections.scrollTop = section.offsetTop + place.offset;
  place.scroll = sections.scrollTop;
}

/** Brings a section to the top. */
export function openTab(name) {
  onOpened(name);
  mark(name);
  if (!NAMES.includes(name)) return;
  Object.assign(place, { name, offset: 0 });
  keepPlace();
}

function mark(current) {
  for (const name of TABS) {
    const tab = byId(`tab-${name}`);
    tab.setAttribute("aria-selected", String(name === current));
    tab.tabIndex = name === current ? 0 : -1;
  }
}

/** Takes note of where a person has scrolled to; the section that fills most of the view is the current one. */
function notePlace() {
  const { scrollTop, clientHeight } = byId("sections");
  // Ignore scrolling by the page itself: it does not show which section a person looks at.
  if (scrollTop === place.scroll) return;
  const name = NAMES.filter((one) => sectionOf(one).offsetTop <= scrollTop + clientHeight * 0.4).at(-1);
  Object.assign(place, { name, offset: scrollTop - sectionOf(name).offsetTop });
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
    const next = TABS[(to + TABS.length) % TABS.length];
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
  TABS.forEach(mountTab);
  NAMES.forEach((name) => {
    const own = name === "segments" ? [byId(name), byId("sequence")] : [byId(name)];
    for (const section of own) {
      resized.observe(section);
      section.addEventListener("click", () => { if (section.offsetTop > sections.scrollTop + 8) openTab(name); });
    }
  });
  sections.addEventListener("scroll", notePlace, { passive: true });
}
