"""Overrides: which rules may be overridden, what an approval in spite of errors needs, and what it covers."""

from __future__ import annotations

import re
from dataclasses import replace
from datetime import UTC, datetime

import pytest

from core.errors import InputError, StateError
from core.findings import Finding, Severity, Verdict, approve, override_all
from core.overrides import FINAL, MOST_REASON, OVERRIDABLE, OverrideRequest
from tests.support.studio_process import PROJECT

NOON = datetime(2026, 11, 21, 12, tzinfo=UTC)
REASON = "It walked on the real robot."


def error(rule: str, sample: int = 3) -> Finding:
    return Finding(rule, Severity.ERROR, f"{rule} is broken.", -0.004, 0.0, sample)


WARNING = Finding("slip", Severity.WARNING, "Foot 1 slides.", 0.001, 0.0005, foot=0)


def verdict(*rules: str) -> Verdict:
    return Verdict("0" * 64, (*(error(rule) for rule in rules), WARNING), ())


def override(of: Verdict, *rules: str, reason: str = REASON) -> None:
    approve(of, "Ada", NOON, accept_warnings=True, override=OverrideRequest(rules, reason))


def test_the_rules_that_keep_the_motors_and_the_plan_are_never_overridden() -> None:
    never = {"range", "stroke", "duration", "deafness", "coupling", "computed", "fresh", "shoe_distance"}
    assert never <= FINAL.keys()
    assert not OVERRIDABLE.keys() & FINAL.keys()
    assert not error("shoe_distance").is_overridable
    assert error("balance").is_overridable
    assert not WARNING.is_overridable


def test_the_page_bounds_a_reason_as_the_studio_does() -> None:
    page = (PROJECT / "app/static/state/override.js").read_text()
    assert re.findall(r"const MOST_REASON = (\d+);", page) == [str(MOST_REASON)]


def test_an_approval_in_spite_of_errors_keeps_rules_reason_and_what_stood() -> None:
    of = verdict("balance", "path_balance", "balance")
    request = OverrideRequest(("path_balance", "balance"), f"  {REASON} ")
    given = approve(of, "Ada", NOON, accept_warnings=True, override=request).override
    assert given is not None
    assert (given.rules, given.reason) == (("balance", "path_balance"), REASON)
    assert given.errors == of.errors
    assert override_all(of, REASON).rules == given.rules


@pytest.mark.parametrize("reason", ["", "  \t", "\u2800", "x" * (MOST_REASON + 1)])
def test_a_reason_is_needed_and_bounded(reason: str) -> None:
    with pytest.raises(InputError, match=f"a reason of 1 to {MOST_REASON} characters"):
        override(verdict("balance"), "balance", reason=reason)
    with pytest.raises(InputError, match="a reason of 1 to"):
        override_all(verdict("balance"), reason)


@pytest.mark.parametrize(
    ("rules", "kind", "sentence"),
    [
        ((), InputError, "must name the rules"),
        (("deafness",), InputError, "rule “deafness” cannot be overridden. It keeps what is sent within"),
        (("balance", "shoe_distance"), InputError, "cannot be overridden. Parts of the robot would meet"),
        (("walks",), InputError, "no rule “walks” that may be overridden. These may be: balance"),
        (("balance", "travel"), StateError, "No error of the rule “travel” stands"),
        (("slip", "balance"), StateError, "No error of the rule “slip” stands"),
        (("path_balance",), StateError, r"Errors block approval \(1\). First: balance is broken"),
    ],
)
def test_an_override_is_of_the_errors_that_stand(
    rules: tuple[str, ...], kind: type[Exception], sentence: str
) -> None:
    with pytest.raises(kind, match=sentence):
        override(verdict("balance", "path_balance"), *rules)


def test_an_override_of_everything_refuses_what_cannot_be_and_where_nothing_stands() -> None:
    with pytest.raises(InputError, match=r"deafness is broken\. Errors of the rule “deafness” cannot be"):
        override_all(verdict("balance", "deafness"), REASON)
    with pytest.raises(InputError, match="No error stands"):
        override_all(verdict(), REASON)
    with pytest.raises(StateError, match="No error of the rule “balance” stands"):
        override(verdict(), "balance")


def test_warnings_want_their_tick_and_the_person_a_name_also_in_spite_of_errors() -> None:
    request = OverrideRequest(("balance",), REASON)
    with pytest.raises(StateError, match="1 warning is not accepted yet"):
        approve(verdict("balance"), "Ada", NOON, override=request)
    with pytest.raises(StateError, match="needs the name"):
        approve(verdict("balance"), " ", NOON, accept_warnings=True, override=request)


def test_a_new_error_is_one_at_another_place_too_and_a_vanished_one_or_a_warning_is_none() -> None:
    of = verdict("balance", "path_balance")
    given = approve(of, "Ada", NOON, accept_warnings=True, override=override_all(of, REASON)).override
    assert given is not None
    assert given.new_error(of) is None
    assert given.new_error(verdict("balance")) is None
    assert given.new_error(verdict()) is None
    milder = tuple(replace(one, severity=Severity.WARNING) for one in of.findings)
    assert given.new_error(replace(of, findings=milder)) is None
    assert given.new_error(verdict("balance", "simulated_fall")) == error("simulated_fall")
    elsewhere = error("balance", sample=9)
    assert given.new_error(replace(of, findings=(*of.findings, elsewhere))) == elsewhere


@pytest.mark.parametrize("sign", ["\udcff", "\x00", "\x1b"])
def test_words_that_cannot_be_kept_are_refused(sign: str) -> None:
    with pytest.raises(InputError, match=f"The reason has the character U\\+{ord(sign):04X}"):
        override(verdict("balance"), "balance", reason=f"it{sign}walked")
    with pytest.raises(InputError, match="The name has the character"):
        approve(verdict(), f"A{sign}da", NOON, accept_warnings=True)
