/** The list of gaits, in groups that fold, and the choice of one. */

import { api } from "../api/gaits.js";
import { dialogFrame, openDialog } from "../lib/dialogs.js";
import { byId, h, setAttribute, setText } from "../lib/dom.js";
import { SPEED_UNIT, pace, timesText } from "../lib/format.js";
import { attempt, clearOfGait, report, toast } from "../lib/toasts.js";
import { acceptView } from "../state/store.js";
import { closeOverStage } from "./drawers.js";

const KEY = "footfall.gait";

function remember(id) {
  try {
    localStorage.setItem(KEY, id);
  } catch {
    return;
  }
}

function lastUsed() {
  try {
    return localStorage.getItem(KEY);
  } catch {
    return null;
  }
}

/** Shows a gait: fetches its view and remembers it for the next visit. */
export async function selectGait(store, id) {
  if (store.state.selected !== id) {
    clearOfGait();
    const { pending, left } = store.state;
    store.set({ selected: id, view: null, pending: [], left: [...left, ...pending.filter((edit) => !edit.refused)], gesture: null, live: null, remedies: null, iterate: null, refused: null, formError: null, shownJob: null, runSummary: null });
  }
  try {
    acceptView(store, await api.view(id));
    if (store.state.selected === id) remember(id);
  } catch (error) {
    if (store.state.selected === id) report(error);
  }
}

/** Shows a gait with its name under the keyboard; letters are the field's from the double click on. */
async function rename(store, id) {
  const field = byId("gait-name");
  field.focus();
  if (store.state.view?.id !== id) await selectGait(store, id);
  if (store.state.view?.id !== id) return;
  field.value = store.state.view.name;
  field.select();
}

/** After a greeting: the gait that runs, else the one shown, else the one used last, else the first. */
export function selectAfterHello(store) {
  const { gaits, selected, robot, view } = store.state;
  // What was just made may be shown before the greeting knows of it.
  const known = (id) => gaits.some((gait) => gait.id === id && !gait.problem) || id === view?.id;
  const running = robot?.run && robot.run.phase !== "ended" ? robot.run.gait : null;
  const first = gaits.find(({ problem }) => !problem)?.id;
  const choice = [selected, running, lastUsed(), first].find((id) => id && known(id));
  if (choice) selectGait(store, choice);
}

const ROW = h("li", {}, h("button", { class: "gait" }, h("span", { class: "name" }), h("span", { class: "tag" }, h("span", { class: "dot", title: "Unsaved changes" }), h("span"))));

/** A row, as a copy: hundreds are made before anything else is seen. */
function item(gait) {
  const element = ROW.cloneNode(true);
  const button = element.firstChild;
  const [name, { firstChild: dot, lastChild: tag }] = button.children;
  button.dataset.gait = gait.id;
  return { element, button, name, tag, dot };
}

const WAYS_OUT = { last: "Go back to the last state that can be shown", original: "Back to how it came" };

/** Says why a gait cannot be shown, and offers its way out; one of a person's own can be deleted, and brought back. */
function showWaysOut(store, { id, name, problem, way_out: wayOut }) {
  if (id.endsWith(".json")) {
    toast(problem, { tone: "bad" });
    return;
  }
  const bringBack = attempt(() => api.restore(id));
  const remove = attempt(async () => {
    await api.remove(id);
    toast(`${name} is deleted.`, { action: { label: "Bring it back", act: bringBack } });
  });
  const recover = attempt(async () => {
    const view = await api.recover(id);
    await selectGait(store, id);
    acceptView(store, view);
    toast(`${view.name} can be shown again. Its unreadable document is kept under Versions; an unreadable file is in the folder set-aside.`);
  });
  openDialog((close) => {
    const then = (act) => () => { close(null); act(); };
    return dialogFrame(`${name} cannot be shown`, close, then(recover), h("p", { text: problem }),
      h("div", { class: "buttons" },
        h("button", { type: "button", text: "Close", on: { click: () => close(null) } }),
        wayOut === "original" ? null : h("button", { type: "button", text: "Delete", on: { click: then(remove) } }),
        wayOut && h("button", { type: "submit", class: "primary", text: WAYS_OUT[wayOut] })));
  });
}

