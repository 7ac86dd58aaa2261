/**
 * The shown window of the time axis: closer, further, along, and all of it.
 *
 * The window is the store's field `zoom` ({first, shown} in columns, null for all); `axisOf` keeps it on
 * the timeline.
 */

import { clamp } from "../lib/clamp.js";
import { axisOf, fractionAt, LEAST_SHOWN, placeAt, placeOf } from "../state/time_axis.js";
import { byId, h, setAttribute } from "../lib/dom.js";

const STEP = 1.5;
const WHEEL = 0.0025;

/** @param {import("../state/store.js").Store} store */
export function createZoom(store) {
  const axis = () => axisOf(store.state);
  const show = (first, shown) => {
    const { columns } = axis();
    const width = clamp(shown, Math.min(LEAST_SHOWN, columns), columns);
    const zoom = width >= columns - 1e-6 ? null : { first: clamp(first, 0, columns - width), shown: width };
    const before = store.state.zoom;
    if (zoom?.first !== before?.first || zoom?.shown !== before?.shown) store.set({ zoom });
  };
  return {
    /** Shows more or fewer columns; what is at the fraction of the window stays there. */
    by(factor, fraction = 0.5) {
      const { first, shown, columns } = axis();
      const width = clamp(shown / factor, Math.min(LEAST_SHOWN, columns), columns);
      show(first + fraction * (shown - width), width);
    },
    pan: (columns) => show(axis().first + columns, axis().shown),
    to: (first) => show(first, axis().shown),
    fit: () => store.set({ zoom: null }),
    /** Brings a column into the window, with a little room around it. */
    reveal(column) {
      const { first, shown } = axis();
      const room = Math.min(1, shown / 8);
      const [left, right] = [placeOf(axis(), column), placeOf(axis(), column + 1)];
      if (left < first + room) show(left - room, shown);
      else if (right > first + shown - room) show(right + room - shown, shown);
    },
    /** Turns the page where the playhead has left the window. */
    follow(time) {
      const { shown } = axis();
      const fraction = fractionAt(axis(), time);
      if (fraction < 0 || fraction > 1) show(placeAt(axis(), time) - shown / 10, shown);
    },
  };
}

function mountWheel(chart, zoom, store) {
  const fractionOf = (x) => {
    const box = byId("ruler").getBoundingClientRect();
    return clamp((x - box.left) / box.width, 0, 1);
  };
  chart.addEventListener(
    "wheel",
    (event) => {
      if (event.ctrlKey || event.metaKey)
        zoom.by(Math.exp(-event.deltaY * WHEEL * (event.deltaMode ? 20 : 1)), fractionOf(event.clientX));
      else if (store.state.zoom)
        zoom.pan(((event.deltaX || event.deltaY) * axisOf(store.state).shown) / 1000);
      else return;
      event.preventDefault();
    },
    { passive: false },
  );
  return fractionOf;
}

/**
 * Two fingers: their distance is the zoom, their middle takes the window along. `began` ends what one finger
 * has begun.
 */
function mountPinch(chart, zoom, { fractionOf, shownColumns, began }) {
  const fingers = new Map();
  const spread = () => {
    const [one, other] = [...fingers.values()];
    return { distance: Math.max(20, Math.abs(one - other)), middle: (one + other) / 2 };
  };
  chart.addEventListener(
    "pointerdown",
    (event) => {
      if (event.pointerType !== "touch") return;
      fingers.set(event.pointerId, event.clientX);
      if (fingers.size === 2) began();
      if (fingers.size > 1) event.stopPropagation();
    },
    true,
  );
  chart.addEventListener(
    "pointermove",
    (event) => {
      if (!fingers.has(event.pointerId)) return;
      const before = fingers.size === 2 ? spread() : null;
      fingers.set(event.pointerId, event.clientX);
      if (!before) return;
      const { distance, middle } = spread();
      zoom.pan((fractionOf(before.middle) - fractionOf(middle)) * shownColumns());
      zoom.by(distance / before.distance, fractionOf(middle));
      event.stopPropagation();
    },
    true,
  );
  for (const type of ["pointerup", "pointercancel"])
    chart.addEventListener(type, (event) => fingers.delete(event.pointerId), true);
}

/** A bar under the plots that shows which part of the timeline is in the window; it can be dragged. */
function mountBar(chart, zoom, store) {
  const thumb = h("div", { class: "zoom-thumb" });
  const bar = h(
    "div",
    {
      class: "zoom-bar",
      role: "scrollbar",
      "aria-label": "Shown part of the timeline",
      "aria-controls": "timeline",
      "aria-orientation": "horizontal",
      "aria-valuemin": 0,
      title:
        "Shown part of the timeline. Drag the bar to see another part, or press F to see the whole timeline",
      hidden: true,
    },
    thumb,
  );
  chart.append(bar);
  let held = null;
  thumb.addEventListener("pointerdown", (event) => {
    held = { x: event.clientX, first: axisOf(store.state).first, width: bar.getBoundingClientRect().width };
    thumb.setPointerCapture(event.pointerId);
  });
  thumb.addEventListener("pointermove", (event) => {
    if (held) zoom.to(held.first + ((event.clientX - held.x) / held.width) * axisOf(store.state).columns);
  });
  for (const type of ["pointerup", "pointercancel"])
    thumb.addEventListener(type, () => {
      held = null;
    });
  store.watch(
    (state) => [state.zoom, axisOf(state).columns],
    (state) => {
      const { first, shown, columns } = axisOf(state);
      bar.hidden = !state.zoom;
      setAttribute(bar, "aria-valuemax", Math.round(columns - shown));
      setAttribute(bar, "aria-valuenow", Math.round(first));
      thumb.style.left = `${(100 * first) / columns}%`;
      thumb.style.width = `${(100 * shown) / columns}%`;
    },
  );
}

/**
 * Wires wheel, pinch and the bar, and keeps the playhead in the window.
 * @param {import("../state/store.js").Store} store
 * @param {import("../preview/playback.js").Playback} playback
 * @param {Record<string, any>} zoom of `createZoom`
 * @param {() => void} endGesture
 */
export function mountZoom(store, playback, zoom, endGesture) {
  const chart = byId("chart");
  const fractionOf = mountWheel(chart, zoom, store);
  mountPinch(chart, zoom, { fractionOf, shownColumns: () => axisOf(store.state).shown, began: endGesture });
  mountBar(chart, zoom, store);
  playback.addEventListener("time", (/** @type {CustomEvent} */ { detail }) => {
    if (store.state.zoom && detail.cause !== "plan") zoom.follow(detail.time);
  });
}

/** Closer or further about the playhead where it is in the window, else about the middle. */
export function zoomAtPlayhead(store, playback, zoom, closer) {
  const fraction = fractionAt(axisOf(store.state), playback.time);
  zoom.by(closer ? STEP : 1 / STEP, fraction >= 0 && fraction <= 1 ? fraction : 0.5);
}
