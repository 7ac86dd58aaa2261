/** A camera's setup on its picture: lens, place of the platform, colours of the feet. Each change is kept. */

import { CONFLICT } from "../api/gaits.js";
import { setupApi } from "../api/videos.js";
import { h, setText } from "../lib/dom.js";
import { attempt, report, toast } from "../lib/toasts.js";
import { openStage } from "../pictures/picture_stage.js";
import { watchable } from "../state/store.js";
import { feetPart } from "./camera_feet.js";
import { setupText } from "./camera_labels.js";
import { lensPart } from "./camera_lens.js";
import { placePart } from "./camera_place.js";

/** @type {[key: string, text: string, build: typeof lensPart][]} */
const PARTS = [
  ["lens", "Lens", lensPart],
  ["place", "Place", placePart],
  ["feet", "Feet", feetPart],
];

const FILE_HELP =
  "Downloads the setup as a file. Use this file on the command line: footfall trial VIDEO --setup FILE";

/**
 * The first part that is missing from a setup.
 * @param {Record<string, any>} answer
 */
const firstPart = ({ setup, view }) =>
  !setup.points.length && !setup.lens ? "lens" : view ? "feet" : "place";

/** Makes a setup with a name that is not taken yet. */
export async function newSetup() {
  const { setups, defaults } = await setupApi.list();
  const taken = new Set(setups.map(({ setup }) => setup.name));
  let number = 1;
  while (taken.has(`Camera setup ${number}`)) number += 1;
  return setupApi.add({ ...defaults, name: `Camera setup ${number}` });
}

function nameField(draft) {
  const input = h("input", {
    "aria-label": "Setup name",
    maxlength: "120",
    required: true,
    spellcheck: "false",
    autocomplete: "off",
  });
  input.addEventListener("change", () => {
    if (input.value.trim()) draft.change({ name: input.value.trim() });
    else input.value = draft.state.setup.name;
  });
  draft.watch(
    ({ setup }) => [setup.name],
    ({ setup }) => {
      if (input !== document.activeElement) input.value = setup.name;
    },
  );
  return input;
}

/** Tabs of the parts; each part is entered and left, since all draw over the same picture. */
function partTabs(parts, first) {
  const panel = h("div", { role: "tabpanel", id: "camera-part", "aria-labelledby": `camera-tab-${first}` });
  let current = null;
  const tabs = PARTS.map(([key, text], index) => {
    const tab = h("button", {
      type: "button",
      role: "tab",
      id: `camera-tab-${key}`,
      "aria-controls": "camera-part",
      text,
      data: { arrows: "" },
    });
    tab.addEventListener("click", () => open(key));
    tab.addEventListener("keydown", (event) => {
      const to = { ArrowLeft: index - 1, ArrowRight: index + 1 }[event.key];
      if (to === undefined) return;
      event.preventDefault();
      const [next] = PARTS[(to + PARTS.length) % PARTS.length];
      open(next);
      tabs[(to + PARTS.length) % PARTS.length].focus();
    });
    return tab;
  });

  function open(key) {
    if (key === current) return;
    if (current) parts[current].leave();
    current = key;
    PARTS.forEach(([one], index) => {
      tabs[index].setAttribute("aria-selected", String(one === key));
      tabs[index].tabIndex = one === key ? 0 : -1;
    });
    panel.setAttribute("aria-labelledby", `camera-tab-${key}`);
    panel.replaceChildren(parts[key].element);
    parts[key].enter();
  }
  return {
    elements: [
      h("div", { class: "tabs camera-tabs", role: "tablist", "aria-label": "Setup" }, ...tabs),
      panel,
    ],
    open,
  };
}

/** Says so where the shown picture has another size than the setup's own. */
function sizeNote(draft, stage) {
  const note = h("p", { class: "why", role: "status", data: { toneText: "caution" } });
  const tell = () => {
    const { size } = draft.state.setup;
    const { width, height } = stage.picture.size;
    const differs = stage.picture.image.src && size && (size[0] !== width || size[1] !== height);
    const wanted = size?.join(" × ");
    setText(
      note,
      differs
        ? `This setup is for pictures of ${wanted} px, but the picture has `
            + `${width} × ${height} px. Set the camera to ${wanted} px, or make another setup.`
        : "",
    );
  };
  stage.picture.onView(tell);
  draft.watch(({ setup }) => [setup.size], tell);
  return note;
}

/** Whether the setup is complete, and whether it is kept. */
function stateLine(draft) {
  const line = h("p", { class: "camera-state", role: "status", "aria-label": "Setup state" });
  draft.watch(
    ({ answer, kept, revision, trouble }) => [answer, kept, revision, trouble],
    ({ answer, kept, revision, trouble }) => {
      const keeping = kept
        ? `Saved, version ${revision}.`
        : trouble
          ? `The last change was not saved: ${trouble}`
          : "Saving…";
      line.replaceChildren(
        h("span", { class: "dot", data: { tone: trouble ? "bad" : answer.ready ? "good" : "caution" } }),
        h("span", { text: `${setupText(answer)} ${keeping}` }),
      );
    },
  );
  return line;
}

