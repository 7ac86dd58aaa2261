/** The field for the folder with the published data: its path, its content, and the reason of a refusal. */

import { publishedApi } from "../api/published.js";
import { h, setText } from "../lib/dom.js";
import { refusalOf } from "../lib/field_error.js";
import { announce } from "../lib/toasts.js";

const CONTENT =
  "The folder holds simulation_manual, simulation_optimised, trajectories and robot_trials. "
  + "With it, the tables also have the published motions in our physics "
  + "and the published tracks by our definitions.";

/**
 * Builds the field.
 * @param {(list: Record<string, any>) => void} changed gets the answer of the studio
 * @returns {{element: HTMLElement, show: (reference: {folder: string, sentence: string}) => void}}
 */
export function referenceField(changed) {
  const input = h("input", {
    type: "text",
    "aria-label": "Folder with the published data",
    placeholder: "/home/…/reference",
    autocomplete: "off",
    spellcheck: "false",
  });
  const refusal = refusalOf(input);
  const use = h("button", { type: "submit", text: "Use folder" });
  const forget = h("button", { type: "button", class: "link", text: "Forget", hidden: true });
  forget.title = "Shows the tables without the published data. The folder stays as it is";
  const known = h("p", { class: "quiet", role: "status", "aria-label": "Published data" });
  let kept = "";

  function show({ folder, sentence }) {
    if (input.value === kept) input.value = folder;
    kept = folder;
    forget.hidden = !folder;
    setText(known, folder && !sentence ? "The published data are in use." : "");
    refusal.setError(sentence || null);
  }

  async function set(folder) {
    use.disabled = true;
    try {
      const list = await publishedApi.setReference(folder);
      input.value = kept = list.reference.folder;
      show(list.reference);
      announce(folder ? "The published data are in use." : "The folder is forgotten.");
      changed(list);
    } catch (error) {
      refusal.setError(error.message);
    } finally {
      use.disabled = false;
    }
  }

  const submit = (event) => {
    event.preventDefault();
    const folder = input.value.trim();
    if (folder) set(folder);
    else refusal.setError("Type the path of the folder, as the computer of the studio names it.");
  };
  forget.addEventListener("click", () => set(""));
  const element = h(
    "form",
    { class: "published-reference", on: { submit } },
    h("label", {}, h("span", { text: "Folder with the published data" }), input),
    refusal.element,
    h("div", { class: "buttons" }, use, forget),
    known,
    h("p", { class: "quiet", text: CONTENT }),
  );
  return { element, show };
}
