/** The list of remedies for a drawing that cannot walk, best first. Pointing at a row previews its result. */

import { h, setAttribute, setText } from "../lib/dom.js";
import { fixed, mm } from "../lib/format.js";
import { oneTabStop } from "../lib/tab_stop.js";
import { footfalls } from "../shell/footfalls.js";

const NO_PHYSICS = { text: "A simulation is running…", tone: null, title: null };

/** The result of the physics trial of a remedy, as a short text. */
function physicsWords({ kind, physics, caution }, isTrying) {
  if (!physics) return isTrying ? NO_PHYSICS : { text: caution, tone: "caution", title: null };
  if (physics.walks === null)
    return { text: "The simulation gave no result.", tone: "caution", title: physics.sentence };
  // What is likely to tip has proven that it does not; arms that touch still do.
  if (physics.walks && caution && kind !== "no_margin") {
    return { text: `The robot walks in the simulation. ${caution}`, tone: "caution", title: null };
  }
  if (physics.walks && physics.sentence)
    return { text: `The robot walks in the simulation. ${physics.sentence}`, tone: "caution", title: null };
  if (physics.walks) return { text: "The robot walks in the simulation.", tone: "good", title: null };
  return { text: "The robot does not walk in the simulation.", tone: "caution", title: physics.sentence };
}

/** A row for a remedy; `update` shows new results in place. */
function row(remedy, { use, show, end }) {
  const { label, sentence, document, robot_seconds: robotSeconds } = remedy;
  const [margin, physics] = [h("span", { class: "number remedy-margin" }), h("span", {})];
  const price = robotSeconds === null ? "" : ` Time on the robot: ${fixed(robotSeconds)} s.`;
  const button = h("button", {
    text: "Use this",
    "aria-label": `Use this: ${label}`,
    title: "Makes this change. Undo restores your drawing.",
    on: { click: () => use(document, label) },
  });
  const element = h(
    "li",
    {
      class: "remedy",
      on: {
        pointerenter: () => show(document),
        pointerleave: end,
        focusin: () => show(document),
        focusout: end,
        keydown: ({ key }) => {
          if (key === "Escape") end();
        },
      },
    },
    footfalls(document.timeline.feet),
    h("b", { text: label }),
    margin,
    h("p", { class: "quiet" }, `${sentence}${price} `, physics),
    button,
  );
  return {
    element,
    update(known, isTrying) {
      const { text, tone, title } = physicsWords(known, isTrying);
      setText(margin, known.balance === null ? "–" : `${mm(known.balance)} mm`);
      setAttribute(margin, "data-tone-text", tone === "caution" || known.balance === null ? null : "good");
      setText(physics, text);
      setAttribute(physics, "data-tone-text", tone);
      setAttribute(physics, "title", title);
    },
  };
}

/** Labels in the order of their rows; while the list has pointer or focus, no row changes its place. */
function orderOf(labels, shown, isHeld) {
  if (!isHeld) return labels;
  const kept = shown.filter((label) => labels.includes(label));
  return [...kept, ...labels.filter((label) => !kept.includes(label))];
}

function noteOf({ searching, trying, complete, list, sentence }) {
  if (sentence) return sentence;
  if (searching)
    return list.length ? "Looking for more changes that help…" : "Looking for changes that help…";
  if (!list.length)
    return trying
      ? "Looking for changes that help…"
      : complete
        ? "No change was found with which the robot can walk."
        : "The search ended early. Change the drawing to start a new search.";
  return "";
}

/**
 * The list with a line below it.
 * @param {object} acts
 * @param {(document: Record<string, any>, label: string) => void} acts.use
 * @param {(document: Record<string, any>) => void} acts.show
 * @param {() => void} acts.end
 */
export function remedyList(acts) {
  const head = h(
    "div",
    { class: "remedies-head" },
    h("h4", { text: "What would help" }),
    h("span", { class: "quiet", text: "Margin" }),
  );
  const list = h("ul", { class: "remedies", role: "list" });
  const group = h("div", { role: "group", "aria-label": "What would help" }, list);
  oneTabStop(list);
  const note = h("p", { class: "why" });
  const rows = new Map();
  let shown = [];
  return {
    element: h("div", {}, head, group, note),
    show(remedies) {
      const known = remedies ?? { list: [], searching: true, trying: true, complete: false };
      const labels = known.list.map(({ label }) => label);
      const isHeld = list.matches(":hover, :focus-within");
      const remove = (label) => {
        const { element } = rows.get(label);
        if (element.matches(":hover, :focus-within")) acts.end();
        element.remove();
        rows.delete(label);
      };
      [...rows.keys()].filter((label) => !labels.includes(label)).forEach(remove);
      for (const remedy of known.list) {
        // After an edit the same label may belong to another document: build its row again.
        const text = JSON.stringify(remedy.document);
        if (rows.has(remedy.label) && rows.get(remedy.label).text !== text) remove(remedy.label);
        if (!rows.has(remedy.label)) rows.set(remedy.label, { text, ...row(remedy, acts) });
        rows.get(remedy.label).update(remedy, known.trying);
      }
      shown = orderOf(labels, shown, isHeld);
      // Leave a row that is in its place alone: moving it would lose the focus and a click in progress.
      shown.forEach((label, index) => {
        const { element } = rows.get(label);
        if (list.children[index] !== element) list.insertBefore(element, list.children[index] ?? null);
      });
      head.hidden = group.hidden = !labels.length;
      const text = noteOf(known);
      setText(note, text);
      note.hidden = !text;
    },
  };
}
