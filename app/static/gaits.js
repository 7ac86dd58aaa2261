/** The list of gaits: select, duplicate, import, export, delete with a way back. */

import { api } from "./api.js";
import { byId, h, setAttribute, setText } from "./dom.js";
import { acceptView } from "./store.js";
import { attempt, report, toast } from "./toasts.js";

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
    store.set({ selected: id, view: null, pending: [], gesture: null, refused: null, formError: null, shownJob: null, runSummary: null });
  }
  try {
    acceptView(store, await api.view(id));
    remember(id);
  } catch (error) {
    report(error);
  }
}

/** After a greeting: the gait that runs, else the one shown, else the one used last, else the first. */
export function selectAfterHello(store) {
  const { gaits, selected, robot } = store.state;
  const known = (id) => gaits.some((gait) => gait.id === id);
  const running = robot?.run && robot.run.phase !== "ended" ? robot.run.gait : null;
  const choice = [selected, running, lastUsed(), gaits[0]?.id].find((id) => id && known(id));
  if (choice) selectGait(store, choice);
}

function item(store, gait) {
  const dot = h("span", { class: "dot", title: "Unsaved changes" });
  const name = h("span", { class: "name" });
  const tag = h("span", {});
  const button = h("button", { class: "gait", on: { click: () => selectGait(store, gait.id) } }, name, h("span", { class: "tag" }, dot, tag));
  return { element: h("li", {}, button), button, name, tag, dot };
}

function show(part, gait, selected) {
  setText(part.name, gait.name);
  setText(part.tag, gait.orientation);
  part.dot.hidden = !gait.edited;
  setAttribute(part.button, "aria-current", gait.id === selected ? "true" : null);
  setAttribute(part.button, "title", `${gait.name}: ${gait.source}, ${gait.kind}, foot order ${gait.order.join(" ")}${gait.edited ? ", unsaved changes" : ""}`);
}

function importFile(store) {
  const input = h("input", { type: "file", accept: ".json,application/json" });
  input.addEventListener("change", attempt(async () => {
    const text = await input.files[0].text();
    let document;
    try {
      document = JSON.parse(text);
    } catch (error) {
      throw new Error(`${input.files[0].name} is not JSON: ${error.message}. Choose a gait file (footfall-gait).`);
    }
    const view = await api.create(document);
    await selectGait(store, view.id);
  }));
  input.click();
}

async function exportFile(store) {
  const document = await api.document(store.state.selected);
  const address = URL.createObjectURL(new Blob([JSON.stringify(document, null, 2)], { type: "application/json" }));
  h("a", { href: address, download: `${document.name.replace(/[^\p{L}\p{N}]+/gu, "-")}.json` }).click();
  setTimeout(() => URL.revokeObjectURL(address), 1000);
}

async function remove(store) {
  const { selected, gaits } = store.state;
  const name = gaits.find(({ id }) => id === selected).name;
  await api.remove(selected);
  const restore = attempt(async () => {
    await api.restore(selected);
    await selectGait(store, selected);
  });
  toast(`${name} is deleted.`, { action: { label: "Bring it back", act: restore } });
  const next = store.state.gaits.find(({ id }) => id !== selected) ?? null;
  await selectGait(store, store.state.gaits.some(({ id }) => id === selected) ? selected : next?.id);
}

async function duplicate(store) {
  const { selected, gaits } = store.state;
  const names = new Set(gaits.map(({ name }) => name));
  const base = gaits.find(({ id }) => id === selected).name;
  let name = `${base} copy`;
  for (let count = 2; names.has(name); count += 1) name = `${base} copy ${count}`;
  const view = await api.copy(selected, name);
  await selectGait(store, view.id);
}

function tools(store) {
  const link = (text, title, act) => h("button", { class: "link", text, title, on: { click: attempt(() => act(store)) } });
  const deletion = link("Delete", "Delete this saved gait; it can be brought back", remove);
  byId("gait-tools").append(
    link("Duplicate", "A copy of this gait under another name", duplicate),
    link("Import…", "Read a gait file", importFile), link("Export", "Write this gait as a file", exportFile), deletion);
  store.watch(({ gaits, selected }) => [gaits, selected], ({ gaits, selected }) => {
    deletion.hidden = gaits.find(({ id }) => id === selected)?.kind !== "saved";
  });
}

/** Builds the list and keeps it current; moves on where the shown gait has gone. */
export function mountGaits(store) {
  const list = byId("gaits");
  const parts = new Map();
  tools(store);
  store.watch(({ gaits, selected }) => [gaits, selected], ({ gaits, selected, greeted }) => {
    const kept = new Set(gaits.map(({ id }) => id));
    for (const [id, part] of parts) if (!kept.has(id)) { part.element.remove(); parts.delete(id); }
    gaits.forEach((gait, index) => {
      if (!parts.has(gait.id)) parts.set(gait.id, item(store, gait));
      const part = parts.get(gait.id);
      show(part, gait, selected);
      if (list.children[index] !== part.element) list.insertBefore(part.element, list.children[index] ?? null);
    });
    if (greeted && selected && gaits.length && !kept.has(selected)) selectGait(store, gaits[0].id);
  });
}
