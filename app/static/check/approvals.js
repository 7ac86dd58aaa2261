/** All approvals of a gait, which one is valid, and what changed between them. */

import { api } from "../api/gaits.js";
import { sentences } from "../lib/difference.js";
import { h } from "../lib/dom.js";
import { clockTime, counted, fixed, shortHash } from "../lib/format.js";
import { ticket } from "../lib/latest_only.js";
import { attempt } from "../lib/toasts.js";
import { ruleNames } from "../state/override.js";

const NOW = "the gait as it is now";

function figuresText({ figures, warnings }) {
  const texts = [
    figures.waypoints && `${figures.waypoints} waypoints, ${fixed(figures.seconds)} s`,
    warnings.length && `${counted(warnings.length, "warning")} seen`,
    figures.simulated && "simulated",
  ];
  return texts.filter(Boolean).join(" · ");
}

function item(record, compare) {
  const { by, when, stands, waypoints_hash: waypoints, warnings, override } = record;
  const state = h("span", {
    class: "approval-state",
    data: { stands: String(stands) },
    text: stands ? "valid" : "no longer valid",
  });
  return h(
    "li",
    { class: "approval" },
    h(
      "span",
      { class: "approval-head" },
      h("b", { text: by }),
      h("span", { class: "quiet", text: clockTime(when), title: when }),
      state,
    ),
    h("span", { class: "quiet", text: figuresText(record), title: warnings.join("\n") || null }),
    override && h("span", { text: `In spite of: ${ruleNames(override.rules)}. ${override.reason}` }),
    h(
      "span",
      { class: "where" },
      h("span", { class: "mono", text: shortHash(waypoints), title: waypoints }),
      h("button", {
        class: "link",
        text: "compare",
        on: { click: () => compare(record) },
        "aria-label": `Compare the approval by ${by}, ${clockTime(when)}, with ${NOW}`,
      }),
    ),
  );
}

/** The part's elements: the list, and what changed since the approval that is looked at. */
function build() {
  const list = h("ul", { class: "findings", role: "list", "aria-label": "Approvals" });
  const against = h("select", { "aria-label": "Approval compared with" });
  const difference = h("div", {
    class: "approval-difference",
    role: "region",
    "aria-label": "What changed",
    tabindex: "0",
    hidden: true,
  });
  const element = h(
    "div",
    { class: "approvals", hidden: true },
    h("h3", { text: "Approvals" }),
    list,
    difference,
  );
  return { element, list, against, difference };
}

/** Builds the part; it is empty while the gait has never been approved. */
export function approvalHistory(store) {
  const { element, list, against, difference } = build();
  let records = [];
  let chosen = null;
  const [beginShow, beginRefresh] = [ticket(), ticket()];

  const show = attempt(async () => {
    const isOld = beginShow();
    const { selected } = store.state;
    const { groups } = await api.approvalDifference(
      selected,
      chosen.number,
      against.value ? Number(against.value) : null,
    );
    if (isOld() || selected !== store.state.selected) return;
    const title = h(
      "label",
      { class: "quiet" },
      `From ${chosen.by}, ${clockTime(chosen.when)}, to `,
      against,
    );
    difference.replaceChildren(title, ...sentences(groups));
    difference.hidden = false;
  });

  function compare(record) {
    chosen = record;
    against.replaceChildren(
      h("option", { value: "", text: NOW }),
      ...records
        .filter(({ number }) => number !== record.number)
        .map(({ number, by, when }) => h("option", { value: number, text: `${by}, ${clockTime(when)}` })),
    );
    show();
  }

  async function refresh() {
    const { selected, view } = store.state;
    const isOld = beginRefresh();
    if (!view) return;
    const { approvals } = await api.approvals(selected);
    if (isOld() || selected !== store.state.selected) return;
    records = approvals;
    element.hidden = !records.length;
    list.replaceChildren(...records.map((record) => item(record, compare)));
    if (!records.some(({ number }) => number === chosen?.number)) {
      chosen = null;
      difference.hidden = true;
    } else if (!difference.hidden) show();
  }

  against.addEventListener("change", show);
  store.watch(
    ({ view }) => [view?.id, view?.revision, view?.approval?.when, view?.verdict?.hash],
    attempt(refresh),
  );
  return element;
}
