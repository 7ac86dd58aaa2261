/** The dialog Atlases: makes an atlas or goes on with one, and leads to the maps and tables of those that are there. */

import { ApiError } from "../api/gaits.js";
import { atlasApi } from "../api/atlases.js";
import { dialogFrame, openDialog } from "../lib/dialogs.js";
import { h, setAllowed, setText } from "../lib/dom.js";
import { refusalOf, wholeNumber } from "../lib/field_error.js";
import { fixed } from "../lib/format.js";
import { attempt, toast } from "../lib/toasts.js";
import { jobIsOn } from "../shell/job_list.js";
import { robotOptions, robots } from "../shell/robots.js";

const PURPOSE = "An atlas shows what a robot can do. The studio draws thousands of gaits, with other foot "
  + "orders, steps, turns and stability margins, and solves and checks each of them. "
  + "The map of an atlas shows which of them are fast and which are stable.";
const COST = "The studio evaluates about 40 gaits a second in the background. You can go on working.";
const [USUAL, MOST] = [10000, 1000000];
const HEADS = ["Atlas", "Gaits", "Solved", "Fastest", "", ""];
const count = (number) => number.toLocaleString("en");

function addStyles() {
  const href = new URL("./atlases.css", import.meta.url).pathname;
  if (!document.querySelector(`link[href="${href}"]`)) document.head.append(h("link", { rel: "stylesheet", href }));
}

const link = (text, href, label, more = {}) => h("a", { href, text, "aria-label": label, ...more });

/** An atlas as a row of the table. */
function tableRow(atlas, { isBusy, pick, erase }) {
  const { name, trouble } = atlas;
  const remove = h("button", {
    type: "button", class: "link", text: "Delete", "aria-label": `Delete ${name}`, on: { click: () => erase(name) },
  });
  const why = atlas.included ? "This atlas comes with the program" : "Cancel its job first";
  setAllowed(remove, atlas.included || isBusy ? why : null, "Removes this atlas from the list. Undo brings it back");
  if (trouble) {
    return h("tr", {}, h("td", { text: name }), h("td", { colspan: 4, class: "why", text: trouble }), h("td", {}, remove));
  }
  const title = atlas.included ? h("span", { text: name, title: "This atlas comes with the program" }) : h("button", {
    type: "button", class: "link", text: name, title: "Go on with this atlas", on: { click: () => pick(atlas) },
  });
  const files = h("td", { class: "atlas-files" },
    link("Map", atlasApi.mapAddress(name), `Map of ${name}`, { target: "_blank", rel: "noopener", title: "Opens the map in a new tab" }),
    link("HTML", atlasApi.fileAddress(name, "html"), `${name} as HTML`, { download: "", title: "The map as a file that needs no studio" }),
    link("CSV", atlasApi.fileAddress(name, "csv"), `${name} as CSV`, { download: "", title: "All gaits as a table" }));
  const fastest = atlas.fastest === null ? "–" : `${fixed(atlas.fastest * 1000, 2)} mm/s`;
  const numbers = [count(atlas.gaits), count(atlas.solved), fastest];
  return h("tr", {}, h("td", {}, title), ...numbers.map((text) => h("td", { class: "number", text })), files, h("td", {}, remove));
}

/** The list of atlases. */
function atlasTable(store, { pick, changed }) {
  const body = h("tbody");
  const element = h("table", { class: "atlas-table", "aria-label": "Atlases", hidden: true },
    h("thead", {}, h("tr", {}, ...HEADS.map((text, place) => h(text ? "th" : "td", { class: [1, 2, 3].includes(place) ? "number" : null, text })))), body);
  const erase = attempt(async (name) => {
    await atlasApi.erase(name);
    await show();
    const undo = attempt(async () => { await atlasApi.restore(name); await show(); });
    toast(`The atlas “${name}” is deleted.`, { action: { label: "Undo", act: undo } });
  });
  async function show() {
    const { atlases } = await atlasApi.list();
    const busy = store.state.jobs.filter((job) => job.kind === "atlas" && jobIsOn(job)).map((job) => job.atlas);
    body.replaceChildren(...atlases.map((atlas) => tableRow(atlas, { isBusy: busy.includes(atlas.name), pick, erase })));
    element.hidden = !atlases.length;
    changed(atlases);
  }
  return { element: h("div", { class: "atlas-list" }, element), show: attempt(show) };
}

function labelled(label, control, help, refusal) {
  return h("label", { class: "new-row", title: help }, h("span", { class: "name", text: label }), control, refusal?.element);
}

