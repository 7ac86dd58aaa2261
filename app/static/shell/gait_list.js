/** The list of gaits, in groups that fold, and the choice of one. */

import { api } from "../api/gaits.js";
import { dialogFrame, openDialog } from "../lib/dialogs.js";
import { byId, h, setAttribute, setText } from "../lib/dom.js";
import { SPEED_UNIT, pace } from "../lib/format.js";
import { remember, remembered } from "../lib/remembered.js";
import { attempt, clearOfGait, report, toast } from "../lib/toasts.js";
import { acceptView } from "../state/store.js";
import { closeOverStage } from "./drawers.js";
import { bringIntoSight, gaitLine, isPointedAt, mountWholeNames, showLine } from "./gait_line.js";

const KEY = "footfall.gait";

function rememberGait(id) {
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

/** What belongs to the gait that was shown before. */
const NOTHING_SHOWN = {
  gesture: null,
  live: null,
  remedies: null,
  iterate: null,
  refused: null,
  formError: null,
  shownJob: null,
  runSummary: null,
};

/** Shows a gait: fetches its view and remembers it for the next visit. */
export async function selectGait(store, id) {
  if (store.state.selected !== id) {
    clearOfGait();
    const { pending, left } = store.state;
    const unsent = [...left, ...pending.filter((edit) => !edit.refused)];
    store.set({ selected: id, view: null, pending: [], left: unsent, ...NOTHING_SHOWN });
  }
  try {
    acceptView(store, await api.view(id));
    if (store.state.selected === id) rememberGait(id);
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

/** The gait that the address names; it is asked for once, so that a reload shows what was shown last. */
function takeNamed() {
  const address = new URL(location.href);
  const named = address.searchParams.get("gait");
  if (named === null) return null;
  address.searchParams.delete("gait");
  history.replaceState(history.state, "", address);
  return named;
}

/** After a greeting: the gait that the address names, else the shown, running, last used or first one. */
export function selectAfterHello(store) {
  const { gaits, selected, robot, view } = store.state;
  const named = takeNamed();
  // What was just made may be shown before the greeting knows of it.
  const known = (id) => gaits.some((gait) => gait.id === id && !gait.problem) || id === view?.id;
  const running = robot?.run && robot.run.phase !== "ended" ? robot.run.gait : null;
  const first = gaits.find(({ problem }) => !problem)?.id;
  const choice = [named, selected, running, lastUsed(), first].find((id) => id && known(id));
  if (choice) selectGait(store, choice);
}

const WAYS_OUT = {
  last: "Go back to the last state that can be shown",
  original: "Restore the original gait",
};

/** Says why a gait cannot be shown, and offers its way out; one's own can be deleted, and brought back. */
function showWaysOut(store, { id, name, problem, way_out: wayOut }) {
  if (id.endsWith(".json")) {
    toast(problem, { tone: "bad" });
    return;
  }
  const bringBack = attempt(() => api.restore(id));
  const remove = attempt(async () => {
    await api.remove(id);
    toast(`“${name}” is deleted.`, { action: { label: "Bring it back", act: bringBack } });
  });
  const recover = attempt(async () => {
    const view = await api.recover(id);
    await selectGait(store, id);
    acceptView(store, view);
    toast(
      `“${view.name}” can be shown again. `
        + "The studio keeps unreadable states in the list Versions "
        + "and unreadable files in the folder set-aside.",
    );
  });
  openDialog((close) => {
    const then = (act) => () => {
      close(null);
      act();
    };
    return dialogFrame(
      `“${name}” cannot be shown`,
      close,
      then(recover),
      h("p", { text: problem }),
      h(
        "div",
        { class: "buttons" },
        h("button", { type: "button", text: "Close", on: { click: () => close(null) } }),
        wayOut === "original"
          ? null
          : h("button", { type: "button", text: "Delete", on: { click: then(remove) } }),
        wayOut && h("button", { type: "submit", class: "primary", text: WAYS_OUT[wayOut] }),
      ),
    );
  });
}

const [SAVED, FOR_ROBOT, EXAMPLES] = ["Saved", "For this robot", "Examples"];
/** Groups in their order; all others are examples, and stand in one fold. */
const AT_TOP = [SAVED, FOR_ROBOT];
const FOLDED_AT_FIRST = [EXAMPLES, "By hand", "Orders of Appendix A", "Textbook"];
const FOLDS = "gait-groups";

/**
 * Which groups are open: as the person left them in this browser. The group of a gait that is chosen opens
 * for as long as the page is open.
 */
function createFolds() {
  const chosen = remembered(FOLDS);
  const revealed = new Set();
  const isOpen = (group) => revealed.has(group) || (chosen[group] ?? !FOLDED_AT_FIRST.includes(group));
  return {
    isOpen,
    reveal(group) {
      revealed.add(group);
      if (!AT_TOP.includes(group)) revealed.add(EXAMPLES);
    },
    toggle(group) {
      chosen[group] = !isOpen(group);
      revealed.delete(group);
      remember(FOLDS, chosen);
    },
  };
}

/** A group's heading, which folds it. */
function heading(group, toggle) {
  const text = h("span", {});
  const title = "Computed speed of the gait on the robot";
  const unit = h("span", { class: "unit", title, text: SPEED_UNIT });
  const button = h("button", { class: "group", on: { click: () => toggle(group) } }, text, unit);
  const level = group === EXAMPLES || AT_TOP.includes(group) ? null : { level: "inner" };
  const element = h("li", { class: "group-row", data: level ?? {} }, button);
  return {
    element,
    show(isOpen, members) {
      setText(text, isOpen ? group : `${group} (${members.length})`);
      unit.hidden = group === EXAMPLES || !isOpen || !members.some((gait) => pace(gait)?.unit === SPEED_UNIT);
      setAttribute(button, "aria-expanded", String(isOpen));
    },
  };
}

/**
 * Groups with their gaits: one's own first, then those for the robot, then the examples.
 * @returns {Record<"top"|"examples", [string, Record<string, any>[]][]>}
 */
function grouped(gaits) {
  /** @type {Map<string, Record<string, any>[]>} */
  const groups = new Map();
  for (const group of AT_TOP) groups.set(group, []);
  for (const gait of gaits) {
    if (!groups.has(gait.group)) groups.set(gait.group, []);
    groups.get(gait.group).push(gait);
  }
  const all = [...groups].filter(([, members]) => members.length);
  return {
    top: all.filter(([group]) => AT_TOP.includes(group)),
    examples: all.filter(([group]) => !AT_TOP.includes(group)),
  };
}

/** Makes a list hold these rows in their order; those that stand in their place already stay as they are. */
function arrange(list, wanted) {
  for (const child of [...list.children]) if (!wanted.has(child)) child.remove();
  let next = list.firstElementChild;
  for (const element of wanted) {
    if (element === next) next = next.nextElementSibling;
    else list.insertBefore(element, next);
  }
}

/** The rows of the list: a heading for each group, and a line for each gait of an open group. */
function createRows(list, { store, search, folds }) {
  /** @type {[Map<string, Record<string, any>>, Map<string, Record<string, any>>]} */
  const [lines, headings] = [new Map(), new Map()];

  function toggle(group) {
    if (search.search()) return;
    folds.toggle(group);
    draw(store.state);
  }

  /** The heading of a group; whether the group is open. */
  function addHeading(wanted, group, members) {
    const isOpen = Boolean(search.search()) || folds.isOpen(group);
    if (!headings.has(group)) headings.set(group, heading(group, toggle));
    headings.get(group).show(isOpen, members);
    wanted.add(headings.get(group).element);
    return isOpen;
  }

  function addGroup(wanted, [group, members], { selected, view }) {
    if (!addHeading(wanted, group, members)) return;
    for (const gait of members) {
      if (!lines.has(gait.id)) lines.set(gait.id, gaitLine(gait));
      showLine(lines.get(gait.id), gait, selected, view);
      wanted.add(lines.get(gait.id).element);
    }
  }

  function draw(state) {
    const { gaits } = state;
    const wanted = new Set();
    const searched = search.search();
    const matching = searched ? gaits.filter((gait) => found(gait, searched)) : gaits;
    const { top, examples } = grouped(matching);
    for (const group of top) addGroup(wanted, group, state);
    const allExamples = examples.flatMap(([, members]) => members);
    if (allExamples.length && addHeading(wanted, EXAMPLES, allExamples)) {
      for (const group of examples) addGroup(wanted, group, state);
    }
    search.show(matching.length, gaits.length);
    arrange(list, wanted);
  }

  return { lines, draw };
}

/** Shows the gait whose line is clicked; a double click renames it. */
function mountChoice(list, store) {
  const chosen = ({ target }) => {
    const id = target.closest("[data-gait]")?.dataset.gait;
    return { id, unreadable: store.state.gaits.find((gait) => gait.id === id && gait.problem) };
  };
  list.addEventListener("click", (event) => {
    const { id, unreadable } = chosen(event);
    if (unreadable) showWaysOut(store, unreadable);
    else if (id) {
      selectGait(store, id);
      closeOverStage();
    }
  });
  list.addEventListener("dblclick", (event) => {
    const { id, unreadable } = chosen(event);
    if (id && !unreadable) rename(store, id);
  });
}

/** Opens the group of a gait when it is chosen or is found unreadable; the person may fold it again. */
function createRevealer(folds) {
  const troubled = new Set();
  let revealed = null;
  return ({ gaits, selected }) => {
    for (const { id, group, problem } of gaits) {
      if (!problem || troubled.has(id)) continue;
      troubled.add(id);
      folds.reveal(group);
    }
    const chosen = selected === revealed ? null : gaits.find(({ id }) => id === selected);
    if (!chosen) return;
    revealed = selected;
    folds.reveal(chosen.group);
  };
}

/** @type {(id: string) => HTMLElement|null} */
let lineOf = () => null;

/** The line of a gait, with its group open and no search on; null where there is none. */
export const lineInList = (id) => lineOf(id);

/** Builds the list and keeps it current; moves on where the shown gait has gone. */
export function mountGaits(store) {
  const list = byId("gaits");
  let listed = null;
  const search = gaitSearch(() => draw(store.state));
  const folds = createFolds();
  const { lines, draw } = createRows(list, { store, search, folds });
  const reveal = createRevealer(folds);
  list.before(search.element);
  mountWholeNames(list);
  mountChoice(list, store);

  lineOf = (id) => {
    const gait = store.state.gaits.find((one) => one.id === id);
    if (!gait) return null;
    search.clear();
    folds.reveal(gait.group);
    draw(store.state);
    return lines.get(id).button;
  };

  const timesOf = (view) => [view?.id, view?.robot_seconds, view?.speed, view?.turn_rate];
  store.watch(
    ({ gaits, selected, view }) => [gaits, selected, ...timesOf(view)],
    (state) => {
      const { gaits, selected, greeted } = state;
      const kept = new Set(gaits.map(({ id }) => id));
      for (const id of lines.keys()) if (!kept.has(id)) lines.delete(id);
      const row = lines.get(selected)?.element;
      const place = row?.offsetTop;
      reveal(state);
      draw(state);
      // A gait that was just made may be shown before the list tells of it: only a listed one can be gone.
      if (kept.has(selected)) {
        const shown = lines.get(selected)?.element;
        // A name that sorts elsewhere takes its row along.
        if (shown && (listed !== selected || (shown.offsetTop !== place && !isPointedAt(shown))))
          bringIntoSight(shown);
        listed = selected;
      } else if (greeted && selected && selected === listed && gaits.length) selectGait(store, gaits[0].id);
    },
  );
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
 * @returns {{element: HTMLElement, show: (listed: number, count: number) => void, search: () => string,
 *   clear: () => void}}
 */
function gaitSearch(changed) {
  const title =
    "Type a word from the name, robot, orientation or kind of a gait. "
    + "You can also type a foot order, such as 1324";
  const field = h("input", {
    type: "search",
    "aria-label": "Find a gait",
    placeholder: "Find a gait",
    title,
    autocomplete: "off",
    spellcheck: "false",
  });
  const nothing = h("p", { class: "teach", role: "status", hidden: true });
  const element = h("div", { class: "gait-search" }, field, nothing);
  const clear = () => {
    field.value = "";
    changed("");
  };
  field.addEventListener("input", () => changed(field.value));
  field.addEventListener("keydown", (event) => {
    if (event.key !== "Escape" || !field.value) return;
    event.preventDefault();
    event.stopPropagation();
    clear();
  });
  return {
    element,
    clear,
    search: () => field.value,
    show(listed, count) {
      nothing.hidden = listed > 0 || !field.value;
      if (!listed)
        nothing.textContent = `No gait matches “${field.value.trim()}”. Esc shows all ${count} gaits.`;
    },
  };
}
