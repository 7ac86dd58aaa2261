/** The acts of a table's row, its remark, and its plot, in a line below the row. */

import { publishedApi } from "../api/published.js";
import { h, setAllowed, setText, onPress } from "../lib/dom.js";
import { toast } from "../lib/toasts.js";

/** Each act: its button, the source of the gait, the step that opens then, and a line of help. */
const ACTS = [
  { text: "Open", source: "ours", step: "design", help: "Opens our gait in the step Design" },
  { text: "Simulate", source: "ours", step: "simulate", help: "Opens our gait and begins its simulation" },
  {
    text: "Send…",
    source: "ours",
    step: "run",
    help: "Opens our gait in the step Run. The step names what is missing before the robot may walk",
  },
  {
    text: "Published motion",
    source: "published",
    step: "design",
    help: "Opens the published motion as a gait",
  },
];

const LACKS = {
  ours: "This row has no gait of ours that can be opened.",
  published: "No folder with the published data is named, or the folder has no motion of this row.",
};

const LEGEND =
  "Paths from above, mm. Wide and pale: the plan. Thin: the simulation, at each waypoint's arrival.";

/** The plot, as soon as the studio has drawn it; the reason where it cannot. */
function plotPart(table, { id }, name) {
  const words = h("p", { class: "quiet", role: "status", text: "The studio is drawing the plot…" });
  const element = h("figure", { class: "published-plot" }, words);
  publishedApi.plot(table, id).then(
    (drawn) => {
      const address = URL.createObjectURL(new Blob([drawn], { type: "image/svg+xml" }));
      const forget = () => URL.revokeObjectURL(address);
      const alt = `Paths of the feet of ${name}, seen from above`;
      const caption = h("figcaption", { text: LEGEND });
      element.replaceChildren(caption, h("img", { src: address, alt, on: { load: forget } }));
    },
    ({ message }) => setText(words, message),
  );
  return element;
}

/**
 * Builds the acts and the plot of a row.
 * @param {string} table
 * @param {import("./figures.js").Row} row
 * @param {string} name
 * @param {(row: string, source: string, step: string) => Promise<void>} open
 * @returns {HTMLElement}
 */
export function rowDetail(table, row, name, open) {
  const buttons = ACTS.map(({ text, source, step, help }) => {
    const button = h("button", { text });
    const allow = () => setAllowed(button, row.opens.includes(source) ? null : LACKS[source], help);
    onPress(
      button,
      async () => {
        setAllowed(button, "The studio is opening the gait.");
        await open(row.id, source, step);
        allow();
      },
      toast,
    );
    allow();
    return button;
  });
  return h(
    "div",
    { class: "published-detail", role: "group", "aria-label": name },
    h("div", { class: "buttons" }, ...buttons),
    row.has_plot && plotPart(table, row, name),
  );
}
