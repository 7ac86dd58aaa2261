/** A small timeline of a gait above or below the transition, with a cursor that chooses a sample. */

import { clamp } from "../lib/clamp.js";
import { h, setAttribute, setText, svg } from "../lib/dom.js";
import { fixed } from "../lib/format.js";

/** Stretches of a row that begin with `value`: [first, count] each. */
function stretchesOf(row, value) {
  return [...row.matchAll(new RegExp(`${value}+`, "g"))].map((match) => [match.index, match[0].length]);
}

/**
 * A timeline's swings in their feet's colours, and what is locked or held with the hatch of that id.
 * @param {Record<string, any>} document
 * @param {string|null} hatch
 */
export function picture({ timeline, held }, hatch) {
  const { feet, locked } = timeline;
  const isHeld = (foot) => held?.start?.includes(foot + 1) && held.end?.includes(foot + 1);
  const rows = feet.flatMap((row, foot) =>
    stretchesOf(row, 0).map(([first, count]) =>
      svg("rect", {
        x: first,
        y: foot + 0.06,
        width: count,
        height: 0.88,
        "data-foot": foot + 1,
        class: "swing",
      }),
    ),
  );
  const marks = feet.flatMap((row, foot) =>
    [...stretchesOf(locked?.[foot] ?? "", 1), ...(isHeld(foot) ? [[0, row.length]] : [])].map(
      ([first, count]) =>
        svg("rect", {
          x: first,
          y: foot + 0.06,
          width: count,
          height: 0.88,
          class: "fixed",
          fill: `url(#${hatch})`,
        }),
    ),
  );
  return [...rows, ...marks];
}

/** "feet 1, 2, 4 stand, foot 3 swings": the state at a sample. */
export function stateText(feet, sample) {
  const names = (value) => feet.flatMap((row, foot) => (row[sample] === value ? [foot + 1] : []));
  const [standing, swinging] = [names("1"), names("0")];
  const one = (list, word) =>
    `${list.length > 1 ? "feet" : "foot"} ${list.join(", ")} ${word}${list.length > 1 ? "" : "s"}`;
  if (!swinging.length) return "all feet stand";
  return `${standing.length ? one(standing, "stand") : "no foot stands"}, ${one(swinging, "swing")}`;
}

const cursorHelp = (side) =>
  `The transition ${side === "from" ? "starts" : "ends"} with the state of this gait at the cursor. `
  + "To move the cursor, click, drag, or press Left, Right (with Shift: ten samples), Home or End";

/** The timeline with the cursor, which is a slider. */
function stripParts(name, side) {
  const image = svg("svg", { preserveAspectRatio: "none", class: "pattern-picture", "aria-hidden": "true" });
  const lines = h("div", { class: "pattern-lines", "aria-hidden": "true" });
  const cursor = h("div", { class: "pattern-cursor", "aria-hidden": "true" });
  const strip = h(
    "div",
    {
      class: "pattern-strip",
      role: "slider",
      tabindex: "0",
      "aria-label": `${name}: boundary sample`,
      "aria-valuemin": "1",
      "aria-valuemax": "1",
      "aria-valuenow": "1",
      data: { arrows: "" },
      title: cursorHelp(side),
    },
    image,
    lines,
    cursor,
  );
  return { strip, image, lines, cursor };
}

function lane(side, select, words, strip) {
  const isFirst = side === "from";
  return h(
    "div",
    { class: "pattern-lane" },
    h(
      "div",
      { class: "pattern-head" },
      h("b", { class: "pattern-letter", text: isFirst ? "A" : "B", "aria-hidden": "true" }),
      select,
      words,
    ),
    h(
      "div",
      { class: "pattern-row" },
      h("span", { class: "quiet pattern-side", text: isFirst ? "from here" : "to here" }),
      strip,
    ),
  );
}

