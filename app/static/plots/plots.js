/** Strip plots under the timeline, on its time axis: which are shown, their curves, and the figures under the pointer. */

import { axisKey, axisOf, fractionAt, timeAt } from "../state/time_axis.js";
import { checkMenu } from "../lib/check_menu.js";
import { recalled, remember } from "../lib/remembered.js";
import { HEIGHT, WIDTH, acrossOf, indexAt, pathOf, rangeOf, scaleOf } from "./curves.js";
import { byId, h, setText, svg } from "../lib/dom.js";
import { fixed } from "../lib/format.js";
import { measuredCurves, measuredRange, oversOf, runOver } from "./measured.js";
import { simulationOver } from "../state/simulation.js";
import { isRefusedDrawing } from "../state/live_plan.js";
import { shownDocument } from "../state/store.js";
import { stripCanvas } from "./strip_canvas.js";
import { STRIPS, ownerOf } from "./strips.js";
import { GREY, drawnPlan, greyOf } from "../state/worked_plan.js";

/** Rounding of the figures that come from the server: a limit passed by less is kept. */
const ROUNDING = 0.006;
const NEAR_PX = 8;

const line = (y, name) => svg("line", { x1: 0, x2: WIDTH, y1: y, y2: y, class: name });

function tick(value, scale) {
  const element = h("span", { class: "tick", text: fixed(value, Number.isInteger(value) ? 0 : 1) });
  element.style.top = `${scale(value)}%`;
  return element;
}

/** Where values pass a limit: curves are drawn there once more in the bad colour. */
function beyond({ low = null, high = null }, scale, [least, most]) {
  const over = high !== null && most > high + ROUNDING;
  const under = low !== null && least < low - ROUNDING;
  return [over && { y: 0, height: Math.max(scale(high), 0) }, under && { y: scale(low), height: HEIGHT }].filter(Boolean);
}

/** Where a value is missing in the midst of a motion, such as a stroke whose rod is too short. */
function missing({ series }, across) {
  const bands = [];
  const half = across.x.length > 1 ? (across.x[1] - across.x[0]) / 2 : 0;
  let from = null;
  for (let index = across.first; index <= across.last + 1; index += 1) {
    const lacks = index <= across.last && series.some(({ valueAt }) => (valueAt(index) ?? null) === null);
    if (lacks) from ??= across.x[index] - half;
    else if (from !== null) {
      bands.push({ x: from, width: across.x[index - 1] + half - from });
      from = null;
    }
  }
  return bands;
}

/** A curve a foot; the motors of a foot are one path. What was planned is dotted where something lies over it. */
function curvesOf({ series }, across, scale, dashed, grey) {
  const paths = new Map();
  for (const { foot, valueAt } of series) paths.set(foot, (paths.get(foot) ?? "") + pathOf(across, valueAt, scale));
  const thin = series.length > paths.size;
  return [...paths].map(([foot, d]) => ({ d, tone: grey ? "grey" : foot === null ? "fine" : foot + 1, width: thin ? 1 : 1.5, alpha: thin ? 0.85 : 1, dash: dashed ? [2, 3] : [] }));
}

/** The number of each foot that rises, at its highest sample in view. */
function footTags({ series }, across, scale) {
  return series.flatMap(({ foot, valueAt }) => {
    let top = across.first;
    for (let index = across.first; index <= across.last; index += 1) if (valueAt(index) > valueAt(top)) top = index;
    if (!(valueAt(top) > 0.5)) return [];
    const element = h("span", { class: "foot-tag", text: String(foot + 1), data: { foot: foot + 1 } });
    element.style.left = `${(100 * across.x[top]) / WIDTH}%`;
    element.style.top = `${Math.min(Math.max(scale(valueAt(top)) + 15, 14), 86)}%`;
    return [element];
  });
}

