/** A part of the sequence as a row: its name, how often it runs, how far it goes, and how it stands. */

import { h, icon, setAllowed, setAttribute, setText } from "../lib/dom.js";
import { fixed, mm } from "../lib/format.js";
import { refusalOf, wholeNumber } from "../lib/field_error.js";
import { MOST_TIMES } from "../document/sequence_edits.js";

const STATES = {
  live: ["live", "good"],
  optimised: ["exact", "good"],
  manual: ["by hand", "good"],
  recorded: ["recorded", "good"],
  draft: ["no motion", "bad"],
};
const HELP =
  "Drag the part to move it, or press Alt with Up or Down. Delete removes the part. "
  + "Enter moves the playhead to the start of the part";
const DEGREES = 180 / Math.PI;

/**
 * Way, turn and time of a stretch of the plan, without what there is none of: "30.0 mm · 45° · 49.6 s".
 * @param {Record<string, any>} stretch
 */
export function figuresOf({ travel, turn, duration }) {
  if (!travel) return "";
  const way = Math.hypot(...travel);
  return [
    way > 5e-5 && `${mm(way)} mm`,
    Math.abs(turn) > 1e-4 && `${fixed(turn * DEGREES, 0)}°`,
    `${fixed(duration)} s`,
  ]
    .filter(Boolean)
    .join(" · ");
}

/** What the body does between two parts. */
function moveText(move, plan) {
  const feet = move.feet.map((foot) => foot + 1);
  if (feet.length) {
    const [noun, verb] = feet.length > 1 ? ["Feet", "step"] : ["Foot", "steps"];
    return `${noun} ${feet.join(", ")} ${verb} over · ${fixed(move.duration)} s`;
  }
  const rise = plan.body[move.last][2] - plan.body[move.first][2];
  const words = [
    Math.abs(rise) > 5e-6 && `${rise > 0 ? "up" : "down"} ${mm(Math.abs(rise))} mm`,
    figuresOf(move),
  ].filter(Boolean);
  return `Body moves ${words.join(" · ")}`;
}

function button(name, symbol, act) {
  return h(
    "button",
    {
      class: "plain icon-only small",
      "aria-label": name,
      on: {
        click: (event) => {
          if (event.currentTarget.getAttribute("aria-disabled") !== "true") act();
        },
      },
    },
    icon(symbol),
  );
}

/** The field that says how often a part runs; `giveUp` restores the number after an error. */
function timesField(change) {
  const input = h("input", {
    type: "number",
    min: 1,
    max: MOST_TIMES,
    step: 1,
    title: `How many times the robot performs this part, 1 to ${MOST_TIMES}`,
  });
  const refusal = refusalOf(input);
  const giveUp = () => {
    refusal.setError(null);
    input.value = input.dataset.shown;
  };
  input.addEventListener("change", () => {
    const { value, sentence = null } = wholeNumber(input, "Times", { min: 1, max: MOST_TIMES });
    refusal.setError(sentence);
    if (!sentence) change(value);
  });
  input.addEventListener("keydown", (event) => {
    if (event.key === "Enter") input.blur();
    if (event.key === "Escape") giveUp();
  });
  return { input, refusal, giveUp };
}

const link = (text, title, click) => h("button", { class: "link", text, title, on: { click } });

/**
 * Builds a row.
 * @param {{
 *   times: (times: number) => void,
 *   move: (way: number) => void,
 *   remove: () => void,
 *   takeOver: () => void,
 *   runThrough: () => void,
 * }} actions on this row's part
 */