/** Moves the cursor with pointer and keys; `place` returns the gait's number of samples and the cursor's. */
function mountCursor(strip, place, move) {
  const go = (sample) => {
    const { count, at } = place();
    const next = clamp(sample, 0, count - 1);
    if (next !== at) move(next);
  };
  const sampleAt = (event) => {
    const box = strip.getBoundingClientRect();
    return Math.floor(((event.clientX - box.left) / box.width) * place().count);
  };
  strip.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    strip.setPointerCapture(event.pointerId);
    go(sampleAt(event));
  });
  strip.addEventListener("pointermove", (event) => {
    if (strip.hasPointerCapture(event.pointerId)) go(sampleAt(event));
  });
  strip.addEventListener("keydown", (event) => {
    const { count, at } = place();
    const far = event.shiftKey ? 10 : 1;
    const goals = {
      ArrowLeft: at - far,
      ArrowDown: at - far,
      ArrowRight: at + far,
      ArrowUp: at + far,
      PageDown: at - 10,
      PageUp: at + 10,
      Home: 0,
      End: count - 1,
    };
    if (goals[event.key] === undefined || event.ctrlKey || event.altKey || event.metaKey) return;
    event.preventDefault();
    event.stopPropagation();
    go(goals[event.key]);
  });
}

function showOptions(select, gaits, gait) {
  const known = [...select.options].map((option) => `${option.value} ${option.text}`).join("\n");
  if (known !== gaits.map((one) => `${one.id} ${one.name}`).join("\n"))
    select.replaceChildren(...gaits.map((one) => h("option", { value: one.id, text: one.name })));
  select.value = gait;
}

/**
 * Builds a gait's part.
 * @param {{
 *   side: "from"|"to",
 *   name: string,
 *   help: string,
 *   choose: (gait: string) => void,
 *   move: (sample: number) => void,
 * }} options
 */
export function patternGaitStrip({ side, name, help, choose, move }) {
  const select = h("select", { "aria-label": name, title: help, on: { change: () => choose(select.value) } });
  const words = h("span", { class: "quiet pattern-state" });
  const { strip, image, lines, cursor } = stripParts(name, side);
  const element = lane(side, select, words, strip);
  let [drawn, count, at, sampleTime] = [null, 1, 0, 0];
  mountCursor(strip, () => ({ count, at }), move);

  function draw(document) {
    const { feet, locked } = document.timeline;
    const key = JSON.stringify([feet, locked, document.held]);
    if (drawn === key) return;
    drawn = key;
    setAttribute(image, "viewBox", `0 0 ${count} ${feet.length}`);
    image.replaceChildren(...picture(document, "pattern-hatch"));
    strip.style.setProperty("--feet", feet.length);
    strip.style.setProperty("--samples", String(count));
    lines.hidden = count > 90;
  }

  /** @param {{gaits: any[], gait: string, document: Record<string, any>|null, sample: number|null}} shown */
  function show({ gaits, gait, document, sample }) {
    showOptions(select, gaits, gait);
    element.toggleAttribute("data-empty", !document);
    if (!document) return;
    const { feet, sample_time: step } = document.timeline;
    [count, at, sampleTime] = [feet[0].length, clamp(sample ?? 0, 0, feet[0].length - 1), step];
    draw(document);
    cursor.style.left = `${(100 * at) / count}%`;
    cursor.style.width = `${100 / count}%`;
    const state = stateText(feet, at);
    setText(words, `sample ${at + 1} of ${count} · ${fixed(at * step)} s · ${state}`);
    setAttribute(strip, "aria-valuemax", count);
    setAttribute(strip, "aria-valuenow", at + 1);
    setAttribute(strip, "aria-valuetext", `sample ${at + 1} of ${count}, ${fixed(at * step)} s: ${state}`);
  }
  return {
    element,
    show,
    cursorAt: () => (at + 0.5) / count,
    sampleTime: () => sampleTime,
    seconds: () => count * sampleTime,
  };
}
