"""The hash of a verdict, to which an approval is bound: what makes it another one, and what does not."""

from __future__ import annotations

from dataclasses import replace

import pytest

from core.findings import Finding, RuleMargin, Severity, Verdict

SLIP = Finding("slip", Severity.WARNING, "Foot 2 slides 0.6 mm.", 0.0006, 0.0005, 3, 1, None, 1.2, "Less.")
FORCE = Finding("simulated_force", Severity.WARNING, "Motor 1 is at its limit.", 0.02, 0.01, 7, 0, 0, 2.8)
MARGINS = (RuleMargin("slip", -0.0001, "m"), RuleMargin("simulated_force", -0.01, ""))
VERDICT = Verdict("waypoints", (SLIP, FORCE), MARGINS, robot_hash="robot")


def hash_with(slip: Finding = SLIP, force: Finding = FORCE) -> str:
    return replace(VERDICT, findings=(slip, force)).content_hash


def test_last_digits_words_costs_and_notes_make_no_other_verdict() -> None:
    noisy = tuple(replace(one, margin=(one.margin or 0.0) + 1e-12) for one in MARGINS)
    assert replace(VERDICT, margins=noisy, notes=("Not simulated.",)).content_hash == VERDICT.content_hash
    assert hash_with(replace(SLIP, sentence="A foot slides.", remedy="", value=0.000601)) == hash_with()
    assert hash_with(replace(SLIP, time=1.2 + 1e-12)) == hash_with()
    assert replace(VERDICT, findings=(FORCE, SLIP, SLIP)).content_hash == VERDICT.content_hash


@pytest.mark.parametrize(
    "other",
    [
        replace(VERDICT, waypoints_hash="other"),
        replace(VERDICT, robot_hash="other"),
        replace(VERDICT, simulation="other"),
        replace(VERDICT, findings=(SLIP,)),
        replace(VERDICT, findings=(SLIP, FORCE, replace(SLIP, rule="clearance"))),
        replace(VERDICT, margins=(*MARGINS, RuleMargin("arm_distance", 0.1, "m"))),
        replace(VERDICT, margins=MARGINS[:1]),
    ],
    ids=["waypoints", "robot", "simulation", "finding less", "finding more", "rule more", "no simulation"],
)
def test_other_waypoints_robot_simulation_findings_or_rules_make_another_verdict(other: Verdict) -> None:
    assert other.content_hash != VERDICT.content_hash


def test_the_same_rule_of_another_severity_or_at_another_place_is_another_finding() -> None:
    others = {
        hash_with(replace(SLIP, severity=Severity.ERROR)),
        hash_with(replace(SLIP, foot=2)),
        hash_with(replace(SLIP, foot=None)),
        hash_with(replace(SLIP, actuator=1)),
        hash_with(replace(SLIP, sample=4)),
        hash_with(force=replace(FORCE, actuator=1)),
        hash_with(),
    }
    assert len(others) == 7


def test_the_moment_of_a_simulated_finding_makes_no_other_verdict() -> None:
    assert hash_with(force=replace(FORCE, sample=9, time=3.0)) == hash_with()