function form(store, list, close) {
  const robot = h("select", { "aria-label": "Robot of the atlas" }, ...robotOptions(list.filter(({ legs }) => legs >= 4)));
  const name = h("input", { "aria-label": "Name of the atlas", maxlength: "60", autocomplete: "off" });
  const gaits = h("input", { type: "number", "aria-label": "Gaits", min: 1, max: MOST, step: 1, value: USUAL });
  const [nameRefusal, gaitsRefusal] = [refusalOf(name), refusalOf(gaits)];
  const refused = h("p", { class: "why", role: "alert" });
  const make = h("button", { type: "submit", class: "primary", text: "Make" });
  let [known, isNamed] = [[], false];

  const same = () => known.find((atlas) => atlas.name === name.value.trim() && !atlas.trouble && !atlas.included);
  const follow = () => {
    if (!isNamed) name.value = robot.value;
    setText(make, same() ? "Go on" : "Make");
    setAllowed(make, store.state.jobs.some((job) => job.kind === "atlas" && jobIsOn(job))
      ? "An atlas is being made. Wait for it, or cancel it in Jobs" : null);
  };
  const pick = (atlas) => {
    isNamed = true;
    [robot.value, name.value] = [atlas.robot, atlas.name];
    gaits.value = Math.min(MOST, Math.max(USUAL, atlas.gaits * 2));
    setText(refused, "");
    follow();
    gaits.focus();
  };
  const table = atlasTable(store, { pick, changed: (atlases) => { known = atlases; follow(); } });

  robot.addEventListener("change", follow);
  name.addEventListener("input", () => { isNamed = true; nameRefusal.setError(null); follow(); });
  gaits.addEventListener("input", () => gaitsRefusal.setError(null));

  async function accept() {
    const words = name.value.trim();
    const { value, sentence = null } = wholeNumber(gaits, "Gaits", { min: 1, max: MOST });
    nameRefusal.setError(words ? null : "Give the atlas a name.");
    gaitsRefusal.setError(sentence);
    if (!words || sentence) return (words ? gaits : name).focus();
    if (make.disabled) return undefined;
    make.disabled = true;
    try {
      const isSame = same()?.robot === robot.value;
      close(await atlasApi.make({ name: words, count: value, robot: isSame ? null : robot.value }));
    } catch (error) {
      if (!(error instanceof ApiError)) throw error;
      setText(refused, error.message);
    } finally {
      make.disabled = false;
      follow();
    }
    return undefined;
  }

  const fields = h("div", { class: "atlas-fields" },
    labelled("Robot", robot, "The robot whose gaits are evaluated"),
    labelled("Name", name, "The name of the atlas. With the name of one in the list, its run goes on", nameRefusal),
    labelled("Gaits", gaits, `How many gaits the atlas is to have (1 to ${count(MOST)})`, gaitsRefusal));
  const buttons = h("div", { class: "buttons" }, h("button", { type: "button", text: "Close", on: { click: () => close(null) } }), make);
  return {
    content: [h("p", { class: "quiet", text: PURPOSE }), fields, h("p", { class: "quiet", text: COST }), refused, buttons, table.element],
    accept,
    /** Reads the list, and picks an atlas of it. */
    async open(wanted) {
      follow();
      await table.show();
      const atlas = known.find((one) => one.name === wanted && !one.trouble && !one.included);
      if (atlas) pick(atlas);
    },
    refresh: table.show,
  };
}

/** Tells jobs of atlases apart by what changes the list. */
const stateOf = ({ jobs }) => jobs.filter(({ kind }) => kind === "atlas").map(({ id, state }) => `${id} ${state}`).join();

let isOpen = false;

/**
 * Opens the dialog.
 * @param {object} store
 * @param {string|null} wanted name of the atlas that is picked
 * @returns {Promise<object|null>} the job that was started
 */
export async function askAtlas(store, wanted = null) {
  if (isOpen) return null;
  isOpen = true;
  let unwatch = () => {};
  try {
    addStyles();
    const list = await robots();
    let parts = null;
    return await openDialog((close) => {
      parts = form(store, list, close);
      const dialog = dialogFrame("Atlases", close, parts.accept, ...parts.content);
      dialog.classList.add("atlases");
      dialog.querySelector("form").noValidate = true;
      return dialog;
    }, () => {
      parts.open(wanted);
      unwatch = store.watch((state) => [stateOf(state)], parts.refresh);
    });
  } finally {
    isOpen = false;
    unwatch();
  }
}
