/** Errors that a person may override, and those that they may not. */

import assert from "node:assert/strict";
import { test } from "node:test";

import { errorsOf, overrideText, whyNotOverride } from "../../../app/static/state/override.js";

const finding = (rule, severity, overridable) => ({ rule, severity, overridable, sentence: "" });
const BALANCE = finding("path_balance", "error", true);
const SLIP = finding("slip", "warning", false);
const SHOES = finding("shoe_distance", "error", false);
const DEAF = finding("deafness", "error", false);

test("a verdict without errors, and one with errors that may be overridden, can be approved", () => {
  for (const findings of [[], [SLIP], [BALANCE, SLIP]]) assert.equal(whyNotOverride({ findings }), null);
  assert.equal(whyNotOverride(null), null);
  assert.deepEqual(errorsOf({ findings: [BALANCE, SLIP] }), [BALANCE]);
});

test("one error that cannot be overridden keeps approval off, and each such rule is named once", () => {
  const reason = whyNotOverride({ findings: [SHOES, BALANCE, DEAF, SHOES, SLIP] });
  assert.ok(reason.endsWith("cannot be overridden: shoe distance, deafness."), reason);
});

test("an override is said in a line", () => {
  const override = { rules: ["balance", "path_balance"], reason: "It walked." };
  assert.equal(
    overrideText(override, "Ada"),
    "Approved in spite of: balance, path balance, by Ada: It walked.",
  );
});
