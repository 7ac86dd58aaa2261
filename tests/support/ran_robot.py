"""An emulated robot that runs a plan in its own time, and its run in a database as the studio keeps it."""

from __future__ import annotations

import secrets
from dataclasses import dataclass
from functools import cache

from app.bridge.states import Direction, RobotState, RunPlan, Transition
from app.plans.plan import Plan, PlanSource
from app.runs.plan_json import run_plan_content
from app.store.database import Database
from app.store.tables.run_store import RunStore
from core.findings import Approval
from core.gait.manual_motion import manual_motion
from core.library.library import library
from core.motion.trajectory import Trajectory
from core.robot.model import load_robot
from core.runs.reading import RunBytes, read_run
from core.wire.waypoint_merging import WaypointPlan, plan_waypoints
from tests.support.virtual_robot import VirtualRobot, make_plan

ROBOT = load_robot("deltawalker")
STARTED = 1_790_000_000.0
"""When the first run that is kept began, s since the epoch."""


class TimedRobot(VirtualRobot):
    """An emulated robot whose bytes are kept with their times."""

    def __init__(self) -> None:
        super().__init__()
        self.pieces: list[RunBytes] = []

    def step(self) -> None:
        sent, heard = len(self.log), len(self.heard)
        super().step()
        self.pieces += [RunBytes(self.now, False, data) for data in self.heard[heard:]]
        outgoing = [data for way, data in self.log[sent:] if way is Direction.TO_ROBOT]
        self.pieces += [RunBytes(self.now, True, data) for data in outgoing]


@dataclass(frozen=True, eq=False)
class Ran:
    """A robot that has run a whole plan, and what it was to do."""

    robot: TimedRobot
    trajectory: Trajectory
    way: WaypointPlan
    approval: Approval
    began: float
    changes: tuple[Transition, ...]


@cache
def ran() -> Ran:
    """The run of a walk by hand, one waypoint a sample, from somewhere else than where it begins."""
    motion = manual_motion(library()["walk-manual-0"].gait, ROBOT).trajectory
    way = plan_waypoints(ROBOT, motion)
    approval = Approval("verdict", way.waypoints.content_hash, "Ada", "2026-01-01T00:00:00+00:00")
    robot = TimedRobot()
    robot.begin(make_plan([[9.0] * 12]))
    robot.until_robot(RobotState.DONE)
    robot.machine.arm("Ada")
    began, before, known = robot.now, len(robot.log), len(robot.machine.transitions)
    robot.machine.send(RunPlan(way.waypoints, approval, way.hold_ok), "Ada", robot.now)
    robot.pieces = [RunBytes(robot.now, True, data) for _, data in robot.log[before:]]
    robot.until_robot(RobotState.DONE)
    return Ran(robot, motion, way, approval, began, tuple(robot.machine.transitions)[known:])


def keep_run(
    database: Database, by: str = "Ada", gait: str = "walk", day: int = 0, share: float = 1.0
) -> str:
    """Puts the run into a database, or as if it had been stopped after a share of its time; its id."""
    done, run, log = ran(), secrets.token_hex(6), RunStore(database)
    seconds = (done.robot.now - done.began) * share
    pieces = [piece for piece in done.robot.pieces if piece.time <= done.began + seconds]
    started = STARTED + day * 86400.0
    content = {
        "id": run,
        "gait": gait,
        "gait_name": gait.capitalize(),
        "waypoints_hash": done.way.waypoints.content_hash,
        "by": by,
        "started": started,
        "started_monotonic": done.began,
        "ended": started + seconds,
        "state": "done" if share == 1.0 else "stopped",
        "sentence": "The last waypoint was reached." if share == 1.0 else "Stopped.",
        "reached": sum(c.is_reached for c in read_run(pieces, done.way.waypoints).commands),
        "count": done.way.waypoints.count,
        "seconds": seconds,
    }
    plan = Plan(PlanSource.MANUAL, "", ROBOT, done.trajectory, done.way, None)
    log.begin(content, run_plan_content(plan, done.way, done.approval))
    words = {True: Direction.TO_ROBOT.value, False: Direction.FROM_ROBOT.value}
    RunStore(database).add_bytes([(run, piece.time, words[piece.to_robot], piece.data) for piece in pieces])
    log.add_states([(run, one.time, one.link.value, one.robot.value, one.cause) for one in done.changes])
    return run
