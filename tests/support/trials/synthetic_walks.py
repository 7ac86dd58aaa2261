"""Gaits and a physics by formula, so that learning takes no simulation."""

from __future__ import annotations

import threading
from collections.abc import Sequence
from dataclasses import dataclass, field, replace

from app.learning.service import LearningService
from app.store.database import Database
from core.errors import SimulationCancelledError
from core.identification.learning import Walk
from core.physics.parameters import PhysicsSet, physics_set
from core.trials.displacement import Displacement, MeasuredWalk
from tests.support.simulated_walk import walk_problem
from tests.support.studio_process import wait_for

REAL = replace(physics_set("scales"), cable_drag=0.6)
POINTS = 16
WANTED = (0.03, 0.04, 0.05)
CUT = 0.0042
"""What was cut off a stroke of the first gait, m."""


def displacement(wanted: float, physics: PhysicsSet) -> Displacement:
    """A robot that a cable holds back."""
    return Displacement(wanted - 0.012 * physics.cable_drag, 0.0)


def made_walks(count: int = len(WANTED)) -> tuple[Walk, ...]:
    walks = []
    for wanted in WANTED[:count]:
        measured = MeasuredWalk(f"Walk, {wanted * 100:g} cm", "Walk", wanted, displacement(wanted, REAL), 3)
        walks.append(Walk(measured, walk_problem(), 1, 0.0, CUT if wanted == WANTED[0] else 0.0))
    return tuple(walks)


@dataclass(eq=False)
class Handle:
    tier: Tier
    answer: tuple[Displacement | None, ...]
    ended: threading.Event = field(default_factory=threading.Event)

    def result(self) -> tuple[Displacement | None, ...]:
        while not self.tier.may_answer.wait(0.01):
            if self.ended.is_set():
                raise SimulationCancelledError("Learning was cancelled.")
        return self.answer

    def cancel(self) -> None:
        self.ended.set()


@dataclass
class Tier:
    """A physics that answers once it may."""

    may_answer: threading.Event = field(default_factory=threading.Event)

    def submit(self, walk: Walk, sets: Sequence[PhysicsSet]) -> Handle:
        return Handle(self, tuple(displacement(walk.measured.wanted, one) for one in sets))


def keep_course(database: Database, source: str) -> None:
    """A course that has ended, of a robot that a cable holds back."""
    tier = Tier()
    tier.may_answer.set()
    service = LearningService(database, (tier,), POINTS)
    service.start(made_walks(), physics_set("scales"), "Ada", source)
    wait_for(lambda: service.found()[0]["state"] == "done", "the course has ended")
    service.close()