function showProblem(part, { name, problem }) {
  setText(part.name, name);
  setText(part.tag, "unreadable");
  setAttribute(part.button, "data-stuck", true);
  part.dot.hidden = true;
  setAttribute(part.button, "aria-current", null);
  setAttribute(part.button, "title", problem);
}

/** The last word of a row: what is wrong with the gait, else its pace on the robot, else what it is. */
function tagOf(gait) {
  const { outside, walks, source, orientation } = gait;
  if (outside) return "changed";
  if (walks === false) return "infeasible";
  const known = pace(gait);
  // The group's heading has the unit of speeds.
  if (known) return known.unit === SPEED_UNIT ? known.value : known.value + known.unit;
  return source === "sequence" ? "seq." : orientation;
}

function show(part, listed, selected, view) {
  // The view of the shown gait is newer than the list.
  const { plan_seconds, robot_seconds, speed, turn_rate } = view ?? {};
  const gait = view?.id === listed.id ? { ...listed, plan_seconds, robot_seconds, speed, turn_rate } : listed;
  if (gait.problem) {
    showProblem(part, gait);
    return;
  }
  setText(part.name, gait.name);
  const walks = gait.walks !== false;
  setText(part.tag, tagOf(gait));
  setAttribute(part.button, "data-stuck", !walks || Boolean(gait.outside));
  part.dot.hidden = !gait.edited;
  setAttribute(part.button, "aria-current", gait.id === selected ? "true" : null);
  const facts = [gait.robot, gait.orientation, gait.source, gait.kind, gait.source === "sequence" ? "" : `foot order ${gait.order.join(" ")}`, gait.edited ? "unsaved changes" : ""];
  const sentences = [`${gait.name}: ${facts.filter(Boolean).join(", ")}`, timesText(gait), gait.outside, walks ? "" : "No motion of it keeps every limit", "Double click: its name"];
  setAttribute(part.button, "title", sentences.filter(Boolean).join(". "));
}

const FIRST = "Saved";
const SETTLING_FRAMES = 10;
const FOLDED_AT_FIRST = ["By hand", "Orders of Appendix A", "Textbook"];

/** A group's heading, which folds it; the group that is shown stays open. */
function heading(group, folded, redraw) {
  const text = h("span", {});
  const unit = h("span", { class: "unit", title: "Speed on the robot", text: SPEED_UNIT });
  const button = h("button", { class: "group", on: { click: () => {
    if (!folded.delete(group)) folded.add(group);
    redraw();
  } } }, text, unit);
  return { element: h("li", { class: "group-row" }, button), button, text, unit };
}

function grouped(gaits) {
  const groups = new Map();
  for (const gait of gaits) {
    if (!groups.has(gait.group)) groups.set(gait.group, []);
    groups.get(gait.group).push(gait);
  }
  return [...groups].sort(([a], [b]) => (b === FIRST) - (a === FIRST));
}

