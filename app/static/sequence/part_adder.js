/** The list of gaits from which parts are added to a sequence. */

import { api } from "../api/gaits.js";
import { added, isSequence } from "../document/sequence_edits.js";
import { h } from "../lib/dom.js";
import { attempt } from "../lib/toasts.js";

/** Why a gait of the list cannot be added to a sequence for a robot; null where it can. */
function whyNot({ part_refusal: refusal, robot: own }, robot) {
  return refusal ?? (robot && own !== robot ? `made for the robot ${own}` : null);
}

function choice(line, robot) {
  const why = whyNot(line, robot);
  const { id, name } = line;
  return h("option", { value: id, text: why ? `${name} (${why})` : name, disabled: Boolean(why) });
}

/**
 * A list of all gaits by group, and the button that adds the chosen one; over the parts, so that it stays
 * in place.
 * @param {import("../state/store.js").Store} store
 * @param {import("../state/edits.js").Edits} edits
 * @returns {HTMLElement}
 */
export function partAdder(store, edits) {
  const help =
    "Choose the gait to add. If you add a sequence, all parts of the sequence are added. "
    + "If a gait cannot be added, the list shows the reason.";
  const select = h("select", { "aria-label": "Gait to add", title: help });
  const act = attempt(async () => {
    const [source, { selected: gait }] = [select.value, store.state];
    if (!source) return;
    const { apply, label } = added(await api.document(source), source);
    await edits.edit(apply, label, { gait });
  });
  const button = h("button", {
    text: "Add",
    title: "Adds the chosen gait at the end of the sequence",
    on: { click: act },
  });
  store.watch(
    ({ gaits, selected, view }) => [gaits, selected, isSequence(view?.document)],
    ({ gaits, selected, view }) => {
      if (!isSequence(view?.document)) return;
      const { robot } = gaits.find(({ id }) => id === selected) ?? { robot: null };
      const chosen = select.value;
      const groups = Map.groupBy ? Map.groupBy(gaits, ({ group }) => group) : new Map([["Gaits", gaits]]);
      const choices = (lines) =>
        lines.filter(({ id, problem }) => id !== selected && !problem).map((line) => choice(line, robot));
      select.replaceChildren(
        ...[...groups].map(([label, lines]) => h("optgroup", { label }, ...choices(lines))),
      );
      const free = [...select.options].filter((option) => !option.disabled);
      select.value = (free.find(({ value }) => value === chosen) ?? free[0])?.value ?? "";
    },
  );
  return h("div", { class: "part-add" }, select, button);
}
