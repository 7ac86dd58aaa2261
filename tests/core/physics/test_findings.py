"""The rules of a simulation: each finds what breaks it and says where, and a good run passes."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from core.findings import Finding, Severity
from core.physics.findings import SLIP_LIMIT, TILT_LIMIT, physics_outcomes
from core.physics.metrics import report
from core.physics.motion import SimulatedMotion
from core.physics.problem import Rig, SimulationProblem
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


WALK = replace(
    PROBLEM.plan, feet_world=PROBLEM.plan.feet_world + PROBLEM.plan.body_world[:, None] * [1.0, 1.0, 0.0]
)
"""The plan with feet that go along, so that it asks for a way of 4 mm."""


def going(share: float, aside: float = 0.0, turn: float = 0.0) -> SimulatedMotion:
    """The robot that makes a part of the way, goes aside, m, and turns, rad."""
    run = made.turned(made.as_planned(made.problem_of(WALK)), np.linspace(0.0, turn, len(PLANNED.times)))
    feet = run.feet_world.copy()
    feet[..., 0] -= (1.0 - share) * np.linspace(0.0, 0.004, len(feet))[:, None]
    feet[..., 1] += np.linspace(0.0, aside, len(feet))[:, None]
    return replace(run, feet_world=feet)


def of_way(motion: SimulatedMotion, rule: str = "simulated_travel") -> list[Finding]:
    return [one for one in findings(motion, made.problem_of(WALK)) if one.rule == rule]


@pytest.mark.parametrize(
    ("share", "severity"),
    [(0.95, None), (0.901, None), (0.89, Severity.WARNING), (0.51, Severity.WARNING), (0.49, Severity.ERROR)],
)
def test_less_than_nine_tenths_of_the_way_is_a_warning_and_less_than_half_an_error(
    share: float, severity: Severity | None
) -> None:
    found = of_way(going(share))
    assert [one.severity for one in found] == ([] if severity is None else [severity])
    for one in found:
        assert one.value == pytest.approx(share, abs=1e-6)
        assert one.foot is not None
        assert one.time is not None
        assert f"goes {share * 4:.1f} of 4.0 mm, {share * 100:.0f} % of its way" in one.sentence


def test_a_robot_that_goes_backwards_is_an_error() -> None:
    assert [one.severity for one in of_way(going(-0.5))] == [Severity.ERROR]


def test_a_robot_that_makes_its_way_but_ends_aside_is_a_warning() -> None:
    (one,) = of_way(going(1.0, aside=0.0035))
    assert one.severity is Severity.WARNING
    assert "ends 3.5 mm from where the plan ends, more than 3.0 mm" in one.sentence
    assert of_way(going(1.0, aside=0.0029)) == []


def test_a_gait_that_is_asked_to_go_nowhere_is_judged_by_millimetres_and_degrees() -> None:
    feet = PLANNED.feet_world.copy()
    feet[..., 1] += np.linspace(0.0, 0.0035, len(feet))[:, None]
    assert [one.rule for one in findings(replace(PLANNED, feet_world=feet)) if "travel" in one.rule] == [
        "simulated_travel"
    ]
    turned = made.turned(PLANNED, np.linspace(0.0, -0.06, len(PLANNED.times)))
    (one,) = [one for one in findings(turned) if one.rule == "simulated_heading"]
    assert one.severity is Severity.WARNING
    assert "ends turned 3.4° from the plan's heading, more than 2°" in one.sentence


def test_a_rig_that_does_not_walk_is_not_asked_how_far_it_goes() -> None:
    floating = made.problem_of(WALK, rig=Rig.FLOATING)
    rules = {outcome.margin.rule for outcome in physics_outcomes(report(floating, going(0.2)), floating)}
    assert not rules & {"simulated_travel", "simulated_heading"}


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
