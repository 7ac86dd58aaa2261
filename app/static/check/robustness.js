/** The results of a simulation's variations: a map with a cell each, and the share that walks. */

import { h, setText } from "../lib/dom.js";
import { fixed, mm } from "../lib/format.js";

const COLUMNS = 16;
const degrees = (radians) => fixed((radians * 180) / Math.PI);

/** How a variation came out: what it is called, its sign, and its sentence. */
function cameOf({ walks, fell, max_tilt: tilt, distance, feet_error: error, ended_early: early }) {
  if (fell) return ["falls", "×", `falls over, leaning by ${degrees(tilt)}°`];
  if (early) return ["falls", "×", `ends early: ${early.replace(/\.$/, "")}`];
  const figures = `leans by ${degrees(tilt)}° at most, goes ${mm(distance)} mm, feet ${mm(error)} mm off`;
  return walks ? ["walks", "", `walks: ${figures}`] : ["tips", "!", `tips onto a foot in the air: ${figures}`];
}

function cell(run, number) {
  const [came, sign, words] = cameOf(run);
  const sentence = `Variation ${number + 1}: ${run.name}. It ${words}.`;
  return h("li", { class: "variation", title: sentence, "aria-label": sentence, tabindex: number ? "-1" : "0", text: sign, data: { came } });
}

/** Arrows go from cell to cell; the focused cell is described below the map. */
function mountKeys(list, description) {
  list.addEventListener("keydown", (event) => {
    const step = { ArrowLeft: -1, ArrowRight: 1, ArrowUp: -COLUMNS, ArrowDown: COLUMNS }[event.key];
    const cells = [...list.children];
    const to = step && cells[cells.indexOf(document.activeElement) + step];
    if (!step) return;
    event.preventDefault();
    event.stopPropagation();
    if (!to) return;
    cells.forEach((one) => { one.tabIndex = one === to ? 0 : -1; });
    to.focus();
  });
  for (const kind of ["focusin", "pointerover"]) list.addEventListener(kind, ({ target }) => { if (target.matches(".variation")) setText(description, target.title); });
}

/** Builds the map. */
export function robustness() {
  const [share, list, description] = [h("b"), h("ul", { class: "variations", role: "list", "aria-label": "Variations" }), h("p", { class: "why said" })];
  const element = h("div", { class: "robustness", hidden: true }, h("h3", { text: "Variations" }), h("p", {}, share), list, description);
  list.style.setProperty("--columns", COLUMNS);
  mountKeys(list, description);
  let known = null;
  return {
    element,
    show(variations, stale) {
      element.hidden = !variations;
      element.toggleAttribute("data-stale", stale);
      if (!variations || variations === known) return;
      known = variations;
      const walking = variations.runs.filter(({ walks }) => walks).length;
      setText(share, `${walking} of ${variations.count} walk (${fixed((100 * walking) / variations.count, 0)} %)`);
      setText(description, "Friction, masses, motor speed, one weak motor, 1° of slope and softer legs, by chance. Point at a cell.");
      list.replaceChildren(...variations.runs.map(cell));
    },
  };
}
