/** The section Check: every rule's outcome, where each finding is, and the approval of exactly this plan. */

import { api } from "../api/gaits.js";
import { approvalHistory } from "./approvals.js";
import { byId, h, onPress, setAllowed } from "../lib/dom.js";
import { capital, counted, fixed, readable, ruleName, shortHash } from "../lib/format.js";
import { needOperator } from "../state/operator.js";
import { openedStep, openStep } from "../steps/steps.js";
import { costTable, sendingFields } from "./sending.js";
import { askOverride, errorsOf, overrideNote, whyNotOverride } from "../state/override.js";
import { checkGone } from "../state/store.js";
import { attempt, toast } from "../lib/toasts.js";

const CHECK_HELP = "Tests every rule on the waypoints that would be sent to the robot";
const APPROVED_ONCE = "After an edit or a new simulation, you must approve the gait again.";
const OVERRIDE_WHY = "You may approve in spite of these errors. Approve asks for the reason.";
const OVERRIDE_HELP = "Approve asks for a reason, and the studio saves it with the approval";

function findingItem(finding, goTo) {
  const place = [
    finding.foot !== null && `foot ${finding.foot + 1}`,
    finding.actuator !== null && finding.actuator !== undefined && `motor ${finding.actuator + 1}`,
    finding.sample !== null && `sample ${finding.sample + 1}`,
  ]
    .filter(Boolean)
    .join(", ");
  return h(
    "li",
    { class: "finding" },
    h("span", { class: "dot", data: { tone: finding.severity === "error" ? "bad" : "caution" } }),
    h("span", {}, h("b", { text: finding.severity === "error" ? "Error: " : "Warning: " }), finding.sentence),
    h(
      "span",
      { class: "where" },
      finding.overridable && h("span", { text: "may be overridden", title: OVERRIDE_HELP }),
      place && h("span", { text: place }),
      finding.time !== null
        && h("span", {
          text: `${fixed(finding.time)} s${finding.rule.startsWith("simulated_") ? " of the robot" : ""}`,
        }),
      finding.sample !== null
        && h("button", {
          class: "link",
          text: "go to",
          "aria-label": `Go to ${place}`,
          on: { click: () => goTo(finding) },
        }),
    ),
  );
}

const MARGIN_HELP =
  "Smallest distance to the limit of this rule during the whole motion. "
  + "Below 0, the motion exceeds the limit";

function marginList(margins) {
  const rows = margins.flatMap(({ rule, margin, unit }) => {
    const shown = readable(margin, unit);
    return [
      h("dt", { text: ruleName(rule), title: MARGIN_HELP }),
      h("dd", { text: shown.value, data: margin < 0 ? { broken: "" } : {} }),
      h("dd", { class: "unit", text: shown.unit }),
    ];
  });
  return [h("h3", { text: "Distance to the limits" }), h("dl", { class: "margins" }, ...rows)];
}

const warningsOf = (verdict) => (verdict?.findings ?? []).filter(({ severity }) => severity === "warning");

/** What is said of a gait that is not checked: why it is not any more, if it was once. */
function uncheckedNote(view, before) {
  const isOld = Boolean(before || view.revoked);
  const why =
    view.revoked
    || (before?.word === "approved"
      ? "The gait changed, so it is no longer approved."
      : before && `${capital(checkGone(view, before))}.`);
  const text = isOld
    ? `${why} Check the gait again.`
    : "Press Check to test every rule on the waypoints that would be sent to the robot.";
  return h("p", { class: isOld ? "box-note" : "why", data: { tone: isOld ? "caution" : "plain" }, text });
}

const isCheckNext = (view) => !view?.verdict?.passed && !view?.approval?.override;

const approvalNote = ({ passed }) => (passed ? APPROVED_ONCE : OVERRIDE_WHY);

/** What is to be done about the findings. */
function adviceOn(verdict) {
  if (verdict.passed) return "Read the findings before you approve.";
  if (whyNotOverride(verdict)) return "Errors block approval.";
  const tick = warningsOf(verdict).length ? "tick that you have seen the warnings and " : "";
  return `Correct the gait, or ${tick}press Approve to override the errors with a reason.`;
}

function summary(view, before) {
  const { verdict } = view;
  if (!verdict) return uncheckedNote(view, before);
  const warnings = warningsOf(verdict).length;
  const errors = errorsOf(verdict).length;
  if (!errors && !warnings) return "";
  const counts = [errors && counted(errors, "error"), warnings && counted(warnings, "warning")]
    .filter(Boolean)
    .join(", ");
  const text = view.approval?.override ? `${counts}.` : `${counts}. ${adviceOn(verdict)}`;
  return h("p", { class: "box-note", data: { tone: verdict.passed ? "caution" : "bad" } }, h("b", { text }));
}

const WAYPOINTS_HELP =
  "Hash (fingerprint) of the approved waypoints. A waypoint is one message to the motors";
const VERDICT_HELP = "Hash (fingerprint) of the approved check";

function approvalBox({ approval }) {
  if (!approval) return "";
  return h(
    "dl",
    { class: "box-note summary", data: { tone: "good" } },
    h("dt", { text: "Waypoints", title: WAYPOINTS_HELP }),
    h("dd", { class: "mono", text: shortHash(approval.waypoints_hash), title: approval.waypoints_hash }),
    h("dt", { text: "Verdict", title: VERDICT_HELP }),
    h("dd", { class: "mono", text: shortHash(approval.verdict_hash), title: approval.verdict_hash }),
    ...(approval.warnings.length
      ? [
          h("dt", { text: "Warnings seen" }),
          h("dd", { text: approval.warnings.length, title: approval.warnings.join("\n") }),
        ]
      : []),
  );
}

