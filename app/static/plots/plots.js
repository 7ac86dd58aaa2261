/** Strip plots under the timeline, on its time axis: choice, curves, and the values under the pointer. */

import { axisKey, axisOf, fractionAt, timeAt } from "../state/time_axis.js";
import { checkMenu } from "../lib/check_menu.js";
import { onPointed } from "../lib/pointed.js";
import { recalled, remember } from "../lib/remembered.js";
import { HEIGHT, acrossOf, indexAt } from "./curves.js";
import { byId, h, setAttribute, setText, svg } from "../lib/dom.js";
import { fixed } from "../lib/format.js";
import { oversOf, runOver } from "./measured.js";
import { plotCard } from "./plot_card.js";
import { saveButtons } from "./plot_files.js";
import { robotSecondsAt } from "../state/robot_seconds.js";
import { simulationOver } from "../state/simulation.js";
import { isRefusedDrawing } from "../state/live_plan.js";
import { previewedDocument } from "../state/store.js";
import { stripCanvas } from "./strip_canvas.js";
import { APART, lineNames, rulesOf, stripPicture } from "./strip_picture.js";
import { STRIPS, valuesAt } from "./strips.js";
import { GREY, drawnPlan, greyOf } from "../state/worked_plan.js";

/** Height of a foot's row in a plot with a row for each foot, px. */
const laneHeight = (feet) => (feet <= 4 ? 24 : feet <= 6 ? 18 : 12);

const atHeight = (element, y) => {
  element.style.top = `${y}%`;
  return element;
};
const tickText = (value) => String(Number(value.toFixed(2)));

/** The texts at the right of a plot, without overlap and inside the plot. */
function namedTexts(named) {
  const sorted = named.toSorted((a, b) => a.y - b.y);
  const places = sorted.map(({ y }) => y);
  for (let at = 0; at < places.length; at += 1)
    places[at] = Math.max(places[at], at ? places[at - 1] + APART : APART / 2);
  for (let at = places.length - 1; at >= 0; at -= 1)
    places[at] = Math.min(places[at], at + 1 < places.length ? places[at + 1] - APART : 100 - APART / 2);
  return sorted.map(({ value, name, kind, away }, at) => {
    const arrow = away ? h("span", { "aria-hidden": "true", text: away === "up" ? " ↑" : " ↓" }) : null;
    return atHeight(h("span", { data: { kind } }, `${name} ${tickText(value)}`, arrow), places[at]);
  });
}

/** Replaces an element's children only when the key changes; during a drag most stay the same. */
function keep(element, key, build) {
  if (element.dataset.key === key) return;
  element.dataset.key = key;
  element.replaceChildren(...build());
}

/** Draws a strip; returns the data for the pointer's card and for saved files. */
function draw(row, content, view) {
  const picture = stripPicture(content, view);
  const { named, ticks, range, bands } = picture;
  row.strip.style.setProperty(
    "--lanes",
    bands.length > 1 ? `${bands.length * laneHeight(bands.length)}px` : "0px",
  );
  row.strip.toggleAttribute("data-empty", false);
  row.canvas.show(picture.drawing);
  keep(
    row.named,
    named.map(({ name, value, y, away }) => `${name} ${tickText(value)} ${y.toFixed(1)} ${away}`).join(),
    () => namedTexts(named),
  );
  keep(row.ticks, ticks.map(({ value, y }) => `${tickText(value)} ${y.toFixed(1)}`).join(), () =>
    ticks.map(({ value, y }) => atHeight(h("span", { text: tickText(value) }), y)),
  );
  const limits = [content.low ?? null, content.high ?? null].filter((value) => value !== null);
  setAttribute(
    row.strip,
    "aria-label",
    [view.grey && `${GREY[view.grey].stage} `, summary(row.kind, range, limits)].filter(Boolean).join(""),
  );
  return { content, picture, ...view };
}

function summary({ name, unit, help }, [least, most], limits) {
  const span = least <= most ? `${fixed(least)} to ${fixed(most)} ${unit}` : "not known";
  const held = limits.length
    ? `, ${limits.length > 1 ? "limits" : "limit"} ${limits.map((value) => fixed(value)).join(" and ")}`
    : "";
  return `${name}: ${span}${held}. ${help}.`;
}

function buildRow(kind, store) {
  const row = {
    kind,
    value: h("span", { class: "value" }),
    ticks: h("div", { class: "plot-ticks", "aria-hidden": "true" }),
    drawn: null,
  };
  row.strip = h("div", { class: "strip", role: "img", "aria-label": kind.help, data: { strip: kind.key } });
  [row.canvas, row.named, row.empty] = [
    stripCanvas(row.strip),
    h("div", { class: "plot-named" }),
    h("div", { class: "empty" }),
  ];
  row.strip.append(row.canvas.element, row.named, row.empty);
  const drawn = () => {
    const { view } = store.state;
    return (
      row.drawn && {
        kind,
        ...row.drawn,
        plan: drawnPlan(store.state),
        gait: view.document.name ?? "gait",
        feet: view.document.timeline.feet.length,
      }
    );
  };
  row.label = h(
    "div",
    { class: "plot-label" },
    h(
      "div",
      { class: "plot-words" },
      h("span", { class: "name", text: kind.title, title: kind.help }),
      row.value,
      saveButtons(kind, drawn),
    ),
    row.ticks,
  );
  return row;
}

function showSentence(row, sentence) {
  row.drawn = null;
  row.strip.style.setProperty("--lanes", "0px");
  keep(row.ticks, "", () => []);
  row.strip.toggleAttribute("data-empty", true);
  setText(row.empty, sentence);
  setAttribute(row.strip, "aria-label", `${row.kind.name}: ${sentence || "nothing to show."}`);
}

