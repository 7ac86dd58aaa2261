"""The physics as an input of the verdict: what a simulation found, or a note that there is none."""

from dataclasses import dataclass

from core.findings import Outcome
from core.physics.findings import physics_outcomes
from core.physics.problem import SimulationProblem
from core.physics.report import SimulationReport

NOT_SIMULATED = (
    "These waypoints were not simulated: balance and slip are known from geometry alone. Simulate shows more."
)


@dataclass(frozen=True, eq=False)
class Simulated:
    """A simulation of exactly the waypoints that are checked.

    Args:
        report: what came of it.
        problem: what was asked.
        key: hash of everything that it depends on.
    """

    report: SimulationReport
    problem: SimulationProblem
    key: str = ""


def check_simulation(simulated: Simulated | None) -> list[Outcome]:
    """Findings of the simulation; none if there was no simulation (see `simulation_note`)."""
    return [] if simulated is None else list(physics_outcomes(simulated.report, simulated.problem))


def simulation_note(simulated: Simulated | None) -> str:
    """What the simulation was made with, in a sentence, or that there is none."""
    if simulated is None:
        return NOT_SIMULATED
    physics = simulated.problem.physics
    return (
        f"Simulated with {physics.title}; the feet stay within "
        f"{simulated.report.feet_mean_error * 1000:.1f} mm of the plan on average."
    )
