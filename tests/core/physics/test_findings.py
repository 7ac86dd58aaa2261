"""The rules of a simulation: each finds what breaks it and says where, and a good run passes."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from core.findings import Finding, Severity
from core.physics.findings import SLIP_LIMIT, TILT_LIMIT, physics_outcomes
from core.physics.metrics import report
from core.physics.motion import SimulatedMotion
from core.physics.problem import SimulationProblem
from tests.support import synthetic_motions as made
from tests.support.synthetic_motions import PLANNED, PROBLEM


def findings(motion: SimulatedMotion, problem: SimulationProblem = PROBLEM) -> list[Finding]:
    outcomes = physics_outcomes(report(problem, motion), problem)
    return [finding for outcome in outcomes for finding in outcome.findings]


def only(motion: SimulatedMotion, problem: SimulationProblem = PROBLEM) -> Finding:
    (finding,) = findings(motion, problem)
    return finding


def test_a_run_as_planned_breaks_no_rule_and_tells_its_margins() -> None:
    outcomes = physics_outcomes(report(PROBLEM, PLANNED), PROBLEM)
    assert [outcome.findings for outcome in outcomes] == [()] * len(outcomes)
    margins = {outcome.margin.rule: outcome.margin.margin for outcome in outcomes}
    assert len(margins) == len(outcomes)
    assert margins["simulated_tilt"] == TILT_LIMIT
    assert margins["simulated_slip"] == SLIP_LIMIT


def test_a_fall_is_an_error_with_its_time_and_knot() -> None:
    angle = np.where(PLANNED.times > 1.22, 1.0, 0.0)
    finding = only(made.leaning(PLANNED, angle))
    assert (finding.rule, finding.severity) == ("simulated_fall", Severity.ERROR)
    assert finding.time == pytest.approx(1.25)
    assert finding.sample == 3
    assert "falls over at 1.2 s; it leans by 57° at most" in finding.sentence
    assert finding.sentence.endswith(finding.remedy)


def test_leaning_beyond_the_limit_is_an_error_and_within_it_none() -> None:
    angle = np.zeros(len(PLANNED.times))
    angle[20] = 1.01 * TILT_LIMIT
    finding = only(made.leaning(PLANNED, angle))
    assert (finding.rule, finding.severity, finding.sample) == ("simulated_tilt", Severity.ERROR, 2)
    assert "leans by 2.0° at 1.0 s" in finding.sentence
    angle[20] = 0.99 * TILT_LIMIT
    assert findings(made.leaning(PLANNED, angle)) == []


def test_load_on_a_foot_that_should_swing_is_an_error_also_where_the_body_hardly_leans() -> None:
    lifted = made.swinging(PROBLEM, 2, 1, 2)
    finding = only(PLANNED, lifted)
    assert (finding.rule, finding.severity) == ("simulated_swing", Severity.ERROR)
    assert (finding.foot, finding.sample) == (2, 2)
    assert finding.time == pytest.approx(0.75)
    assert "foot 3 carries load for 100 % of its swing about 0.8 s" in finding.sentence
    assert only(made.leaning(PLANNED, np.full(len(PLANNED.times), 0.05)), lifted).rule == "simulated_tilt"
    forces = PLANNED.ground_forces.copy()
    forces[: 2 * made.EACH + 5, 2, 2] = 0.0
    assert findings(replace(PLANNED, ground_forces=forces), lifted) == []


def test_a_run_that_broke_off_is_an_error() -> None:
    finding = only(replace(PLANNED, arrivals=PLANNED.arrivals[:3], ended_early="The solver lost its way"))
    assert (finding.rule, finding.severity) == ("simulated_end", Severity.ERROR)
    assert f"2 of {made.KNOTS} waypoints early: The solver lost its way." in finding.sentence


def test_slides_add_up_over_one_stance() -> None:
    slid = made.sliding(PLANNED, 1, made.EACH - 5, 2 * made.EACH + 5, 0.0015)
    finding = only(slid)
    assert (finding.rule, finding.severity, finding.foot) == ("simulated_slip", Severity.WARNING, 1)
    assert finding.value == pytest.approx(0.0015)
    assert "foot 2 slides 1.5 mm during one stance, most of it near 1.0 s" in finding.sentence
    lifted = np.array(PROBLEM.standing)
    lifted[2, 1] = False
    assert findings(slid, made.problem_of(made.walking_plan(), lifted)) == []


def test_a_centre_of_mass_beyond_the_carrying_feet_is_a_warning() -> None:
    forces = PLANNED.ground_forces.copy()
    forces[:, 2] = 0.0
    centre = np.zeros_like(PLANNED.centre_world)
    centre[:, 0] = 0.002
    assert findings(replace(PLANNED, ground_forces=forces, centre_world=centre)) == []
    centre[14, 0] = -0.003
    finding = only(replace(PLANNED, ground_forces=forces, centre_world=centre))
    assert (finding.rule, finding.severity) == ("simulated_balance", Severity.WARNING)
    assert "3.0 mm outside the middles of the feet that carry load at 0.7 s" in finding.sentence


def test_a_body_that_stays_behind_is_a_warning_also_to_the_side() -> None:
    body = PLANNED.body_world.copy()
    body[:, 1] = np.linspace(0.0, 0.0035, len(body))
    finding = only(replace(PLANNED, body_world=body))
    assert (finding.rule, finding.severity) == ("simulated_travel", Severity.WARNING)
    assert "ends 3.5 mm from where the plan ends, more than 3.0 mm; it goes 5.3 of 4.0 mm" in finding.sentence


def test_a_body_that_turns_unasked_is_a_warning() -> None:
    finding = only(made.turned(PLANNED, np.linspace(0.0, -0.06, len(PLANNED.times))))
    assert (finding.rule, finding.severity) == ("simulated_heading", Severity.WARNING)
    assert "turns by -3.4°; the plan says 0.0°" in finding.sentence


def test_a_motor_behind_its_ramp_is_named() -> None:
    strokes = PLANNED.strokes.copy()
    strokes[30, 2, 1] += 0.0013
    finding = only(replace(PLANNED, strokes=strokes))
    assert (finding.rule, finding.foot, finding.actuator) == ("simulated_motors", 2, 1)
    assert "motor 2 of foot 3 is 1.30 mm behind its ramp at 1.5 s" in finding.sentence


def test_a_motor_at_its_limit_is_named_with_its_share() -> None:
    forces = PLANNED.motor_forces.copy()
    forces[:10, 3, 0] = PROBLEM.physics.motor_force
    finding = only(replace(PLANNED, motor_forces=forces))
    assert (finding.rule, finding.foot, finding.actuator) == ("simulated_force", 3, 0)
    assert f"at its limit of {PROBLEM.physics.motor_force:.1f} N for 24 % of the time" in finding.sentence