export function partRow(actions) {
  const lead = h("p", { class: "part-lead", role: "gridcell" });
  const [number, text] = [h("span", { class: "part-number" }), h("span", { class: "part-text" })];
  const name = h("div", { class: "part-name", role: "gridcell", tabindex: "-1" }, number, text);
  const { input, refusal, giveUp } = timesField(actions.times);
  const [up, down] = [
    button("Move up", "up", () => actions.move(-1)),
    button("Move down", "down", () => actions.move(1)),
  ];
  const out = button("Take out", "close", actions.remove);
  const figures = h("span", { class: "number" });
  const [dot, word] = [h("span", { class: "dot" }), h("span", {})];
  const over = link("update", "Copies the current version of the gait into this part", actions.takeOver);
  const through = link(
    "without a pause",
    "Joins the repetitions again, so that the robot does not pause between them",
    actions.runThrough,
  );
  const cross = h("span", { class: "quiet", "aria-hidden": "true", text: "×" });
  const cell = (kind, ...children) => h("div", { class: kind, role: "gridcell" }, ...children);
  const element = h(
    "div",
    { class: "part", role: "row" },
    lead,
    name,
    cell("part-times", input, cross),
    cell("part-buttons", up, down, out),
    cell("part-refusal", refusal.element),
    cell("part-state", figures, h("span", { class: "part-word" }, dot, word, over, through)),
  );
  return {
    element,
    lead,
    name,
    number,
    text,
    input,
    refusal,
    giveUp,
    up,
    down,
    out,
    figures,
    dot,
    word,
    over,
    through,
  };
}

/** The number of times, unless a person is typing one or has to repair it. */
function showTimes({ input, refusal, giveUp }, part, index) {
  const { times, gait } = part;
  setAttribute(input, "aria-label", `Times of part ${index + 1}`);
  const isAnother = input.dataset.part !== undefined && input.dataset.part !== gait.name;
  Object.assign(input.dataset, { shown: String(times), part: gait.name });
  if (refusal.hasError() && isAnother) giveUp();
  if (document.activeElement !== input && !refusal.hasError()) input.value = times;
}

function showButtons({ up, down, out }, title, index, count) {
  setAllowed(up, index === 0 ? "The first part cannot move up." : null, `Move “${title}” up (Alt+Up)`);
  setAllowed(
    down,
    index === count - 1 ? "The last part cannot move down." : null,
    `Move “${title}” down (Alt+Down)`,
  );
  setAllowed(
    out,
    count === 1 ? "A sequence needs at least one part. Delete the sequence instead." : null,
    `Take “${title}” out (Delete)`,
  );
}

/** How a part stands, as a word with its tone and its help. */
function stateOf(source, planned) {
  if (source === "changed")
    return [
      "source changed",
      "caution",
      "The motion of the original gait has changed since you added or updated this part",
    ];
  if (!planned) return ["…", "quiet"];
  return [...(STATES[planned.source] ?? [planned.source, "quiet"]), planned.note];
}

function showState(row, part, source, planned) {
  const [word, tone, help] = stateOf(source, planned);
  const isFromRest = Boolean(part.restarts) && part.times > 1;
  setText(row.figures, planned ? figuresOf(planned) : "");
  row.dot.dataset.tone = tone;
  setText(row.word, isFromRest ? `${word}, repetitions from rest` : word);
  setAttribute(row.word, "title", help);
  row.over.hidden = source !== "changed";
  row.through.hidden = !isFromRest || source === "changed";
}

/**
 * Shows a part in its row.
 * @param {ReturnType<typeof partRow>} row
 * @param {{
 *   index: number,
 *   count: number,
 *   part: Record<string, any>,
 *   planned: Record<string, any>|null,
 *   move: Record<string, any>|null,
 *   source: string|null,
 *   plan: Record<string, any>,
 * }} what
 */
export function showRow(row, { index, count, part, planned, move, source, plan }) {
  const title = part.gait.name;
  row.lead.hidden = !move;
  setText(row.lead, move ? moveText(move, plan) : "");
  setText(row.number, String(index + 1));
  setText(row.text, title);
  setAttribute(row.name, "aria-label", `Part ${index + 1} of ${count}: ${title}`);
  setAttribute(row.name, "title", `${title}. ${HELP}`);
  showTimes(row, part, index);
  showButtons(row, title, index, count);
  showState(row, part, source, planned);
}
