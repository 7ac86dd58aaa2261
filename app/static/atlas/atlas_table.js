/** The table of atlases: what each has, its map and files, and Delete with Undo. */

import { atlasApi } from "../api/atlases.js";
import { h, onPress, setAllowed } from "../lib/dom.js";
import { fixed } from "../lib/format.js";
import { latestOnly } from "../lib/latest_only.js";
import { attempt, report, toast } from "../lib/toasts.js";
import { jobIsOn } from "../shell/job_list.js";

const HEADS = ["Atlas", "Gaits", "Solved", "Fastest", "", ""];
const NEW_TAB = { target: "_blank", rel: "noopener" };
const NUMBERS = [1, 2, 3];
const DELETE_HELP = "Removes this atlas from the list. Undo restores the atlas";

/** A whole number with its thousands apart. */
export const count = (number) => number.toLocaleString("en");

function link(text, href, label, title, more) {
  return h("a", { href, text, "aria-label": label, title, ...more });
}

function deleteButton({ name, included }, isBusy, erase) {
  const label = `Delete ${name}`;
  const button = h("button", { type: "button", class: "link", text: "Delete", "aria-label": label });
  const why = included
    ? "You cannot delete this atlas, because it comes with the program"
    : "A job is making this atlas. Cancel the job before you delete the atlas";
  setAllowed(button, included || isBusy ? why : null, DELETE_HELP);
  onPress(
    button,
    () => erase(name),
    (reason) => toast(`${reason}.`),
  );
  return button;
}

function titleOf({ name, included }, pick) {
  if (included) return h("span", { text: name, title: "This atlas comes with the program" });
  const title = "Chooses this atlas, so that you can add gaits to it";
  return h("button", { type: "button", class: "link", text: name, title, on: { click: pick } });
}

function files(name) {
  const [html, csv] = ["html", "csv"].map((form) => atlasApi.fileAddress(name, form));
  return h(
    "td",
    { class: "atlas-files" },
    link(
      "Map",
      atlasApi.mapAddress(name),
      `Map of ${name}`,
      "Opens the map of this atlas in a new tab",
      NEW_TAB,
    ),
    link(
      "HTML",
      html,
      `${name} as HTML`,
      "Downloads the map as a web page. The page opens without the studio",
      { download: "" },
    ),
    link("CSV", csv, `${name} as CSV`, "Downloads all gaits of this atlas as a table", { download: "" }),
  );
}

function tableRow(atlas, isBusy, { pick, erase }) {
  const remove = h("td", {}, deleteButton(atlas, isBusy, erase));
  if (atlas.trouble) {
    const why = h("td", { colspan: 4, class: "why", text: atlas.trouble });
    return h("tr", {}, h("td", { text: atlas.name }), why, remove);
  }
  const fastest = atlas.fastest === null ? "–" : `${fixed(atlas.fastest * 1000, 2)} mm/s`;
  const numbers = [count(atlas.gaits), count(atlas.solved), fastest];
  return h(
    "tr",
    {},
    h(
      "td",
      {},
      titleOf(atlas, () => pick(atlas)),
    ),
    ...numbers.map((text) => h("td", { class: "number", text })),
    files(atlas.name),
    remove,
  );
}

function head() {
  const classOf = (place) => (NUMBERS.includes(place) ? "number" : null);
  const cells = HEADS.map((text, place) => h(text ? "th" : "td", { class: classOf(place), text }));
  return h("thead", {}, h("tr", {}, ...cells));
}

/**
 * Builds the table.
 * @param {import("../state/store.js").Store} store
 * @param {{pick: (atlas: Record<string, any>) => void, changed: (atlases: Record<string, any>[]) => void}}
 *   acts
 * @returns {{element: HTMLElement, show: () => void}} `show` reads the list anew
 */
export function atlasTable(store, { pick, changed }) {
  const body = h("tbody");
  const table = h("table", { class: "atlas-table", "aria-label": "Atlases", hidden: true }, head(), body);
  const erase = attempt(async (name) => {
    await atlasApi.erase(name);
    show();
    const undo = attempt(async () => {
      await atlasApi.restore(name);
      show();
    });
    toast(`The atlas “${name}” is deleted.`, { action: { label: "Undo", act: undo } });
  });
  const read = latestOnly(async () => {
    try {
      const { atlases } = await atlasApi.list();
      const on = store.state.jobs.filter((job) => job.kind === "atlas" && jobIsOn(job));
      const busy = on.map((job) => job.atlas);
      const rows = atlases.map((atlas) => tableRow(atlas, busy.includes(atlas.name), { pick, erase }));
      body.replaceChildren(...rows);
      table.hidden = !atlases.length;
      changed(atlases);
    } catch (error) {
      report(error);
    }
  });
  const show = () => read(null);
  return { element: h("div", { class: "atlas-list" }, table), show };
}