/** The text of a strip that has nothing to draw. */
function emptyWords(state, plan) {
  if (!state.view) return "";
  if (isRefusedDrawing(state)) return "This gait has no motion. The inspector shows the reason.";
  return plan?.refusal ? "This gait has no motion. The timeline shows the reason." : "No plan yet.";
}

/**
 * Shows the legend of all plots: a name for each line style. A preview that has none keeps its row, so that
 * nothing moves.
 */
function showLegend(key, names, isPreview = false) {
  if (names.length > 0 || !isPreview) key.hidden = names.length === 0;
  keep(key, names.map(({ word, dash }) => `${word} ${dash}`).join(), () =>
    names.map(({ word, dash }) =>
      h(
        "span",
        {},
        svg(
          "svg",
          { width: 24, height: 8, "aria-hidden": "true" },
          svg("line", { x1: 0, x2: 24, y1: 4, y2: 4, "stroke-dasharray": dash.join(" ") }),
        ),
        word,
      ),
    ),
  );
}

function render(rows, key, state) {
  const [plan, grey] = [drawnPlan(state), greyOf(state)];
  byId("plots").toggleAttribute("data-iterate", Boolean(state.iterate));
  byId("plots").toggleAttribute("data-grey", grey !== null);
  if (!(plan?.times?.length > 0)) {
    showLegend(key, []);
    rows.forEach((row) => showSentence(row, emptyWords(state, plan)));
    return;
  }
  const axis = axisOf(state);
  const visible = rows.filter(({ strip }) => !strip.hidden);
  const overs = new Map(visible.map((row) => [row, oversOf(state, row.kind.key)]));
  const most = [...overs.values()].reduce(
    (longest, one) => (one.length > longest.length ? one : longest),
    [],
  );
  // One legend is for all strips, so the plan has the same line in each of them.
  const view = {
    axis,
    across: acrossOf(axis, plan.times),
    count: plan.times.length,
    rules: rulesOf(axis, plan),
    grey,
    isUnder: most.length > 0,
  };
  const document = previewedDocument(state);
  for (const row of visible) {
    const content = row.kind.of(plan, document);
    if (!content) {
      showSentence(row, row.kind.lack);
      continue;
    }
    row.drawn = draw(row, content, { ...view, overs: overs.get(row) });
  }
  showLegend(key, lineNames(grey, most, view.isUnder), Boolean(state.preview));
}

/** The series nearest to a height in the strip (0 to 1) at a sample, or null. */
function nearest({ content, picture }, index, height) {
  const near = content.series
    .map((series) => ({ series, value: series.valueAt(index) }))
    .filter(({ value }) => value !== null && Number.isFinite(value));
  const away = ({ series, value }) => Math.abs(picture.scaleFor(series.foot)(value) / HEIGHT - height);
  return (
    near.reduce((best, one) => (best === null || away(one) < away(best) ? one : best), null)?.series ?? null
  );
}

/** Shows the values of all feet at the time under the pointer. */
function mountHover(store, rows) {
  const line = h("div", { class: "plot-line", "aria-hidden": "true", hidden: true });
  const card = plotCard(document.body);
  byId("plots").append(line);
  const hide = () => {
    card.hide();
    line.hidden = true;
  };

  function show(row, event) {
    const { state } = store;
    const plan = drawnPlan(state);
    if (!row.drawn || !plan?.times?.length) return hide();
    const box = row.strip.getBoundingClientRect();
    const axis = axisOf(state);
    const index = indexAt(plan.times, timeAt(axis, (event.clientX - box.left) / box.width));
    const time = plan.times[index];
    const around = byId("plots").getBoundingClientRect();
    line.hidden = false;
    line.style.transform = `translateX(${box.left - around.left + fractionAt(axis, time) * box.width}px)`;
    const [values, grey] = [valuesAt(plan, index), greyOf(state)];
    card.show(event, {
      time,
      robotTime: robotSecondsAt(plan, time),
      roles: state.view.roles ?? [],
      ...values,
      nearest: nearest(row.drawn, index, (event.clientY - box.top) / box.height),
      note: grey ? GREY[grey].value : "",
    });
    return undefined;
  }

  for (const row of rows) onPointed(row.strip, (event) => show(row, event), hide);
  store.watch((state) => [drawnPlan(state), greyOf(state)], hide);
}

/** The menu in the corner of the chart that chooses the strips; the choice is remembered. */
function mountChoice(rows, redraw) {
  const choice = recalled("plots", Object.fromEntries(STRIPS.map(({ key, shown }) => [key, shown])));
  const apply = () =>
    rows.forEach(({ kind, strip, label }) => {
      strip.hidden = label.hidden = !choice[kind.key];
    });
  const menu = checkMenu({
    id: "plots-menu",
    name: "Plots",
    help: "Choose the plots that are shown under the timeline",
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

/** Builds the plots; returns a function that shows the values at a time of the playhead. */
export function mountPlots(store) {
  const rows = STRIPS.map((kind) => buildRow(kind, store));
  const key = h("div", { class: "plot-key", role: "note", "aria-label": "Lines of the plots", hidden: true });
  byId("plots").append(key, ...rows.flatMap(({ label, strip }) => [label, strip]));
  mountChoice(rows, () => render(rows, key, store.state));
  mountHover(store, rows);
  const drawn = (state) => [
    drawnPlan(state),
    greyOf(state),
    isRefusedDrawing(state),
    previewedDocument(state)?.options,
    axisKey(state),
    runOver(state),
    simulationOver(state),
  ];
  store.watch(drawn, (state) => render(rows, key, state));

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