/** Deletes the setup, and offers to bring it back. */
async function removeSetup(draft, back) {
  await draft.settled();
  const { id, setup } = draft.state;
  await setupApi.remove(id);
  back();
  const undo = attempt(async () => {
    await setupApi.restore(id);
    back();
  });
  toast(`The setup “${setup.name}” is deleted.`, { action: { label: "Undo", act: undo } });
}

/**
 * Opens a setup in the panel.
 * @param {Record<string, any>} page of the trials' panel
 * @param {Object} wanted
 * @param {Record<string, any>} wanted.answer the setup as the server tells it
 * @param {import("../api/videos.js").Source} wanted.source where the picture comes from
 * @param {number} [wanted.frame]
 * @param {{text: string, act: () => void}} wanted.back
 */
export function openSetup(page, { answer, source, frame = 0, back }) {
  const draft = setupDraft(answer);
  const stage = openStage(source, frame);
  const parts = Object.fromEntries(PARTS.map(([key, , build]) => [key, build(draft, stage)]));
  const tabs = partTabs(parts, firstPart(answer));
  const leave = attempt(async () => {
    await draft.settled();
    back.act();
  });
  const remove = attempt(() => removeSetup(draft, back.act));
  const element = h(
    "div",
    { class: "trial-form camera-setup" },
    h("button", { type: "button", class: "link", text: back.text, on: { click: leave } }),
    h("label", {}, h("span", { text: "Setup" }), nameField(draft)),
    stateLine(draft),
    sizeNote(draft, stage),
    ...tabs.elements,
    h(
      "div",
      { class: "run-files" },
      h("a", { href: setupApi.exportPath(answer.id), download: "", text: "As a file", title: FILE_HELP }),
      h("button", {
        type: "button",
        class: "link",
        text: "Delete",
        "aria-label": "Delete this setup",
        on: { click: remove },
      }),
      h("button", { type: "button", class: "primary", text: "Done", on: { click: leave } }),
    ),
  );
  page.show(element, () => stage.close());
  tabs.open(firstPart(answer));
}

/** Whether two setups are equal. */
const same = (one, other) => JSON.stringify(one) === JSON.stringify(other);

/** Shows a setup as somebody else has changed it meanwhile; other refusals are said as they are. */
async function conflict(store, error) {
  if (error.status !== CONFLICT) throw error;
  const now = await setupApi.read(store.state.id);
  store.set({ setup: now.setup, answer: now, revision: now.revision, kept: true });
  toast(
    `Somebody changed the setup “${now.setup.name}” on another page. You now see the new version. `
      + "Make your last change again.",
    { tone: "bad", of: "studio" },
  );
}

/** Takes over what the server says of a setup that was sent to it. */
function take(store, answer, requested) {
  store.set({
    answer,
    revision: answer.revision || store.state.revision,
    kept: Boolean(answer.id) && same(requested, store.state.setup),
  });
}

/** Sends the setup until the newest one is kept or refused; `settled` resolves when nothing is on its way. */
function setupKeeper(store) {
  let [working, settled] = [false, []];
  return {
    isWorking: () => working,
    async keep() {
      if (working) return;
      working = true;
      let refused = null;
      while (!store.state.kept && !same(refused, store.state.setup)) {
        const { id, revision, setup } = store.state;
        try {
          take(store, await setupApi.change(id, revision, setup), setup);
        } catch (error) {
          refused = setup;
          await conflict(store, error).catch((other) => {
            store.set({ trouble: other.message });
            report(other);
          });
        }
      }
      working = false;
      settled.splice(0).forEach((act) => act());
    },
    settled: () =>
      working
        ? new Promise((resolve) => {
            settled.push(resolve);
          })
        : Promise.resolve(),
  };
}

/** Asks what the server says of a setup that is not kept yet; only of the newest. */
function setupChecker(store, isKeeping) {
  let checking = false;
  return async () => {
    if (checking) return;
    checking = true;
    let requested = null;
    while (!isKeeping() && !store.state.kept && requested !== store.state.setup) {
      requested = store.state.setup;
      try {
        take(store, await setupApi.check(requested), requested);
      } catch {
        break;
      }
    }
    checking = false;
  };
}

/**
 * Begins with a setup as the server sent it.
 * @param {Record<string, any>} first with `id`, `revision` and `setup`
 * @returns {Record<string, any>} `state` and `watch` as of a store: `setup` as it is on the page, `answer`
 *   what the server says of it, `kept` whether that is of this very setup, `trouble` why it could not be
 *   kept; `change(patch, last)`, where `last` is false while a finger drags and nothing is kept; `check()`
 *   asks what the server says meanwhile; `settled()` resolves when all is kept
 */
function setupDraft(first) {
  const store = watchable({
    id: first.id,
    revision: first.revision,
    setup: first.setup,
    answer: first,
    kept: true,
    trouble: null,
  });
  const { keep, settled, isWorking } = setupKeeper(store);
  return {
    get state() {
      return store.state;
    },
    watch: store.watch,
    change(patch, last = true) {
      const setup = { ...store.state.setup, ...patch };
      if (same(setup, store.state.setup) && (store.state.kept || !last)) return;
      store.set({ setup, kept: false, trouble: null });
      if (last) keep();
    },
    check: setupChecker(store, isWorking),
    settled,
  };
}
