/** Strip plots under the timeline: stability margin, strokes with their limits, foot heights; one time axis. */

import { axisOf, fractionAt } from "./axis.js";
import { byId, h, setText, svg } from "./dom.js";
import { fixed, mm } from "./format.js";
import { plotsAt } from "./samples.js";

const HEIGHT = 100;

/** A plot's scale: value to 0 (top) … HEIGHT (bottom), with room at both ends. */
function scaleOf(low, high) {
  const room = (high - low || 1) * 0.16;
  return (value) => HEIGHT * (1 - (value - low + room) / (high - low + 2 * room));
}

/** Path through the values; a value that is null or not finite breaks the line. */
function pathOf(axis, times, values, scale) {
  let path = "";
  let open = false;
  values.forEach((value, index) => {
    const known = value !== null && Number.isFinite(value);
    if (known) path += `${open ? "L" : "M"}${(fractionAt(axis, times[index]) * 1000).toFixed(2)} ${scale(value).toFixed(2)}`;
    open = known;
  });
  return path;
}

const line = (y, name) => svg("line", { x1: 0, x2: 1000, y1: y, y2: y, class: name });
const path = (d, name, foot) => svg("path", { d, class: name, ...(foot === undefined ? {} : { "data-foot": foot + 1 }) });

function tick(value, scale, text) {
  const element = h("span", { class: "tick", text });
  element.style.top = `${scale(value)}%`;
  return element;
}

function canvas(...shapes) {
  return svg("svg", { viewBox: `0 0 1000 ${HEIGHT}`, preserveAspectRatio: "none", "aria-hidden": "true" }, ...shapes);
}

function drawMargin(strip, axis, plan, wanted) {
  const values = plan.margin.map((value) => (value === null ? null : value * 1000));
  const known = values.filter((value) => value !== null && Number.isFinite(value));
  const scale = scaleOf(Math.min(0, ...known), Math.max(1, wanted * 1000, ...known));
  const d = pathOf(axis, plan.times, values, scale);
  const zero = scale(0);
  const clip = svg("clipPath", { id: "below-zero" }, svg("rect", { x: 0, y: zero, width: 1000, height: HEIGHT }));
  const below = path(d, "broken");
  below.setAttribute("clip-path", "url(#below-zero)");
  strip.replaceChildren(canvas(clip, line(zero, "limit"), ...(wanted > 0 ? [line(scale(wanted * 1000), "wanted")] : []), path(d, "fine"), below),
    tick(0, scale, "0"));
}

function drawStrokes(strip, axis, plan) {
  if (!plan.strokes_mm) return empty(strip, "No strokes: the plan is out of the legs' reach.");
  const [low, high] = plan.stroke_limits_mm;
  const all = plan.strokes_mm.flat().filter(Number.isFinite);
  const scale = scaleOf(Math.min(low, ...all), Math.max(high, ...all));
  const paths = plan.strokes_mm[0].map((_, motor) =>
    path(pathOf(axis, plan.times, plan.strokes_mm.map((row) => row[motor]), scale), "stroke-foot thin", Math.floor(motor / 3)));
  return strip.replaceChildren(canvas(line(scale(low), "limit"), line(scale(high), "limit"), ...paths),
    tick(high, scale, String(high)), tick(low, scale, String(low)));
}

function footTag(axis, plan, foot, values, scale) {
  const top = values.indexOf(Math.max(...values));
  const element = h("span", { class: "foot-tag", text: String(foot + 1), data: { foot: foot + 1 } });
  element.style.left = `${100 * fractionAt(axis, plan.times[top])}%`;
  element.style.top = `${Math.min(Math.max(scale(values[top]) + 15, 14), 86)}%`;
  return element;
}

function drawHeights(strip, axis, plan) {
  const heights = plan.feet[0].map((_, foot) => plan.feet.map((sample) => sample[foot][2] * 1000));
  const scale = scaleOf(0, Math.max(2, ...heights.flat()));
  const lifted = heights.map((values, foot) => [values, foot]).filter(([values]) => Math.max(...values) > 0.5);
  strip.replaceChildren(canvas(line(scale(0), "floor"), ...heights.map((values, foot) => path(pathOf(axis, plan.times, values, scale), "stroke-foot", foot))),
    ...lifted.map(([values, foot]) => footTag(axis, plan, foot, values, scale)));
}

function empty(strip, sentence) {
  strip.replaceChildren(h("div", { class: "empty", text: sentence }));
}

function plotRow(name, help) {
  const value = h("span", { class: "value" });
  const strip = h("div", { class: "strip", role: "img", "aria-label": help });
  return { value, strip, label: h("div", { class: "plot-label", title: help }, h("span", { class: "name", text: name }), value) };
}

/** Builds the plots; returns what shows the figures at the playhead. */
export function mountPlots(store) {
  const rows = {
    margin: plotRow("Stability margin", "Distance of the centre of mass from the edge of the support polygon, in mm; below 0 it tips"),
    strokes: plotRow("Strokes", "Extension of the 12 motors in mm, a colour a foot, with their limits"),
    heights: plotRow("Foot heights", "Height of each foot over where it stands, in mm"),
  };
  byId("plots").append(...Object.values(rows).flatMap(({ label, strip }) => [label, strip]));

  store.watch(({ view }) => [view?.plan, view?.document.options?.margin], (state) => {
    const plan = state.view?.plan;
    const usable = plan?.times?.length > 0;
    if (!usable) {
      const sentence = !state.view ? "" : plan?.refusal ? "No motion: the reason stands at the timeline." : "No plan yet.";
      Object.values(rows).forEach(({ strip }) => empty(strip, sentence));
      return;
    }
    const axis = axisOf(state);
    if (plan.margin) drawMargin(rows.margin.strip, axis, plan, state.view.document.options?.margin ?? 0);
    else empty(rows.margin.strip, "No margin.");
    drawStrokes(rows.strokes.strip, axis, plan);
    if (plan.feet?.length) drawHeights(rows.heights.strip, axis, plan);
    else empty(rows.heights.strip, "No feet.");
  });

  return (time) => {
    const now = plotsAt(store.state.view?.plan, time);
    setText(rows.margin.value, now.margin === null ? "–" : `${mm(now.margin)} mm`);
    rows.margin.value.dataset.toneText = now.margin !== null && now.margin < 0 ? "bad" : "";
    setText(rows.strokes.value, now.strokes ? `${fixed(now.strokes[0])} … ${fixed(now.strokes[1])} mm` : "–");
    setText(rows.heights.value, now.height ? `foot ${now.height.foot + 1}: ${mm(now.height.value)} mm` : "–");
  };
}