/** Builds the list and keeps it current; moves on where the shown gait has gone. */
export function mountGaits(store) {
  const list = byId("gaits");
  let listed = null;
  const [parts, headings, folded] = [new Map(), new Map(), new Set(FOLDED_AT_FIRST)];

  const search = gaitSearch(() => draw(store.state));
  list.before(search.element);
  list.addEventListener("click", ({ target }) => {
    const id = target.closest("[data-gait]")?.dataset.gait;
    const unreadable = store.state.gaits.find((gait) => gait.id === id && gait.problem);
    if (unreadable) showWaysOut(store, unreadable);
    else if (id) {
      selectGait(store, id);
      closeOverStage();
    }
  });
  list.addEventListener("dblclick", ({ target }) => {
    const id = target.closest("[data-gait]")?.dataset.gait;
    if (id && !store.state.gaits.some((gait) => gait.id === id && gait.problem)) rename(store, id);
  });

  function draw({ gaits, selected, view }) {
    const wanted = new Set();
    const searched = search.search();
    const matching = searched ? gaits.filter((gait) => found(gait, searched)) : gaits;
    let listed = 0;
    for (const [group, members] of grouped(matching)) {
      const open = Boolean(searched) || !folded.has(group) || members.some(({ id }) => id === selected);
      if (!headings.has(group)) headings.set(group, heading(group, folded, () => draw(store.state)));
      const head = headings.get(group);
      if (open) listed += members.length;
      setText(head.text, open ? group : `${group} (${members.length})`);
      head.unit.hidden = !open || !members.some((gait) => pace(gait)?.unit === SPEED_UNIT);
      setAttribute(head.button, "aria-expanded", String(open));
      wanted.add(head.element);
      for (const gait of members) {
        if (!parts.has(gait.id)) parts.set(gait.id, item(gait));
        show(parts.get(gait.id), gait, selected, view);
        if (open) wanted.add(parts.get(gait.id).element);
      }
    }
    search.show(listed, gaits.length);
    for (const child of [...list.children]) if (!wanted.has(child)) child.remove();
    let next = list.firstElementChild;
    for (const element of wanted) {
      if (element === next) next = next.nextElementSibling;
      else list.insertBefore(element, next);
    }
  }

  const timesOf = (view) => [view?.id, view?.robot_seconds, view?.speed, view?.turn_rate];
  store.watch(({ gaits, selected, view }) => [gaits, selected, ...timesOf(view)], (state) => {
    const { gaits, selected, greeted } = state;
    const kept = new Set(gaits.map(({ id }) => id));
    for (const id of parts.keys()) if (!kept.has(id)) parts.delete(id);
    const row = parts.get(selected)?.element;
    const place = row?.offsetTop;
    draw(state);
    // A gait that was just made may be shown before the list tells of it: only one that was listed can be gone.
    if (kept.has(selected)) {
      const shown = parts.get(selected)?.element;
      // A name that sorts elsewhere takes its row along.
      if (shown && (listed !== selected || (shown.offsetTop !== place && !isPointedAt(shown)))) bringIntoSight(shown);
      listed = selected;
    } else if (greeted && selected && selected === listed && gaits.length) selectGait(store, gaits[0].id);
  });
}

/** Whether the pointer is over a row's list: what lies under it must not move away from a click. A closed group's rows have no list. */
const isPointedAt = (row) => row.parentElement?.matches(":hover") ?? false;

/** Scrolls to the chosen row, for some frames: rows above it have their true height only once they are drawn. */
function bringIntoSight(row, frames = SETTLING_FRAMES) {
  row.scrollIntoView({ block: "nearest" });
  const goOn = () => { if (row.isConnected && row.firstChild.getAttribute("aria-current") && !isPointedAt(row)) bringIntoSight(row, frames - 1); };
  if (frames > 0) requestAnimationFrame(goOn);
}

/** Whether a gait's line has every word of the search. */
function found(gait, search) {
  const words = search.toLowerCase().split(/\s+/).filter(Boolean);
  const text = [gait.name, gait.orientation, gait.source, gait.robot].filter(Boolean).join(" ").toLowerCase();
  return words.every((word) => text.includes(word) || word === gait.order.join(""));
}

/**
 * Builds the field. `show` gets the number of matches and the number of gaits.
 * @param {(search: string) => void} changed called with what is searched for
 * @returns {{element: HTMLElement, show: (listed: number, count: number) => void, search: () => string}}
 */
function gaitSearch(changed) {
  const field = h("input", { type: "search", "aria-label": "Find a gait", placeholder: "Find a gait", autocomplete: "off", spellcheck: "false", title: "Words of its name, robot, orientation or making; or its foot order" });
  const nothing = h("p", { class: "teach", role: "status", hidden: true });
  const element = h("div", { class: "gait-search" }, field, nothing);
  field.addEventListener("input", () => changed(field.value));
  field.addEventListener("keydown", (event) => {
    if (event.key !== "Escape" || !field.value) return;
    event.preventDefault();
    event.stopPropagation();
    field.value = "";
    changed("");
  });
  return {
    element,
    search: () => field.value,
    show(listed, count) {
      nothing.hidden = listed > 0 || !field.value;
      if (!listed) nothing.textContent = `No gait has “${field.value.trim()}”. Esc shows all ${count}.`;
    },
  };
}
