"""Makes simulation problems of plans, their keys, and the JSON content of parameters and reports."""

import hashlib
import json
import math
from dataclasses import asdict, fields
from typing import Any

import numpy as np

from app.common.json import Json, finite
from app.common.version import VERSION
from app.plans.plan import Plan
from core.errors import CheckError, InputError
from core.motion.trajectory import Trajectory
from core.motion.way_made import NO_TURN, NO_WAY, WayMade
from core.physics.masses import default_physics, part_masses
from core.physics.parameters import PhysicsSet, physics_sets
from core.physics.problem import Rig, SimulationProblem
from core.physics.report import SimulationReport
from core.robot.model import RobotModel
from core.wire.waypoint_merging import WaypointPlan

FORM = 2
"""Of what is kept of a simulation; grows with the physics, and with a report that is not readable then."""
SAME_DECIMALS = 6
"""Of s, m and rad: times and places that agree to them are the same."""


def simulation_problem(plan: Plan, physics: PhysicsSet) -> SimulationProblem:
    """What the physics is asked of a plan: exactly the waypoints that would be sent.

    Raises:
        CheckError: the plan has no waypoints.
    """
    if plan.trajectory is None or plan.way is None:
        sentence = "There is no plan to simulate." if plan.refusal is None else plan.refusal.sentence
        raise CheckError(sentence, "plan")
    return way_problem(plan.model, plan.trajectory, plan.way, physics)


def way_problem(
    model: RobotModel,
    trajectory: Trajectory,
    way: WaypointPlan,
    physics: PhysicsSet,
    rig: Rig = Rig.WALKING,
) -> SimulationProblem:
    """The same of a motion and what is sent of it."""
    return SimulationProblem(
        model, way.waypoints, trajectory, way.times, way.contact, way.standing, physics, rig
    )


def fitting_sets(model: RobotModel) -> tuple[PhysicsSet, ...]:
    """The sets of physics parameters whose masses the robot has, its usual one first."""
    usual = default_physics(model)
    others = (one for one in physics_sets().values() if one != usual and _has_masses(model, one))
    return (usual, *others)


def _has_masses(model: RobotModel, physics: PhysicsSet) -> bool:
    try:
        part_masses(model, physics)
    except InputError:
        return False
    return True


def simulation_key(plan: Plan, physics: PhysicsSet) -> str:
    """Hash of everything that a simulation of a plan depends on, this program's version included.

    No last digit of a computer's own is in it. Where feet and body are follows from strokes and contact.
    """
    parts: list[Any] = [VERSION, FORM, plan.model.parameters_hash, physics_content(physics)]
    if plan.trajectory is not None and plan.way is not None:
        way, start = plan.way, plan.trajectory
        placed = (start.body_world[0], start.heading[:1], way.times)
        parts += [way.waypoints.content_hash, way.kept, way.contact.tolist(), way.standing.tolist()]
        parts += [(np.round(values, SAME_DECIMALS) + 0.0).tolist() for values in placed]
    return hashlib.sha256(json.dumps(parts, sort_keys=True).encode()).hexdigest()


def key_before(plan: Plan, physics: PhysicsSet) -> str:
    """Key under which earlier versions stored the same simulation: a hash of the plan's raw numbers."""
    waypoints = "" if plan.waypoints is None else plan.waypoints.content_hash
    robot, parameters = plan.model.parameters_hash, json.dumps(physics_content(physics), sort_keys=True)
    parts = [VERSION, "2", robot, plan.session_hash, waypoints, parameters]
    return hashlib.sha256("\n".join(parts).encode()).hexdigest()


def physics_content(physics: PhysicsSet) -> Json:
    """A set of physics parameters as JSON content, SI."""
    content: Json = finite(asdict(physics))
    return content


def physics_from_content(content: Json) -> PhysicsSet:
    """Inverse of `physics_content`."""
    values: Json = {
        name: tuple(value) if isinstance(value, list) else value for name, value in content.items()
    }
    return PhysicsSet(**values)


def report_content(report: SimulationReport) -> Json:
    """A report as JSON content, SI."""
    values = {field.name: getattr(report, field.name) for field in fields(report)}
    values["way"] = _way_content(report.way)
    content: Json = finite(
        {name: value.tolist() if isinstance(value, np.ndarray) else value for name, value in values.items()}
    )
    return content


def report_from_content(content: Json) -> SimulationReport:
    """Inverse of `report_content`; also of one that an earlier version kept."""
    values: Json = {
        name: np.array(value) if isinstance(value, list) else value
        for name, value in with_way(content).items()
        if name != "goal_gap"
    }
    values["way"] = WayMade(**_without_shares(values["way"]))
    return SimulationReport(**values)


def with_way(content: Json) -> Json:
    """A report's content; to one of an earlier version the way is added that its distances say."""
    return content if "way" in content else content | {"way": _way_content(_earlier_way(content))}


def _way_content(way: WayMade) -> Json:
    return asdict(way) | {"share": way.share, "turn_share": way.turn_share}


def _without_shares(content: Json) -> Json:
    return {name: value for name, value in content.items() if name not in ("share", "turn_share")}


def _earlier_way(content: Json) -> WayMade:
    """Way and turn by the three distances that earlier versions kept: plan, robot, and between their ends."""
    asked, distance, gap = content["planned_distance"], content["distance"], content["goal_gap"]
    turn, made_turn = content["planned_heading"], content["heading"]
    goes, turns = asked > NO_WAY, abs(turn) > NO_TURN
    return WayMade(
        asked=asked if goes else 0.0,
        made=(asked**2 + distance**2 - gap**2) / (2 * asked) if goes else 0.0,
        gap=gap,
        asked_turn=abs(turn) if turns else 0.0,
        made_turn=math.copysign(1.0, turn) * made_turn if turns else 0.0,
        turn_gap=abs(made_turn - turn),
    )


def report_figures(report: SimulationReport) -> Json:
    """The figures that scripts get of a simulated run, SI, those of feet and motors from foot 1 on."""
    content: Json = finite(
        {
            "mean_error": {
                "body": report.body_error,
                "feet": report.feet_error.tolist(),
                "feet_mean": report.feet_mean_error,
            },
            "max_tilt": report.max_tilt,
            "max_tilt_time": report.max_tilt_time,
            "fell": report.fell,
            "fell_time": report.fell_time,
            "slip": report.slip.tolist(),
            "swing_load": report.swing_load.tolist(),
            "distance": report.distance,
            "planned_distance": report.planned_distance,
            "heading": report.heading,
            "planned_heading": report.planned_heading,
            "way_share": report.way.share,
            "turn_share": report.way.turn_share,
            "min_margin": report.min_margin,
            "motor_error": report.motor_error.tolist(),
            "saturation": report.saturation.tolist(),
            "loop_error": report.loop_error,
            "seconds": float(report.arrival_times[-1]),
            "realtime_factor": report.realtime_factor,
            "ended_early": report.ended_early,
        }
    )
    return content
