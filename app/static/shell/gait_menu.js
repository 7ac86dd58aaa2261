/** The menus over the list of gaits: new gaits, and acts on the shown one, such as export and delete. */

import { api } from "../api/gaits.js";
import { freeName } from "../document/gait_names.js";
import { actionMenu } from "../lib/action_menu.js";
import { dialogFrame, openDialog } from "../lib/dialogs.js";
import { byId, h } from "../lib/dom.js";
import { textOf } from "../lib/file_text.js";
import { clockTime } from "../lib/format.js";
import { attempt, toast } from "../lib/toasts.js";
import { askNewGait } from "./new_gait.js";

const FORMS = [
  ["json", "Gait (JSON)"],
  ["csv", "Trajectory (CSV)"],
  ["companion", "Trajectory metadata (JSON)"],
  ["waypoints", "Waypoints (CSV)"],
  ["npz", "Arrays (NPZ)"],
  ["phases", "Phase list (JSON)"],
  ["svg", "Gait diagram (SVG)"],
  ["png", "Gait diagram (PNG)"],
  ["html", "3D playback (HTML)"],
];
const KEPT = "This gait comes with the program, so you cannot delete it.";

async function exportFile(store, edits, form) {
  const { selected } = store.state;
  await edits.settled();
  const { name, blob } = await api.exportFile(selected, form);
  const address = URL.createObjectURL(blob);
  h("a", { href: address, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(address), 1000);
}

/** The selected gait's line, from the shown view if possible, which is newer than the list. */
const lineOf = ({ selected, gaits, view }) =>
  view?.id === selected ? view : (gaits.find(({ id }) => id === selected) ?? null);

/** Brings a deleted gait back and shows it; its id is another one where a new gait has its own by now. */
async function showRestored(deleted, show) {
  const { id, name, problem } = await api.restore(deleted);
  if (problem) {
    toast(`“${name}” is back, and cannot be shown. ${problem}`, { tone: "bad" });
    return;
  }
  if (id !== deleted) toast(`“${name}” is back as ${id}, because another gait has the id ${deleted}.`);
  await show(id);
}

function announceDeleted(sentence, id, show) {
  const restore = attempt(async () => {
    await showRestored(id, show);
  });
  toast(sentence, { action: { label: "Bring it back", act: restore } });
}

async function remove(store, show, deletedHere) {
  const { selected } = store.state;
  const { name } = lineOf(store.state);
  deletedHere.add(selected);
  try {
    await api.remove(selected);
  } catch (error) {
    deletedHere.delete(selected);
    throw error;
  }
  announceDeleted(`“${name}” is deleted.`, selected, show);
  if (store.state.selected !== selected) return;
  const next = store.state.gaits.find(({ id, problem }) => id !== selected && !problem) ?? null;
  await show(store.state.gaits.some(({ id }) => id === selected) ? selected : next?.id);
}

/** Says where somebody else has deleted the gait that this page showed; the list goes on to another one. */
function watchDeleted(store, show, deletedHere) {
  let last = null;
  store.watch(
    ({ gaits, selected }) => [gaits, selected],
    ({ gaits, selected }) => {
      const gone = last && !gaits.some(({ id }) => id === last.id) ? last : null;
      last = gaits.find(({ id }) => id === selected) ?? null;
      if (!gone || deletedHere.delete(gone.id)) return;
      announceDeleted(`“${gone.name}” was deleted in another tab.`, gone.id, show);
    },
  );
}

async function duplicate(store, show, edits) {
  const { selected } = store.state;
  await edits.settled();
  const { name } = lineOf(store.state);
  const view = await api.copy(selected, freeName(store.state, `${name} copy`));
  await show(view.id);
}

/** Asks for a new gait and shows it. */
export async function makeGait(store, show, preset = {}) {
  const id = await askNewGait({ ...preset, name: freeName(store.state, preset.name ?? "New gait") });
  if (id) await show(id);
}

/** The acts on the shown gait. */
function gaitActs(store, edits, show, deletedHere) {
  const exports = FORMS.map(([form, text]) => ({
    text,
    group: "Export as",
    help: `Download this gait as a file: ${text}`,
    act: attempt(() => exportFile(store, edits, form)),
  }));
  return [
    {
      text: "Duplicate",
      help: "Make a copy of this gait under another name",
      act: attempt(() => duplicate(store, show, edits)),
    },
    ...exports,
    {
      text: "Delete",
      help: "Delete this saved gait. To bring it back, choose New › Deleted gaits",
      act: attempt(() => remove(store, show, deletedHere)),
      refusal: () => (lineOf(store.state)?.kind === "saved" ? null : KEPT),
    },
  ];
}

/** @typedef {{text: string, help: string, act: () => void, group?: string, refusal?: () => any}} Entry */

/**
 * Builds the menus.
 * @param {import("../state/store.js").Store} store
 * @param {import("../state/edits.js").Edits} edits what was done before is part of a copy and of a file
 * @param {(id: string) => Promise<void>} show shows a gait
 * @param {() => void} openDesign opens the step Design
 * @returns {Record<"addNew"|"addAct", (entry: Entry) => void>} another entry of the menu New, and of the menu
 *   Gait, before Delete
 */
export function mountGaitTools(store, edits, show, openDesign) {
  const deletedHere = new Set();
  watchDeleted(store, show, deletedHere);
  const news = actionMenu({
    name: "New",
    help: "Make a new gait, or read a gait from a file",
    entries: [
      {
        text: "New gait…",
        help: "Make a gait from a robot, a foot order, a step and a phase length",
        act: attempt(() => makeGait(store, show)),
      },
      {
        text: "Import…",
        help: "Import gaits, trajectories with their metadata, waypoints or phase lists from files",
        act: () => importFiles(show, openDesign),
      },
      {
        text: "Deleted gaits…",
        help: "Bring back a gait that was deleted",
        act: attempt(() => bringBack(show)),
        refusal: noneDeleted,
      },
    ],
  });
  const acts = actionMenu({
    name: "Gait",
    help: "Copy, export or delete the shown gait, or search for footfall patterns",
    entries: gaitActs(store, edits, show, deletedHere),
  });
  byId("gait-menus").append(acts.element, news.element);
  return { addNew: (entry) => news.add(entry, 1), addAct: (entry) => acts.add(entry, -1) };
}

const NONE = "No gait is deleted, so there is no gait to bring back.";

/** Why the list cannot be shown: null where there is something in it. */
const noneDeleted = async () => ((await api.deleted()).length ? null : NONE);

function row({ id, name, when }, close) {
  return h(
    "li",
    {},
    h(
      "span",
      { class: "deleted-name" },
      h("b", { text: name }),
      h("small", { class: "quiet", text: `deleted ${clockTime(when)}` }),
    ),
    h("button", {
      type: "button",
      "aria-label": `Bring back ${name}`,
      text: "Bring back",
      on: { click: () => close(id) },
    }),
  );
}

/**
 * Lists what was deleted and brings back what is chosen.
 * @param {(id: string) => Promise<void>} show shows a gait
 */
async function bringBack(show) {
  const gaits = await api.deleted();
  if (!gaits.length) {
    toast(NONE);
    return;
  }
  const id = await openDialog((close) =>
    dialogFrame(
      "Deleted gaits",
      close,
      () => close(null),
      h("p", {
        class: "quiet",
        text: "A gait that you bring back keeps its edits, versions and undo history.",
      }),
      h(
        "ul",
        { class: "deleted-gaits", "aria-label": "Deleted gaits" },
        ...gaits.map((gait) => row(gait, close)),
      ),
      h("div", { class: "buttons" }, h("button", { type: "submit", text: "Close" })),
    ),
  );
  if (!id) return;
  await showRestored(id, show);
}

const COMPANION = ".footfall.json";
const KINDS = ".json,.csv,application/json,text/csv";

/** What is sent of the chosen files: each gait's file as it is, a trajectory and its companion as one. */
async function bodies(files) {
  const companions = new Map(
    files
      .filter(({ name }) => name.endsWith(COMPANION))
      .map((file) => [file.name.slice(0, -COMPANION.length), file]),
  );
  const gaits = files.filter(({ name }) => !name.endsWith(COMPANION));
  if (!gaits.length) {
    throw new Error(
      `“${files[0].name}” has only the metadata of a trajectory. `
        + "Also choose the CSV file of the trajectory.",
    );
  }
  return Promise.all(
    gaits.map(async (file) => {
      const companion = companions.get(file.name.replace(/\.csv$/i, ""));
      if (!companion) return { name: file.name, body: file };
      return {
        name: file.name,
        body: JSON.stringify({ csv: await textOf(file), companion: await textOf(companion) }),
      };
    }),
  );
}

/**
 * Lets a person choose files and makes a gait of each.
 * @param {(id: string) => Promise<void>} show shows a gait
 * @param {() => void} openDesign opens the step where it stands what an imported motion lacks
 */
function importFiles(show, openDesign) {
  const input = h("input", { type: "file", accept: KINDS, multiple: true });
  input.addEventListener(
    "change",
    attempt(async () => {
      const chosen = await bodies([...input.files]);
      const remarks = [];
      for (const { name, body } of chosen) {
        const view = await api.importFile(body, name);
        await show(view.id);
        openDesign();
        if (view.remarks.length)
          remarks.push([...(chosen.length > 1 ? [`${name}:`] : []), ...view.remarks].join(" "));
        // Showing the next one takes away what belongs to this one: all sentences stand beside the last.
        if (remarks.length) toast(remarks.join(" "));
      }
    }),
  );
  input.click();
}
