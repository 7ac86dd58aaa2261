/** Import: files of the laboratory and of other programs become gaits; a trajectory goes with its companion. */

import { api } from "../api/gaits.js";
import { h } from "../lib/dom.js";
import { attempt, toast } from "../lib/toasts.js";

const COMPANION = ".footfall.json";
const KINDS = ".json,.csv,application/json,text/csv";

/** What is sent of the chosen files: each gait's file as it is, a trajectory and its companion as one. */
async function bodies(files) {
  const companions = new Map(files.filter(({ name }) => name.endsWith(COMPANION)).map((file) => [file.name.slice(0, -COMPANION.length), file]));
  const gaits = files.filter(({ name }) => !name.endsWith(COMPANION));
  if (!gaits.length) throw new Error(`${files[0].name} is a trajectory's companion. Choose its trajectory (CSV) with it.`);
  return Promise.all(gaits.map(async (file) => {
    const companion = companions.get(file.name.replace(/\.csv$/i, ""));
    if (!companion) return { name: file.name, body: file };
    return { name: file.name, body: JSON.stringify({ csv: await file.text(), companion: await companion.text() }) };
  }));
}

/**
 * Lets a person choose files and makes a gait of each.
 * @param {(id: string) => Promise<void>} show shows a gait
 */
export function importFiles(show) {
  const input = h("input", { type: "file", accept: KINDS, multiple: true });
  input.addEventListener("change", attempt(async () => {
    const chosen = await bodies([...input.files]);
    const remarks = [];
    for (const { name, body } of chosen) {
      const view = await api.importFile(body, name);
      await show(view.id);
      if (view.remarks.length) remarks.push([...(chosen.length > 1 ? [`${name}:`] : []), ...view.remarks].join(" "));
      // Showing the next one takes away what belongs to this one: the sentences of all stand beside the last.
      if (remarks.length) toast(remarks.join(" "));
    }
  }));
  input.click();
}
