/** The legend at the lower right of the stage: the marks on the floor, and the margin at the playhead. */

import { byId, h, setText, svg } from "../lib/dom.js";
import { mm } from "../lib/format.js";
import { indexAt } from "../plots/curves.js";
import { drawnPlan, greyOf } from "../state/worked_plan.js";

/** The usual symbol of a centre of mass in drawings. */
const centreMark = () =>
  svg(
    "svg",
    { class: "centre-mark", viewBox: "-6 -6 12 12", "aria-hidden": "true" },
    svg("circle", { r: 5 }),
    svg("path", { d: "M0 0V-4A4 4 0 0 1 4 0ZM0 0V4A4 4 0 0 1 -4 0Z" }),
  );

const footEntry = (role, foot) =>
  h(
    "span",
    { data: { foot: foot + 1 }, title: `Foot ${foot + 1}: ${role}` },
    h("i", { class: "foot-dot" }),
    String(foot + 1),
  );

const feetEntries = (roles) => [h("span", { text: "foot" }), ...roles.map(footEntry)];

/** Margin of the drawn plan at a time, m; null if it has none. */
function marginAt(plan, time) {
  return plan?.margin && plan.times.length ? (plan.margin[indexAt(plan.times, time)] ?? null) : null;
}

/** The lifted feet as text for screen readers. */
function liftedText(plan, roles, time) {
  const contact = plan?.times.length ? plan.contact?.[indexAt(plan.times, time)] : null;
  if (!contact) return "";
  const lifted = roles.flatMap((role, foot) => (contact[foot] === false ? [`${foot + 1} ${role}`] : []));
  return lifted.length ? `feet in the air: ${lifted.join(", ")}` : "all feet are on the ground";
}

/**
 * Builds the legend.
 * @param {import("../state/store.js").Store} store
 * @param {import("../preview/playback.js").Playback} playback
 * @returns {{show: (layer: string, shown: boolean) => void}} `show` follows a layer of the menu Show
 */
export function mountLegend(store, playback) {
  const legend = byId("legend");
  const margin = h("span", { class: "legend-margin" });
  const lifted = h("span", { class: "hidden-text" });
  const feet = h("span", { class: "legend-feet", hidden: true });
  const swatch = h("i", { class: "area-swatch", "aria-hidden": "true" });
  const area = h("span", { class: "legend-area" }, swatch, "area between standing feet");
  const centre = h("span", { class: "legend-centre" }, centreMark(), "centre of mass");
  legend.replaceChildren(feet, area, centre, margin, lifted);

  function render() {
    const { state } = store;
    const plan = drawnPlan(state);
    const grey = greyOf(state);
    const value = grey === null ? marginAt(plan, playback.time) : null;
    legend.toggleAttribute("data-grey", grey !== null);
    setText(margin, value === null ? "" : `margin ${mm(value)} mm`);
    margin.dataset.tone = value !== null && value < 0 ? "bad" : "";
    setText(lifted, liftedText(plan, state.view?.roles ?? [], playback.time));
    const isEmpty = !state.view || [area, centre, feet].every((entry) => entry.hidden);
    if (legend.hidden !== isEmpty) legend.hidden = isEmpty;
  }

  playback.addEventListener("time", render);
  store.watch(
    (state) => [drawnPlan(state), greyOf(state), state.view?.roles],
    ({ view }) => {
      feet.replaceChildren(...feetEntries(view?.roles ?? []));
      render();
    },
  );
  const entries = {
    polygon: (shown) => {
      area.hidden = !shown;
    },
    com: (shown) => {
      centre.hidden = !shown;
    },
    labels: (shown) => {
      feet.hidden = shown;
    },
  };
  return {
    show(layer, shown) {
      entries[layer]?.(shown);
      margin.hidden = Boolean(area.hidden && centre.hidden);
      render();
    },
  };
}
