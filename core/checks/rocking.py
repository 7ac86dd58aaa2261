"""Rocking onto a foot: an error of the plan that is a warning where the simulated robot does not fall."""

from collections.abc import Sequence
from dataclasses import replace

from core.checks.simulation import Simulated
from core.findings import Finding, Severity
from core.physics.findings import only_rocks, rocking_words
from core.physics.masses import default_physics
from core.robot.model import RobotModel

PLANNED_ROCKING = ("balance", "path_balance")
"""Rules whose errors mean that the robot rocks onto a foot, if it does not fall."""
SIMULATE = (
    "A simulation shows whether the robot only rocks onto a foot and does not fall. A person may override "
    "this rule with a reason."
)


def rocking_judged(
    findings: Sequence[Finding], model: RobotModel, simulated: Simulated | None = None
) -> list[Finding]:
    """Findings in which rocking is judged by the simulation, or names it as the way out where there is none.

    A plan in which no foot stands is left as it is: it has no foot to rock onto. So is that of a robot with
    shared motors, whose rules judge the motion that is made.

    Args:
        findings: of a plan, or of its waypoints alone.
        model: the robot.
        simulated: a simulation of exactly these waypoints; it judges with the robot's usual physics only.
    """
    if model.is_coupled:
        return list(findings)
    return [_judged(one, simulated) if _is_rocking(one) else one for one in findings]


def _is_rocking(finding: Finding) -> bool:
    is_error = finding.severity is Severity.ERROR and finding.value is not None
    return is_error and finding.rule in PLANNED_ROCKING


def _judged(finding: Finding, simulated: Simulated | None) -> Finding:
    if simulated is None:
        remedy = f"{finding.remedy} {SIMULATE}"
        return replace(finding, sentence=f"{finding.sentence} {SIMULATE}", remedy=remedy)
    report, problem = simulated.report, simulated.problem
    is_usual = problem.physics == default_physics(problem.model)
    if not is_usual or not only_rocks(report, problem):
        return finding
    swinging = ~problem.plan.contact[finding.sample or 0]
    words = finding.sentence.removesuffix(finding.remedy) + rocking_words(report, swinging)
    return replace(finding, severity=Severity.WARNING, sentence=f"{words} {finding.remedy}")
