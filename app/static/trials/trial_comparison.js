/** Compares a trial with its plan and its simulation in one table, and runs the simulation. */

import { captionedTable } from "../lib/tables.js";
import { request } from "../api/gaits.js";
import { h, setText } from "../lib/dom.js";
import { fixed } from "../lib/format.js";
import { legend } from "./trial_plot.js";
import { attempt } from "../lib/toasts.js";
import { NET_HEAD, NET_HELP, netCells } from "./trial_words.js";

const POLL_MS = 400;

const trial = (id) => `/api/trials/${encodeURIComponent(id)}`;

export const comparisonApi = {
  read: (id) => request("GET", `${trial(id)}/beside`),
  simulate: (id) => request("POST", `${trial(id)}/simulation`),
  scene: (id, lap) => request("GET", `${trial(id)}/scene?lap=${lap}`),
  band: (ids) => request("GET", `/api/trials/band?${new URLSearchParams(ids.map((id) => ["trial", id]))}`),
};

const HELP =
  `${NET_HELP}. Time: from the first to the last frame. `
  + "Last column: mean distance of the feet from the tracked feet at the same phase of each iteration";

function figures({ rows }) {
  const cells = (row) => [fixed(row.seconds, 1), ...netCells(row), fixed(row.gap_mm, 1)];
  const apart = ({ gaps_mm: gaps }) =>
    gaps ? gaps.map((gap, foot) => `foot ${foot + 1}: ${fixed(gap, 1)} mm`).join(", ") : null;
  return captionedTable(
    { class: "run-table trial-comparison", title: HELP },
    "Net movement: planned, simulated, tracked",
    ["", "s", ...NET_HEAD, "feet mm"],
    rows.map((row) =>
      h(
        "tr",
        { title: apart(row) },
        h("th", { scope: "row" }, legend([row.source])),
        ...cells(row).map((text) => h("td", { text })),
      ),
    ),
  );
}

const TEXTS = {
  absent: () => "The simulation of the sent waypoints is being requested.",
  running: ({ share }) =>
    share > 0
      ? `The simulation is running: ${fixed(share * 100, 0)} %.`
      : "The simulation is waiting or starting.",
  failed: ({ sentence }) => `The simulation of this trial failed. ${sentence} `,
  none: ({ sentence }) => sentence,
  done: ({ remark }) => remark ?? "",
};

/**
 * Builds the table, which requests the simulation and follows it until it is done.
 * @param {string} id of the trial
 * @param {(simulated: Record<string, any>|null) => void} shown gets the simulated paths once they are there
 * @returns {{element: HTMLElement, refresh: () => Promise<void>, leave: () => void}}
 */
export function comparisonPart(id, shown) {
  const note = h("p", { class: "quiet", role: "status", "aria-label": "Physics" });
  const again = h("button", { class: "link", text: "Try again", hidden: true });
  const table = h("div");
  const element = h("div", { class: "trial-comparison-part" }, table, h("div", {}, note, again));
  let timer = 0;
  let isClosed = false;

  function showState(simulation) {
    setText(note, TEXTS[simulation.state](simulation));
    again.hidden = simulation.state !== "failed";
  }

  async function refresh() {
    const comparison = await comparisonApi.read(id);
    if (isClosed) return;
    table.replaceChildren(figures(comparison));
    showState(comparison.simulation);
    shown(comparison.simulated);
    if (["absent", "running"].includes(comparison.simulation.state)) follow();
  }

  const follow = attempt(async () => {
    clearTimeout(timer);
    const simulation = await comparisonApi.simulate(id);
    if (isClosed) return;
    if (simulation.state === "done") await refresh();
    else showState(simulation);
    if (simulation.state === "running") timer = setTimeout(follow, POLL_MS);
  });

  again.addEventListener("click", follow);
  return {
    element,
    refresh,
    leave() {
      isClosed = true;
      clearTimeout(timer);
    },
  };
}
