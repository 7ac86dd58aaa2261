"""The kept simulations: which of them belongs to the present plan, and its report. Thread-safe."""

import time
from collections.abc import Callable, Iterable, Sequence
from contextlib import suppress
from dataclasses import asdict
from typing import Protocol

from app.common.json import Json, finite
from app.common.version import VERSION
from app.plans.plan import Plan
from app.simulation.problem import (
    key_before,
    physics_content,
    report_content,
    report_from_content,
    simulation_key,
    simulation_problem,
    with_way,
)
from app.simulation.view import motion_content, variations_content
from app.store.tables.simulation_store import SimulationRow, SimulationStore
from app.store.tables.table import reading
from core.checks.simulation import Simulated
from core.errors import InputError, NotFoundError
from core.physics.findings import physics_outcomes
from core.physics.masses import default_physics
from core.physics.metrics import report
from core.physics.motion import SimulatedMotion
from core.physics.parameters import PhysicsSet, physics_sets
from core.physics.problem import SimulationProblem
from core.physics.variations import VariedRun


class SimulationResult(Protocol):
    """What came of a simulation."""

    @property
    def motion(self) -> SimulatedMotion:
        """Of the parameters as they are."""

    @property
    def runs(self) -> Sequence[VariedRun]:
        """Of their variations."""


NO_GAIT = ""
"""What a simulation of waypoints is of that no gait has yet, such as those of a remedy."""


def simulation_row(plan: Plan, problem: SimulationProblem, gait_id: str = NO_GAIT) -> SimulationRow:
    """What is known of a simulation that begins now.

    Args:
        plan: what is simulated.
        problem: what the physics is asked of it.
        gait_id: which gait it is of.
    """
    physics = problem.physics
    key = simulation_key(plan, physics)
    return SimulationRow(gait_id, key, problem.waypoints.content_hash, physics.name, time.time())


class SimulationRepository:
    """The simulations.

    Args:
        log: where they are kept.
        told: hears of the waypoints' hash of each one that is kept.
        sets: every set of physics parameters that there is now.
    """

    def __init__(
        self,
        log: SimulationStore,
        told: Callable[[str], None] = lambda waypoints: None,
        sets: Callable[[], Iterable[PhysicsSet]] = lambda: physics_sets().values(),
    ) -> None:
        self._log = log
        self._told = told
        self._sets = sets

    def keep(self, row: SimulationRow, problem: SimulationProblem, answer: SimulationResult) -> Json:
        """Keeps what came of a simulation, and gives it as content for pages and scripts."""
        figures = report(problem, answer.motion)
        outcomes = physics_outcomes(figures, problem)
        content: Json = {
            "key": row.key,
            "gait": row.gait,
            "robot": problem.model.name,
            "waypoints_hash": row.waypoints,
            "program": VERSION,
            "physics": physics_content(problem.physics),
            "made": row.made,
            "seconds": answer.motion.seconds,
            "report": report_content(figures),
            "findings": finite([asdict(finding) for one in outcomes for finding in one.findings]),
            "variations": variations_content(answer.runs) if answer.runs else None,
            "motion": motion_content(problem, answer.motion, figures),
        }
        self.put(row, content)
        return content

    def put(self, row: SimulationRow, content: Json) -> None:
        """Keeps a simulation; variations that are known of the same stay where it has none of its own."""
        before = self._log.content(row.key)
        if content["variations"] is None and before is not None:
            content = {**content, "variations": before["variations"]}
        self._log.put(row, content)
        self._told(row.waypoints)

    def content(self, key: str) -> Json:
        """A simulation for pages and scripts.

        Raises:
            NotFoundError: there is none, or it was long ago.
        """
        content = self._log.content(key)
        if content is None:
            raise NotFoundError(
                "There is no such simulation, or it is not kept any more. Simulate again.", key
            )
        with reading("This simulation cannot be read: "):
            return {**content, "report": with_way(content["report"])}

    def standing(self, gait_id: str, plan: Plan) -> Json | None:
        """The newest simulation of a gait, rather one of its plan as it is; None where there is none.

        One of the same waypoints counts, whatever gait it was made for.
        """
        rows = (*self._log.of_gait(gait_id), *self._same(plan))
        if not rows:
            return None
        now = self.keys_of(plan)
        fresh = next((row for row in rows if row.key in now), None)
        row = fresh or rows[0]
        return {"key": row.key, "physics": row.physics, "made": row.made, "fresh": fresh is not None}

    def is_fresh(self, gait_id: str, key: str, plan: Plan) -> bool:
        """Whether a simulation is kept and is of the gait's plan as it is now."""
        rows = (*self._log.of_gait(gait_id), *self._same(plan))
        return key in self.keys_of(plan) and any(row.key == key for row in rows)

    def _same(self, plan: Plan) -> tuple[SimulationRow, ...]:
        """Simulations of the waypoints that a plan has now."""
        return () if plan.waypoints is None else self._log.of_waypoints(plan.waypoints.content_hash)

    def simulated(self, plan: Plan) -> Simulated | None:
        """A simulation of a plan as it is now, for its verdict; None where there is none.

        One with the robot's usual parameters goes before the newest one, so that what they find stands
        whatever else is tried.
        """
        rows = self._same(plan)
        sets = self._sets_of(plan) if rows else {}
        usual = default_physics(plan.model).name
        for row in sorted((row for row in rows if row.key in sets), key=lambda row: row.physics != usual):
            content = self._log.content(row.key)
            if content is not None:
                physics = sets[row.key]
                problem = simulation_problem(plan, physics)
                with suppress(InputError), reading():
                    figures = report_from_content(content["report"])
                    return Simulated(figures, problem, simulation_key(plan, physics))
        return None

    def keys_of(self, plan: Plan) -> frozenset[str]:
        """What simulations of a plan are kept under, with each physics set."""
        return frozenset(self._sets_of(plan))

    def _sets_of(self, plan: Plan) -> dict[str, PhysicsSet]:
        keys = (simulation_key, key_before)
        return {key(plan, physics): physics for physics in self._sets() for key in keys}