/** Draws a strip, with measured or simulated curves over it, and with `words` that name its lines; returns what the pointer needs. */
function draw(row, content, across, count, axis, { overs, rules, grey, words }) {
  const { low = null, high = null, wanted = null, floor = null, most = 0 } = content;
  const ranges = [rangeOf(content.series, count), ...overs.map(measuredRange)];
  const range = [Math.min(...ranges.map(([least]) => least)), Math.max(...ranges.map(([, greatest]) => greatest))];
  const given = [low, high, wanted, floor, most].filter((value) => value !== null);
  const scale = scaleOf(Math.min(range[0], ...given), Math.max(range[1], ...given));
  const limits = [low, high].filter((value) => value !== null);
  const lines = svg("svg", { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, preserveAspectRatio: "none", "aria-hidden": "true" },
    ...limits.map((value) => line(scale(value), "limit")), ...(floor === null ? [] : [line(scale(floor), "floor")]),
    ...(wanted === null ? [] : [line(scale(wanted), "wanted")]));
  row.canvas.show({ bands: missing(content, across), rules, curves: [...curvesOf(content, across, scale, overs.length > 0, grey), ...overs.flatMap((over) => measuredCurves(over, axis, scale))], clips: grey === "worked" ? [] : beyond(content, scale, range) });
  row.strip.replaceChildren(lines, row.canvas.element, ...limits.map((value) => tick(value, scale)), ...(content.tags ? footTags(content, across, scale) : []), ...(words ? [h("span", { class: "measured-key", text: words })] : []));
  row.strip.setAttribute("aria-label", [grey && `${GREY[grey].stage} `, summary(row.kind, range, limits)].filter(Boolean).join(""));
  return { content, scale };
}

/** Of a gait for the robot's clock: a line at each pose, and a short one from where Stop is heard in each move. */
function rulesOf(axis, { poses, times }) {
  if (!poses) return [];
  const at = (from) => (time) => ({ x: fractionAt(axis, time) * WIDTH, from });
  return [...times.map(at(0)), ...poses.heard.map(at(0.8))].filter(({ x }) => x >= 0 && x <= WIDTH);
}

function summary({ name, unit, help }, [least, most], limits) {
  const span = least <= most ? `${fixed(least)} to ${fixed(most)} ${unit}` : "not known";
  const held = limits.length ? `, ${limits.length > 1 ? "limits" : "limit"} ${limits.map((value) => fixed(value)).join(" and ")}` : "";
  return `${name}: ${span}${held}. ${help}.`;
}

function buildRow(kind) {
  const value = h("span", { class: "value" });
  const strip = h("div", { class: "strip", role: "img", "aria-label": kind.help, data: { strip: kind.key } });
  return { kind, value, strip, canvas: stripCanvas(strip), label: h("div", { class: "plot-label", title: kind.help }, h("span", { class: "name", text: kind.name }), value), drawn: null };
}

function showSentence(row, sentence) {
  row.drawn = null;
  row.strip.replaceChildren(h("div", { class: "empty", text: sentence }));
  row.strip.setAttribute("aria-label", `${row.kind.name}: ${sentence || "nothing to show."}`);
}

/** What is said where there is nothing to draw. */
function emptyWords(state, plan) {
  if (!state.view) return "";
  if (isRefusedDrawing(state)) return "No motion: the inspector says why.";
  return plan?.refusal ? "No motion: the reason stands at the timeline." : "No plan yet.";
}

/** The names of the lines of a strip, beside the plain ones. */
const lineNames = (grey, overs) => [grey && GREY[grey].plot, ...(overs.length ? [...overs.map(({ word }) => word), "planned dotted"] : [])].filter(Boolean).join(", ");

function render(rows, state) {
  const [plan, grey] = [drawnPlan(state), greyOf(state)];
  byId("plots").toggleAttribute("data-iterate", Boolean(state.iterate));
  byId("plots").toggleAttribute("data-grey", grey !== null);
  if (!(plan?.times?.length > 0)) {
    rows.forEach((row) => showSentence(row, emptyWords(state, plan)));
    return;
  }
  const axis = axisOf(state);
  const across = acrossOf(axis, plan.times);
  const rules = rulesOf(axis, plan);
  const { options } = shownDocument(state);
  // The lines are named in the first strip that has them.
  let isNamed = false;
  for (const row of rows) {
    if (row.strip.hidden) continue;
    const content = row.kind.of(plan, options);
    if (!content) {
      showSentence(row, row.kind.lack);
      continue;
    }
    const overs = oversOf(state, row.kind.key);
    const words = isNamed ? "" : lineNames(grey, overs);
    row.drawn = draw(row, content, across, plan.times.length, axis, { overs, rules, grey, words });
    isNamed ||= words !== "";
  }
}

