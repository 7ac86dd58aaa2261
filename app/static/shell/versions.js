/** The versions of a gait: when, why and by whom, what is different now, and the way back. */

import { api } from "../api/gaits.js";
import { dialogFrame, openDialog } from "../lib/dialogs.js";
import { sentences } from "../lib/difference.js";
import { byId, h, onPress, setAllowed, setAttribute } from "../lib/dom.js";
import { clockTime } from "../lib/format.js";
import { ticket } from "../lib/latest_only.js";
import { announce, attempt, toast } from "../lib/toasts.js";

const TEXTS = {
  saved: "Saved",
  named: "Named",
  approved: "Approved",
  automatic: "While editing",
  "before restore": "Before a restore",
  "before delete": "Before deleting",
};
const titleOf = (version) => version.name || TEXTS[version.kind];

/** One version in the list. */
function option(version, choose) {
  const detail = [
    version.name ? TEXTS[version.kind].toLowerCase() : null,
    version.by ? `by ${version.by}` : null,
    version.present ? "as now" : null,
    version.problem ? "cannot be shown" : null,
  ]
    .filter(Boolean)
    .join(", ");
  const when = clockTime(version.made);
  return h(
    "li",
    {
      role: "option",
      id: `version-${version.number}`,
      "aria-selected": "false",
      "aria-label": [`Version ${version.number}`, titleOf(version), when, detail].filter(Boolean).join(", "),
      on: { click: () => choose(version.number) },
    },
    h(
      "span",
      { class: "version-title" },
      h("span", { class: "number quiet", text: String(version.number) }),
      h("b", { text: titleOf(version) }),
    ),
    h("span", { class: "version-when quiet", text: [when, detail].filter(Boolean).join(" · ") }),
  );
}

function parts(id) {
  const list = h("ul", {
    class: "version-list",
    role: "listbox",
    tabindex: "0",
    "aria-label": "Versions",
    data: { arrows: "" },
  });
  const difference = h("div", {
    class: "version-difference",
    role: "region",
    "aria-label": "Difference",
    tabindex: "0",
  });
  const help = "Choose the state that the selected version is compared with";
  const against = h("select", { "aria-label": "Compared with", title: help });
  const restore = h("button", { type: "button", class: "primary", text: "Restore" });
  const name = h("input", {
    "aria-label": "Name of this state",
    placeholder: "Name for the present state",
    maxlength: "80",
    autocomplete: "off",
  });
  return { id, list, difference, against, restore, name, heading: h("h4", {}) };
}

/** Shows that there is no version. */
function showNone({ list, restore, difference }) {
  list.removeAttribute("aria-activedescendant");
  setAllowed(restore, "There is no version yet.");
  const none =
    "There is no version yet. "
    + "The studio makes a version when you save the gait, approve it or name its state. "
    + "While you edit, it also makes a version every two minutes.";
  difference.replaceChildren(h("p", { class: "quiet", text: none }));
}

/** Shows the versions in the list and in the field that compares; what the field had stays. */
function fill({ list, against }, versions, choose) {
  list.replaceChildren(...versions.map((version) => option(version, choose)));
  const kept = against.value;
  against.replaceChildren(
    h("option", { value: "", text: "the present state" }),
    ...versions.map((version) =>
      h("option", { value: version.number, text: `version ${version.number}, ${titleOf(version)}` }),
    ),
  );
  against.value = versions.some(({ number }) => String(number) === kept) ? kept : "";
}

/** Shows which version is chosen, and offers to restore it. */
function markChosen({ list, restore }, { number, present, problem }) {
  for (const item of list.children)
    setAttribute(item, "aria-selected", String(item.id === `version-${number}`));
  list.setAttribute("aria-activedescendant", `version-${number}`);
  byId(`version-${number}`)?.scrollIntoView({ block: "nearest" });
  const same = present ? "The gait is already the same as this version." : null;
  setAllowed(restore, problem ?? same, `Restore version ${number}. Undo brings back the present state`);
}

