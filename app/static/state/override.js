/** Approvals in spite of errors: what may be overridden, the question for the reason, and the note on it. */

import { dialogFrame, openDialog } from "../lib/dialogs.js";
import { h, setText } from "../lib/dom.js";
import { lowered, ruleName } from "../lib/format.js";

const MOST_REASON = 300;

/** @typedef {{rules: string[], reason: string}} Override */
/** @typedef {{rule: string, severity: string, sentence: string, overridable: boolean}} Finding */

/** The errors of a verdict. @param {{findings: Finding[]}|null|undefined} verdict */
export const errorsOf = (verdict) => (verdict?.findings ?? []).filter(({ severity }) => severity === "error");

/** The rules of findings, each once. @param {Finding[]} findings */
const rulesOf = (findings) => [...new Set(findings.map(({ rule }) => rule))];

/** Rules for people, as a list in a sentence. @param {string[]} rules */
export const ruleNames = (rules) => rules.map((rule) => lowered(ruleName(rule))).join(", ");

/**
 * Why nobody may approve in spite of a verdict's errors, in a sentence; null where a person may.
 * @param {{findings: Finding[]}|null|undefined} verdict
 */
export function whyNotOverride(verdict) {
  const final = rulesOf(errorsOf(verdict).filter(({ overridable }) => !overridable));
  return final.length
    ? `The check failed. Errors of these rules cannot be overridden: ${ruleNames(final)}.`
    : null;
}

/**
 * What an override says, in a line.
 * @param {Override} override
 * @param {string} by
 */
export const overrideText = ({ rules, reason }, by) =>
  `Approved in spite of: ${ruleNames(rules)}, by ${by}: ${reason}`;

/**
 * A note on the shown gait's approval; hidden where that is not in spite of errors.
 * @param {import("./store.js").Store} store
 */
export function overrideNote(store) {
  const note = h("p", { class: "box-note", role: "note", data: { tone: "caution" } });
  store.watch(
    ({ view }) => [view?.approval],
    ({ view }) => {
      const { override, by } = view?.approval ?? {};
      note.hidden = !override;
      setText(note, override ? overrideText(override, by) : "");
    },
  );
  return note;
}

/**
 * Asks for the reason to approve in spite of errors; resolves to the override, or to null.
 * @param {Finding[]} errors
 * @returns {Promise<Override|null>}
 */
export function askOverride(errors) {
  const rules = rulesOf(errors);
  return openDialog((close) => {
    const reason = h("input", {
      "aria-label": "Reason",
      placeholder: "Why the robot may move, for example: walked on 3 May",
      maxlength: String(MOST_REASON),
      autocomplete: "off",
      required: true,
    });
    const accept = () => {
      if (reason.value.trim()) close({ rules, reason: reason.value.trim() });
    };
    const items = errors.map(({ rule, sentence }) =>
      h("li", {}, h("b", { text: `${ruleName(rule)}: ` }), sentence),
    );
    return dialogFrame(
      "Approve in spite of these errors?",
      close,
      accept,
      h(
        "ul",
        { class: "override-errors", "aria-label": "Errors that you override", tabindex: "0" },
        ...items,
      ),
      h("p", {
        class: "quiet",
        text: "The studio saves your name, these errors and the reason with the approval and with every run.",
      }),
      h("label", { class: "override-reason" }, h("span", { text: "Reason" }), reason),
      h(
        "div",
        { class: "buttons" },
        h("button", { type: "button", text: "Cancel", on: { click: () => close(null) } }),
        h("button", { type: "submit", class: "primary", text: "Approve in spite of errors" }),
      ),
    );
  });
}