/** The series that passes nearest to a height of the strip, 0 to 1, at a sample. */
function nearest({ content, scale }, index, height) {
  const near = content.series.map((series) => ({ series, value: series.valueAt(index) })).filter(({ value }) => value !== null && Number.isFinite(value));
  const away = ({ value }) => Math.abs(scale(value) / HEIGHT - height);
  return near.reduce((best, one) => (best === null || away(one) < away(best) ? one : best), null);
}

function hoverText({ kind }, { content: { low, high } }, { series, value }, time, grey) {
  const limit = high !== null && value > high + ROUNDING ? `, limit ${fixed(high)}` : low !== null && value < low - ROUNDING ? `, limit ${fixed(low)}` : "";
  return [ownerOf(series), `${fixed(value)} ${kind.unit}${limit}`, `${fixed(time)} s`, grey && GREY[grey].value].filter(Boolean).join(" · ");
}

/** Shows the value under the pointer with its foot and time. */
function mountHover(store, rows) {
  const [dot, words] = [h("i", { class: "hover-dot" }), h("span", { class: "hover-words" })];
  const hover = h("div", { class: "plot-hover", "aria-hidden": "true", hidden: true }, dot, words);
  byId("plots").append(hover);
  const hide = () => { hover.hidden = true; };

  function show(row, event) {
    const plan = drawnPlan(store.state);
    if (!row.drawn || !plan?.times?.length) return hide();
    const box = row.strip.getBoundingClientRect();
    const axis = axisOf(store.state);
    const index = indexAt(plan.times, timeAt(axis, (event.clientX - box.left) / box.width));
    const found = nearest(row.drawn, index, (event.clientY - box.top) / box.height);
    if (!found) return hide();
    const around = byId("plots").getBoundingClientRect();
    const across = (acrossOf(axis, [plan.times[index]]).x[0] / WIDTH) * box.width;
    hover.hidden = false;
    setText(words, hoverText(row, row.drawn, found, plan.times[index], greyOf(store.state)));
    hover.dataset.foot = found.series.foot === null ? "" : String(found.series.foot + 1);
    hover.toggleAttribute("data-left", across > box.width - 190);
    hover.toggleAttribute("data-below", box.top - around.top < NEAR_PX * 2 + 10);
    hover.style.transform = `translate(${box.left - around.left + across}px, ${box.top - around.top + (row.drawn.scale(found.value) / HEIGHT) * box.height}px)`;
    return undefined;
  }

  for (const row of rows) {
    row.strip.addEventListener("pointermove", (event) => show(row, event));
    row.strip.addEventListener("pointerleave", hide);
  }
  store.watch((state) => [drawnPlan(state), greyOf(state)], hide);
}

/** The menu in the corner of the chart that chooses the strips; the choice is remembered. */
function mountChoice(rows, redraw) {
  const choice = recalled("plots", Object.fromEntries(STRIPS.map(({ key, shown }) => [key, shown])));
  const apply = () => rows.forEach(({ kind, strip, label }) => { strip.hidden = label.hidden = !choice[kind.key]; });
  const menu = checkMenu({
    id: "plots-menu", name: "Plots", help: "Which plots stand under the timeline",
    entries: STRIPS.map(({ key, name, help }) => ({ key, text: name, help, checked: choice[key] })),
    onChange(key, checked) {
      choice[key] = checked;
      remember("plots", choice);
      apply();
      redraw();
    },
  });
  apply();
  byId("chart-corner").append(menu.element);
}

/** Builds the plots; returns what shows the figures at the playhead. */
export function mountPlots(store) {
  const rows = STRIPS.map(buildRow);
  byId("plots").append(...rows.flatMap(({ label, strip }) => [label, strip]));
  mountChoice(rows, () => render(rows, store.state));
  mountHover(store, rows);
  const drawn = (state) => [drawnPlan(state), greyOf(state), isRefusedDrawing(state), shownDocument(state)?.options, axisKey(state), runOver(state), simulationOver(state)];
  store.watch(drawn, (state) => render(rows, state));

  return (time) => {
    const plan = drawnPlan(store.state);
    const isKnown = plan?.times?.length > 0 && greyOf(store.state) === null;
    const index = isKnown ? indexAt(plan.times, time) : 0;
    for (const { kind, value } of rows) {
      setText(value, isKnown ? kind.now(plan, index) : "–");
      if (kind.isBad) value.dataset.toneText = isKnown && kind.isBad(plan, index) ? "bad" : "";
    }
  };
}