/** Whether the motors cannot make the motion; the check then lists everything that is wrong with it. */
const isBeyondRange = ({ source, refusal, times }) =>
  Boolean(refusal) && times.length > 0 && ["recorded", "manual"].includes(source);

function whyNotCheck({ view, pending }) {
  if (!view) return "No gait is selected.";
  if (pending.length) return "The studio is still saving your last edit.";
  if (view.plan?.live?.status === "infeasible")
    return "There is no motion to check. The Design step shows what is wrong and suggests changes.";
  if (!view.plan || (view.plan.refusal && !isBeyondRange(view.plan))) {
    return view.plan?.refusal?.sentence ?? "There is no plan to check. Press Optimise first.";
  }
  return null;
}

function whyNotApprove({ view, pending, seenWarnings }) {
  if (!view?.verdict || pending.length) return "Check this version of the gait first.";
  if (view.approval) return `${view.approval.by} has already approved this gait.`;
  const reason = whyNotOverride(view.verdict);
  if (reason) return reason;
  if (warningsOf(view.verdict).length && seenWarnings !== view.verdict.hash)
    return "There are warnings. Read each warning, then tick “I have seen …”.";
  return null;
}

/** The tick that goes with warnings; it is for one verdict only. */
function warningTick(store) {
  const box = h("input", { type: "checkbox" });
  const count = h("span");
  const element = h("label", { class: "tick", hidden: true }, box, count);
  box.addEventListener("change", () =>
    store.set({ seenWarnings: box.checked ? (store.state.view?.verdict?.hash ?? null) : null }),
  );
  const show = ({ view, seenWarnings }) => {
    const warnings = warningsOf(view?.verdict);
    element.hidden = !warnings.length || Boolean(view.approval || whyNotOverride(view.verdict));
    box.checked = seenWarnings !== undefined && seenWarnings === view?.verdict?.hash;
    count.textContent =
      warnings.length === 1 ? "I have seen this warning" : `I have seen these ${warnings.length} warnings`;
  };
  return { element, show };
}

async function approve(store) {
  const { selected, view } = store.state;
  const by = await needOperator(store, "The studio saves your name and the time with the approval.");
  if (!by) return;
  const errors = errorsOf(view.verdict);
  const override = errors.length ? await askOverride(errors) : null;
  if (errors.length && !override) return;
  if (store.state.selected !== selected || store.state.view?.plan?.hash !== view.plan.hash) {
    toast("The gait has changed since the check. Check the gait again.");
    return;
  }
  const approval = await api.approve(
    selected,
    by,
    view.verdict.hash,
    store.state.seenWarnings === view.verdict.hash,
    override,
  );
  if (store.state.selected !== selected || store.state.view?.revision !== view.revision) return;
  store.set({
    view: { ...store.state.view, approval, revoked: null },
    checked: {
      ...store.state.checked,
      [selected]: { word: "approved", revision: store.state.view.revision },
    },
  });
  if (openedStep() === "check") openStep("run");
}

async function check(store) {
  const { selected, view } = store.state;
  const verdict = await api.check(selected);
  if (store.state.selected !== selected || store.state.view?.revision !== view.revision) return;
  const seen = store.state.checked[selected];
  store.set({
    view: { ...store.state.view, verdict },
    checked: {
      ...store.state.checked,
      [selected]: {
        word: seen?.word === "approved" && store.state.view.approval ? seen.word : "checked",
        revision: view.revision,
      },
    },
  });
}

/** Builds the section; `goTo` shows a finding's place. */
export function mountCheck(store, edits, goTo) {
  const checkButton = h("button", { id: "act-check", text: "Check" });
  const approveButton = h("button", { id: "act-approve", text: "Approve" });
  const why = h("p", { class: "why" });
  const [head, body, foot] = [h("div"), h("div", { class: "findings" }), h("div")];
  onPress(
    checkButton,
    attempt(() => check(store)),
    (reason) => toast(reason),
  );
  onPress(
    approveButton,
    attempt(() => approve(store)),
    (reason) => toast(reason),
  );
  const tick = warningTick(store);
  byId("foot-check").append(tick.element, h("div", { class: "solve" }, checkButton, approveButton), why);
  byId("check").append(
    overrideNote(store),
    head,
    sendingFields(store, edits),
    body,
    foot,
    approvalHistory(store),
  );

  store.watch(
    ({ view, pending, checked, seenWarnings }) => [view, pending.length, checked, seenWarnings],
    (state) => {
      tick.show(state);
      const { view, checked } = state;
      setAllowed(checkButton, whyNotCheck(state), CHECK_HELP);
      const blocked = whyNotApprove(state);
      setAllowed(
        approveButton,
        blocked,
        "Allows the studio to send exactly the checked waypoints to the robot",
      );
      checkButton.classList.toggle("primary", isCheckNext(view));
      approveButton.classList.toggle("primary", !blocked && !isCheckNext(view));
      why.textContent = view?.approval ? "" : (blocked ?? approvalNote(view.verdict));
      if (!view) return;
      head.replaceChildren(summary(view, checked[view.id]));
      foot.replaceChildren(approvalBox(view));
      const findings = (view.verdict?.findings ?? []).map((finding) => findingItem(finding, goTo));
      body.replaceChildren(
        ...(findings.length
          ? [
              h("h3", { text: "Findings" }),
              h("ul", { class: "findings", role: "list", "aria-label": "Findings" }, ...findings),
            ]
          : []),
        ...costTable(view.verdict),
        ...(view.verdict?.margins?.length ? marginList(view.verdict.margins) : []),
      );
    },
  );
}
