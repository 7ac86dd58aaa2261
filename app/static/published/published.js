/** Published experiments: the list of tables, and the chosen table with our figures beside the printed. */

import { publishedApi } from "../api/published.js";
import { byId, h, icon } from "../lib/dom.js";
import { latestOnly } from "../lib/latest_only.js";
import { recalled, remember } from "../lib/remembered.js";
import { attempt, report } from "../lib/toasts.js";
import { closeOverStage, drawerIsOpen, openDrawer } from "../shell/drawers.js";
import { selectGait } from "../shell/gait_list.js";
import { runIsOn } from "../state/store.js";
import { openStep } from "../steps/steps.js";
import { referenceField } from "./reference_field.js";
import { tableList } from "./table_list.js";
import { tablePage } from "./table_page.js";

const KEY = "published";
const CHOICE = { table: "", row: "" };
const PURPOSE =
  "The tables of the thesis (T) and of the paper (P). Each figure has ours beside it, from the same gait.";

const CHOOSE =
  "Choose a table. Its figures are shown beside ours. Each row opens, simulates or sends its gait.";

function addStyles() {
  const address = new URL("published.css", import.meta.url).pathname;
  document.head.append(h("link", { rel: "stylesheet", href: address }));
}

/** The drawer's own elements. */
function drawerParts(list, reference) {
  const close = h(
    "button",
    {
      class: "plain icon-only",
      "aria-label": "Close published experiments",
      title: "Close (Esc)",
      on: { click: () => openDrawer(null) },
    },
    icon("close"),
  );
  const place = h("div", { class: "published-place" });
  const tables = h(
    "div",
    { class: "published-tables" },
    h("p", { class: "quiet", text: PURPOSE }),
    list.element,
    reference.element,
  );
  const body = h("div", { class: "published", data: { arrows: "" } }, tables, place);
  byId("drawer-published").append(h("header", {}, h("h2", { text: "Published experiments" }), close), body);
  return { body, place };
}

/** Opens the gait of a row, and goes on with it in a step. */
const openGait = (store, chosen) =>
  attempt(async (row, source, step) => {
    const { id } = await publishedApi.open(chosen.table, row, source);
    await selectGait(store, id);
    openDrawer("gaits");
    closeOverStage();
    openStep(step);
    if (step === "simulate") store.set({ simulateWanted: id });
  });

/** Shows the chosen table in its place; a page with the same columns and rows stays and is filled anew. */
function tablePlace({ body, place }, acts) {
  /** @type {ReturnType<typeof tablePage>|null} */
  let page = null;
  return (content, row) => {
    body.toggleAttribute("data-chosen", content !== null);
    if (!content) {
      page = null;
      place.replaceChildren(h("p", { class: "quiet", text: CHOOSE }));
      return;
    }
    if (!page?.fits(content)) {
      page = tablePage(content, acts);
      place.replaceChildren(page.element);
      place.scrollTop = 0;
    }
    page.show(content, row);
  };
}

/**
 * Builds the panel, closed.
 * @param {import("../state/store.js").Store} store
 * @returns {{open: () => void}} `open` reads the tables again
 */
export function mountPublished(store) {
  addStyles();
  const chosen = recalled(KEY, CHOICE);
  const list = tableList((id) => choose({ table: id, row: "" }));
  const reference = referenceField(() => refresh());
  const parts = drawerParts(list, reference);
  let content = null;

  function choose(choice) {
    Object.assign(chosen, choice);
    remember(KEY, chosen);
    refresh();
  }

  /** Opens a row, or closes it where it is open. */
  function toggle(row) {
    chosen.row = chosen.row === row ? "" : row;
    remember(KEY, chosen);
    show();
  }

  const acts = {
    back: () => choose({ table: "", row: "" }),
    toggle,
    open: openGait(store, chosen),
    changed: () => refresh(),
  };
  const placeTable = tablePlace(parts, acts);

  const show = () => placeTable(content, chosen.row);
  const read = latestOnly(async () => {
    if (!drawerIsOpen(KEY)) return;
    try {
      const { tables, reference: folder } = await publishedApi.list();
      list.show(tables, chosen.table);
      reference.show(folder);
      const { table } = chosen;
      const found = tables.some(({ id }) => id === table) ? await publishedApi.table(table) : null;
      if (table !== chosen.table) return;
      content = found;
      show();
      if (found?.state === "none" && !runIsOn(store.state.robot)) await publishedApi.compute(table);
    } catch (error) {
      report(error);
    }
  });
  const refresh = () => read(null);

  store.watch(
    ({ publishedChanged, connected }) => [publishedChanged, connected],
    ({ connected }) => {
      if (connected) refresh();
    },
  );
  return { open: refresh };
}
