"""The kept simulations: which of them belongs to the present plan, and its report. Thread-safe."""

from collections.abc import Callable, Iterable

from app.common.json import Json
from app.plans.plan import Plan
from app.simulation.problem import (
    key_before,
    report_from_content,
    simulation_key,
    simulation_problem,
    with_way,
)
from app.store.simulation_store import SimulationRow, SimulationStore
from core.checks.simulation import Simulated
from core.errors import NotFoundError
from core.physics.masses import default_physics
from core.physics.parameters import PhysicsSet, physics_sets


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
        return {**content, "report": with_way(content["report"])}

    def standing(self, gait_id: str, plan: Plan) -> Json | None:
        """The newest simulation of a gait, rather one of its plan as it is; None where there is none."""
        rows = self._log.of_gait(gait_id)
        if not rows:
            return None
        now = self.keys_of(plan)
        fresh = next((row for row in rows if row.key in now), None)
        row = fresh or rows[0]
        return {"key": row.key, "physics": row.physics, "made": row.made, "fresh": fresh is not None}

    def is_fresh(self, gait_id: str, key: str, plan: Plan) -> bool:
        """Whether a simulation is kept and is of the gait's plan as it is now."""
        return key in self.keys_of(plan) and any(row.key == key for row in self._log.of_gait(gait_id))

    def simulated(self, plan: Plan) -> Simulated | None:
        """A simulation of a plan as it is now, for its verdict; None where there is none.

        One with the robot's usual parameters goes before the newest one, so that what they find stands
        whatever else is tried.
        """
        if plan.waypoints is None:
            return None
        rows = self._log.of_waypoints(plan.waypoints.content_hash)
        sets = self._sets_of(plan) if rows else {}
        usual = default_physics(plan.model).name
        for row in sorted((row for row in rows if row.key in sets), key=lambda row: row.physics != usual):
            content = self._log.content(row.key)
            if content is not None:
                physics = sets[row.key]
                problem = simulation_problem(plan, physics)
                return Simulated(
                    report_from_content(content["report"]), problem, simulation_key(plan, physics)
                )
        return None

    def keys_of(self, plan: Plan) -> frozenset[str]:
        """What simulations of a plan are kept under, with each physics set."""
        return frozenset(self._sets_of(plan))

    def _sets_of(self, plan: Plan) -> dict[str, PhysicsSet]:
        keys = (simulation_key, key_before)
        return {key(plan, physics): physics for physics in self._sets() for key in keys}
