"""A check that takes the physics with it where geometry alone does not say whether a robot walks."""

from core.checks.checked_plan import CheckedPlan
from core.checks.rules import check_plan
from core.checks.simulation import Simulated
from core.findings import Verdict
from core.physics.masses import default_physics
from core.physics.metrics import report


def checked_in_physics(plan: CheckedPlan) -> Verdict:
    """The verdict on a plan; of a robot whose motors share actuators with a simulation that is made now.

    Raises:
        CheckError: the simulation broke off.
    """
    if plan.way is None or not plan.model.is_coupled:
        return check_plan(plan)
    # Plans and engine take a while to load, and other robots do without them.
    from app.simulation.problem import way_problem
    from solver_jobs import simulate

    problem = way_problem(plan.model, plan.trajectory, plan.way, default_physics(plan.model))
    return check_plan(plan, Simulated(report(problem, simulate(problem)), problem))