/** Fills an open panel and keeps it current. */
function panel(edits, ui) {
  let versions = [];
  let chosen = null;
  const [beginDifference, beginRefresh] = [ticket(), ticket()];
  const place = (number) => versions.findIndex((one) => one.number === number);

  const showDifference = attempt(async () => {
    const isOld = beginDifference();
    const { problem } = versions[place(chosen)];
    if (problem) {
      ui.difference.replaceChildren(h("p", { text: problem }));
      return;
    }
    const to = ui.against.value ? Number(ui.against.value) : null;
    const { groups } = await api.difference(ui.id, chosen, to);
    if (isOld()) return;
    ui.heading.textContent =
      to === null ? `Changes since version ${chosen}` : `Changes from version ${chosen} to version ${to}`;
    ui.difference.replaceChildren(ui.heading, ...sentences(groups));
  });

  function choose(number) {
    chosen = number;
    markChosen(ui, versions[place(number)]);
    return showDifference();
  }

  async function refresh() {
    const isOld = beginRefresh();
    const found = await api.versions(ui.id);
    if (isOld()) return undefined;
    ({ versions } = found);
    fill(ui, versions, choose);
    if (!versions.length) return showNone(ui);
    return choose(place(chosen) >= 0 ? chosen : versions[0].number);
  }

  function roam(event) {
    const at = place(chosen);
    const to = { ArrowDown: at + 1, ArrowUp: at - 1, Home: 0, End: versions.length - 1 }[event.key];
    if (to === undefined) return;
    event.preventDefault();
    event.stopPropagation();
    if (versions[to]) choose(versions[to].number);
  }

  const restore = attempt(async () => {
    await edits.restoreVersion(chosen);
    toast(`Version ${chosen} is restored. Undo brings back the state before the restore.`);
    announce(`Version ${chosen} restored.`);
    ui.list.focus();
  });
  const keep = attempt(async () => {
    const name = ui.name.value.trim();
    if (!name) return ui.name.focus();
    const version = await api.nameVersion(ui.id, name);
    ui.name.value = "";
    chosen = version.number;
    return refresh();
  });

  ui.list.addEventListener("keydown", roam);
  ui.against.addEventListener("change", showDifference);
  onPress(ui.restore, restore);
  return { refresh: attempt(refresh), keep };
}

/** Wires the button in the top bar; the panel follows the gait while it is open. */
export function mountVersions(store, edits) {
  const button = byId("versions");
  let open = null;

  function show() {
    const { view } = store.state;
    const ui = parts(view.id);
    const behaviour = panel(edits, ui);
    openDialog((close) => {
      const frame = dialogFrame(
        `Versions of ${view.name}`,
        close,
        behaviour.keep,
        h("p", { class: "quiet", text: "A version is an earlier state of the gait that you can restore." }),
        h(
          "div",
          { class: "version-columns" },
          ui.list,
          h(
            "div",
            { class: "version-side" },
            h("label", { class: "version-against quiet" }, "Compared with ", ui.against),
            ui.difference,
          ),
        ),
        h(
          "div",
          { class: "version-name" },
          ui.name,
          h("button", { type: "submit", text: "Name this state" }),
        ),
        h(
          "div",
          { class: "buttons" },
          h("button", { type: "button", text: "Close", on: { click: () => close(null) } }),
          ui.restore,
        ),
      );
      frame.classList.add("versions");
      open = { element: frame, ...behaviour, id: view.id, close };
      return frame;
    });
    open.refresh().then(() => ui.list.focus());
  }

  onPress(button, show);
  store.watch(
    ({ view }) => [view?.id, view?.revision, view?.version, view?.stamp],
    ({ view }) => {
      const help = "Compare and restore earlier states of this gait";
      setAllowed(button, view ? null : "No gait is selected.", help);
      if (!open?.element.isConnected || !view) return;
      if (open.id === view.id) open.refresh();
      else open.close(null);
    },
  );
}
