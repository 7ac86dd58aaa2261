/** The Segments section: the segment table of a manual gait, to be read. */

import { byId, h } from "./dom.js";

const EMPTY = "This gait has no segment table: its footfalls are drawn on the timeline. Manual gaits (pick one in the list) "
  + "are written as a table instead: in each segment every foot does one named thing, such as Push A, Lift B or Wait.";

function cell(text, foot, swings) {
  const data = swings ? { foot: foot + 1, swing: "" } : { foot: foot + 1 };
  return h("div", { role: "gridcell", text, title: `${text}: ${swings ? "in the air" : "on the ground"}`, data });
}

function header(roles, count) {
  return h("div", { role: "row" }, h("div", { role: "columnheader", title: "Segment", text: "#" }),
    ...Array.from({ length: count }, (_, foot) =>
      h("div", { role: "columnheader", title: `Foot ${foot + 1}`, data: { foot: foot + 1 } }, h("i", { class: "foot-dot" }), `${foot + 1} ${roles[foot] ?? ""}`)));
}

function table(segments, roles) {
  const { feet, swings } = segments;
  const inTheAir = new Set(swings);
  const rows = feet[0].map((_, index) =>
    h("div", { role: "row" }, h("div", { role: "rowheader", text: String(index + 1) }), ...feet.map((row, foot) => cell(row[index], foot, inTheAir.has(row[index])))));
  const grid = h("div", { class: "table", role: "grid", "aria-label": "Segment table", "aria-readonly": "true" }, header(roles, feet.length), ...rows);
  grid.style.setProperty("--feet", feet.length);
  return grid;
}

/** Builds the section. */
export function mountSegments(store) {
  store.watch(({ view }) => [view?.id, view?.segments, view?.notice, view?.roles], ({ view }) => {
    const segments = view?.segments;
    const parts = [h("h3", {}, "Segment table", segments && h("span", { text: `${segments.samples_per_segment} samples a segment` }))];
    if (segments) parts.push(table(segments, view.roles ?? []));
    else if (view) {
      if (view.notice) parts.push(h("p", { class: "box-note", data: { tone: "caution" }, text: view.notice }));
      parts.push(h("p", { class: "teach", text: EMPTY }), h("div", { class: "table", role: "grid", "aria-label": "Segment table", "aria-readonly": "true" },
        header(view.roles ?? [], view.document.timeline.feet.length)));
      parts.at(-1).style.setProperty("--feet", view.document.timeline.feet.length);
    }
    byId("segments").replaceChildren(...parts);
  });
}
