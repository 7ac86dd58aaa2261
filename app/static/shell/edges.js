/** The upright edges: width of drawer and inspector, the inspector's height as a sheet. Remembered. */

import { clamp } from "../lib/clamp.js";
import { byId, h, setAttribute } from "../lib/dom.js";
import { remember, remembered } from "../lib/remembered.js";

const STEP_PX = 16;
const LEAST_STAGE_PX = 320;
const HELP =
  "To change the size, drag this edge or press an arrow key. "
  + "Double click or Enter restores the usual size";

/**
 * An edge that sets a size of the page.
 * @param {{name: string, variable: () => string, least: number, most: () => number, size: () => number,
 *   grows: 1|-1, axis: "x"|"y", edge: HTMLElement}} options
 *   `grows`: 1 where the size grows with the pointer's place
 */
function mountEdge({ name, variable, least, most, size, grows, axis, edge }) {
  const kept = remembered(`edge.${name}`);
  const root = document.body.style;
  const apply = () =>
    Object.entries(kept).forEach(([key, value]) => {
      if (Number.isFinite(value)) root.setProperty(key, `${clamp(value, least, Math.max(least, most()))}px`);
    });
  const say = () => {
    setAttribute(edge, "aria-valuemin", String(least));
    setAttribute(edge, "aria-valuemax", String(Math.round(Math.max(least, most()))));
    setAttribute(edge, "aria-valuenow", String(Math.round(size())));
  };
  const setTo = (value) => {
    kept[variable()] = Math.round(value);
    apply();
    say();
  };
  const keep = () => remember(`edge.${name}`, kept);
  const usual = () => {
    delete kept[variable()];
    root.removeProperty(variable());
    say();
    keep();
  };
  let held = null;
  edge.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    held = { at: axis === "x" ? event.clientX : event.clientY, from: size() };
    edge.setPointerCapture(event.pointerId);
    edge.dataset.held = "";
  });
  edge.addEventListener("pointermove", (event) => {
    if (held) setTo(held.from + grows * ((axis === "x" ? event.clientX : event.clientY) - held.at));
  });
  for (const type of ["pointerup", "pointercancel"]) {
    edge.addEventListener(type, () => {
      if (held) keep();
      held = null;
      delete edge.dataset.held;
    });
  }
  edge.addEventListener("dblclick", usual);
  edge.addEventListener("keydown", (event) => {
    const along = axis === "x" ? { ArrowRight: 1, ArrowLeft: -1 } : { ArrowDown: 1, ArrowUp: -1 };
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    if (event.key === "Enter") usual();
    else if (along[event.key]) setTo(size() + along[event.key] * grows * STEP_PX * (event.shiftKey ? 4 : 1));
    else return;
    event.preventDefault();
    keep();
  });
  new ResizeObserver(() => {
    apply();
    say();
  }).observe(document.body);
  apply();
}

const separator = (label, orientation) =>
  h("div", {
    class: "edge upright-edge",
    role: "separator",
    tabindex: "0",
    "aria-orientation": orientation,
    "aria-label": label,
    title: `${label}. ${HELP}`,
    data: { arrows: "" },
  });

/** Builds the edges. */
export function mountEdges() {
  const [drawers, inspector] = [byId("drawers"), byId("inspector")];
  const [drawerEdge, inspectorEdge] = [
    separator("Width of the drawer", "vertical"),
    separator("Width of the inspector", "vertical"),
  ];
  const handle = h("div", {
    class: "sheet-handle",
    role: "separator",
    tabindex: "0",
    "aria-orientation": "horizontal",
    "aria-label": "Height of the inspector",
    title: `Height of the inspector. ${HELP}`,
    data: { arrows: "" },
  });
  drawers.append(drawerEdge);
  inspector.append(inspectorEdge, handle);
  const isWide = () => ["runs", "trials"].includes(document.body.dataset.drawer);
  /** Whether a drawer stands beside the stage; that of published experiments lies over it. */
  const isBeside = () => ![undefined, "published"].includes(document.body.dataset.drawer);
  const rest = (own) => window.innerWidth - LEAST_STAGE_PX - byId("rail-gaits").offsetWidth - own;
  mountEdge({
    name: "drawer",
    variable: () => (isWide() ? "--drawer-wider" : "--drawer-wide"),
    least: 232,
    most: () => Math.min(560, rest(inspector.offsetWidth)),
    size: () => drawers.offsetWidth,
    grows: 1,
    axis: "x",
    edge: drawerEdge,
  });
  mountEdge({
    name: "inspector",
    variable: () => "--right-kept",
    least: 320,
    most: () => Math.min(560, rest(isBeside() ? drawers.offsetWidth : 0)),
    size: () => inspector.offsetWidth,
    grows: -1,
    axis: "x",
    edge: inspectorEdge,
  });
  mountEdge({
    name: "sheet",
    variable: () => "--sheet-kept",
    least: 120,
    most: () => window.innerHeight * 0.6,
    size: () => inspector.offsetHeight,
    grows: -1,
    axis: "y",
    edge: handle,
  });
}
