/** The dialog Atlases: makes an atlas or goes on with one, and leads to the maps and tables of all. */

import { ApiError } from "../api/gaits.js";
import { atlasApi } from "../api/atlases.js";
import { dialogFrame, openDialog } from "../lib/dialogs.js";
import { h, setAllowed, setText } from "../lib/dom.js";
import { refusalOf, wholeNumber } from "../lib/field_error.js";
import { jobIsOn } from "../shell/job_list.js";
import { robotOptions, robots } from "../shell/robots.js";
import { atlasTable, count } from "./atlas_table.js";

const PURPOSE =
  "An atlas shows what a robot can do. The studio makes thousands of gaits with different "
  + "foot orders, steps, turns and stability margins. The studio solves and checks each gait. "
  + "The map of an atlas shows which gaits are fast and which gaits are stable.";
const COST = "The studio evaluates about 40 gaits a second in the background. You can go on working.";
const BUSY = "An atlas is being made. Wait until its job ends, or cancel the job in Jobs";
const NAME_HELP = "The name of the atlas. To add gaits to an atlas of the list, type the name of that atlas";
const [USUAL, MOST] = [10000, 1000000];

function addStyles() {
  const href = new URL("./atlases.css", import.meta.url).pathname;
  if (document.querySelector(`link[href="${href}"]`)) return;
  document.head.append(h("link", { rel: "stylesheet", href }));
}

function labelled(label, control, help, refusal) {
  return h(
    "label",
    { class: "new-row", title: help },
    h("span", { class: "name", text: label }),
    control,
    refusal?.element,
  );
}

/** Robot, name and number of gaits; the name follows the robot until a person types one. */
function fields(list, changed) {
  const usable = list.filter(({ legs }) => legs >= 4);
  const robot = h("select", { "aria-label": "Robot of the atlas" }, ...robotOptions(usable));
  const name = h("input", { "aria-label": "Name of the atlas", maxlength: "60", autocomplete: "off" });
  const limits = { type: "number", min: 1, max: MOST, step: 1 };
  const gaits = h("input", { ...limits, "aria-label": "Gaits", value: USUAL });
  const [nameRefusal, gaitsRefusal] = [refusalOf(name), refusalOf(gaits)];
  let isNamed = false;
  const follow = () => {
    if (!isNamed) name.value = robot.value;
    changed();
  };
  robot.addEventListener("change", follow);
  name.addEventListener("input", () => {
    isNamed = true;
    nameRefusal.setError(null);
    changed();
  });
  gaits.addEventListener("input", () => gaitsRefusal.setError(null));
  return {
    element: h(
      "div",
      { class: "atlas-fields" },
      labelled("Robot", robot, "The studio evaluates gaits of this robot"),
      labelled("Name", name, NAME_HELP, nameRefusal),
      labelled("Gaits", gaits, `Number of gaits in the atlas (1 to ${count(MOST)})`, gaitsRefusal),
    ),
    robot: () => robot.value,
    name: () => name.value.trim(),
    follow,
    /** Takes the atlas of the list that is to go on. */
    pick(atlas) {
      isNamed = true;
      [robot.value, name.value] = [atlas.robot, atlas.name];
      gaits.value = String(Math.min(MOST, Math.max(USUAL, atlas.gaits * 2)));
      gaits.focus();
    },
    /** Name and number; null where one of them is wrong, which then says so. */
    values() {
      const words = name.value.trim();
      const { value, sentence = null } = wholeNumber(gaits, "Gaits", { min: 1, max: MOST });
      nameRefusal.setError(words ? null : "Give the atlas a name.");
      gaitsRefusal.setError(sentence);
      if (words && !sentence) return { name: words, count: value };
      (words ? gaits : name).focus();
      return null;
    },
  };
}

function form(store, list, close) {
  const refused = h("p", { class: "why", role: "alert" });
  const make = h("button", { type: "submit", class: "primary", text: "Make" });
  let [known, wanted, isSent] = [[], null, false];
  const isOn = () => store.state.jobs.some((job) => job.kind === "atlas" && jobIsOn(job));
  const own = (name) => known.find((atlas) => atlas.name === name && !atlas.trouble && !atlas.included);
  const follow = () => {
    setText(make, own(asked.name()) ? "Go on" : "Make");
    setAllowed(make, isOn() ? BUSY : null);
  };
  const asked = fields(list, follow);
  const pick = (atlas) => {
    asked.pick(atlas);
    setText(refused, "");
    follow();
  };
  const changed = (atlases) => {
    known = atlases;
    if (own(wanted)) pick(own(wanted));
    wanted = null;
    follow();
  };
  const table = atlasTable(store, { pick, changed });

  async function accept() {
    const values = asked.values();
    if (!values || isSent) return;
    if (isOn()) {
      setText(refused, `${BUSY}.`);
      return;
    }
    isSent = true;
    try {
      const isSame = own(values.name)?.robot === asked.robot();
      close(await atlasApi.make({ ...values, robot: isSame ? null : asked.robot() }));
    } catch (error) {
      if (!(error instanceof ApiError)) throw error;
      setText(refused, error.message);
    } finally {
      isSent = false;
    }
  }

  const cancel = h("button", { type: "button", text: "Close", on: { click: () => close(null) } });
  return {
    content: [
      h("p", { class: "quiet", text: PURPOSE }),
      asked.element,
      h("p", { class: "quiet", text: COST }),
      refused,
      h("div", { class: "buttons" }, cancel, make),
      table.element,
    ],
    accept,
    /** Picks an atlas once the list is there. */
    want: (name) => {
      wanted = name;
      asked.follow();
    },
    refresh: table.show,
  };
}

/** Tells states of the list of jobs apart by which the list of atlases changes. */
function stateOf({ jobs }) {
  return jobs
    .filter(({ kind }) => kind === "atlas")
    .map(({ id, state }) => `${id} ${state}`)
    .join();
}

let isOpen = false;

/**
 * Opens the dialog.
 * @param {import("../state/store.js").Store} store
 * @param {string|null} wanted name of the atlas that is picked
 * @returns {Promise<Record<string, any>|null>} the job that was started
 */
export async function askAtlas(store, wanted = null) {
  if (isOpen) return null;
  isOpen = true;
  let unwatch = () => {};
  try {
    addStyles();
    const list = await robots();
    let parts = null;
    return await openDialog(
      (close) => {
        let dialog = null;
        const closeOpen = (value) => {
          if (dialog.isConnected) close(value);
        };
        parts = form(store, list, closeOpen);
        dialog = dialogFrame("Atlases", closeOpen, parts.accept, ...parts.content);
        dialog.classList.add("atlases");
        dialog.querySelector("form").noValidate = true;
        return dialog;
      },
      () => {
        parts.want(wanted);
        unwatch = store.watch((state) => [stateOf(state)], parts.refresh);
      },
    );
  } finally {
    isOpen = false;
    unwatch();
  }
}
