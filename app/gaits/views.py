"""Views of gaits and plans: JSON content for pages and scripts."""

import itertools
from dataclasses import asdict, fields
from datetime import UTC, datetime

import numpy as np

from app.common.clipped import clipped_content
from app.common.json import Json, finite
from app.documents.gait_json import gait_content
from app.gaits.open_gait import OpenGait
from app.gaits.recovery import WayOut
from app.gaits.thumbnails import footfall_columns
from app.gaits.verdict_views import approval_view, verdict_view
from app.plans.plan import Plan, PlanSource
from app.plans.provenance import provenance_view
from app.plans.reach_outline_view import reach_rings
from app.plans.robot_times import robot_times
from app.plans.verified_result import VerifiedResult
from core.arrays import Floats
from core.gait.gait import Gait
from core.gait.mirroring import mirror_of
from core.gait.motion_source import motion_source
from core.library.library import library
from core.library.robot_times import RobotTimes
from core.library.sequence import part_refusal
from core.motion.speeds import foot_speeds, motor_speeds
from core.motion.trajectory import Trajectory
from core.pose_gaits.conversion import conversion_refusal
from core.pose_gaits.pose_gait import heard_times
from core.robot.model import RobotModel, load_robot
from core.wire.robot_time import estimate_seconds, move_estimates, stop_time
from core.wire.waypoint_merging import WaypointPlan

_stamps = itertools.count(1)
"""Of this start of the studio; a page takes those of another start as new ones (`start` of `hello`)."""


def line_view(
    gait_id: str,
    gait: Gait,
    builtin: bool,
    edited: bool,
    outside: str | None = None,
    times: RobotTimes | None = None,
) -> Json:
    """A line of the list of gaits.

    Args:
        gait_id: its id.
        gait: its present document.
        builtin: whether a gait of this id comes with the program.
        edited: whether the document differs from what is saved.
        outside: how its file was changed outside the studio, in a sentence; None where it was not.
        times: how long it lasts; None where no plan of it was made.
    """
    return {
        "id": gait_id,
        "name": gait.name,
        "kind": "builtin" if builtin else "saved",
        "group": library()[gait_id].group.value if builtin else "Saved",
        "robot": load_robot(gait.robot).title,
        "source": motion_source(gait).value,
        "orientation": gait.orientation.value,
        "order": list(gait.order),
        "step": list(gait.step),
        "footfalls": footfall_columns(gait.timeline),
        "edited": edited,
        "walks": library()[gait_id].walks if builtin and not edited else None,
        "outside": outside,
        "part_refusal": part_refusal(gait),
        **times_view(times),
        "problem": None,
        "way_out": None,
    }


def problem_view(gait_id: str, sentence: str, builtin: bool = False, way_out: WayOut | None = None) -> Json:
    """The line of a gait that cannot be shown.

    Args:
        gait_id: its id, or its name where that is no id.
        sentence: what is wrong with it, and what can be done.
        builtin: whether a gait of this id comes with the program.
        way_out: what can be done about it.
    """
    return {
        "id": gait_id,
        "name": library()[gait_id].gait.name if builtin else gait_id.removesuffix(".json"),
        "kind": "damaged",
        "group": library()[gait_id].group.value if builtin else "Saved",
        "robot": None,
        "source": None,
        "orientation": None,
        "order": [],
        "step": None,
        "footfalls": [],
        "edited": False,
        "walks": None,
        "outside": None,
        "part_refusal": None,
        **times_view(None),
        "problem": sentence,
        "way_out": way_out,
    }


def times_view(times: RobotTimes | None) -> Json:
    """How long a gait lasts, s, its speed, m/s, and its turn, rad/s, on the robot; null where not known."""
    values = dict.fromkeys(f.name for f in fields(RobotTimes)) if times is None else asdict(times)
    return dict(values)


def require_line(gait: Gait) -> None:
    """A document that is to be kept can be shown in the list.

    Raises:
        InputError: it cannot.
    """
    line_view("", gait, False, True)


def steps_view(open_gait: OpenGait, pages: frozenset[str]) -> Json:
    """What can be undone and redone: by a script, and by each connected page."""
    steps = {
        page: {"undo": open_gait.undo_label(pages - {page}), "redo": open_gait.redo_label(pages - {page})}
        for page in pages
    }
    return {"undo": open_gait.undo_label(pages), "redo": open_gait.redo_label(pages), "steps": steps}


def gait_view(open_gait: OpenGait, plan: Plan, pages: frozenset[str] = frozenset()) -> Json:
    """Everything that the page shows of one gait.

    Args:
        open_gait: the gait.
        plan: what it amounts to.
        pages: that are connected.
    """
    gait = open_gait.gait
    saved_at = open_gait.saved_at
    times = None if plan.is_draft else robot_times(plan)
    return {
        **line_view(open_gait.id, gait, open_gait.builtin, open_gait.edited, times=times),
        "revision": open_gait.revision,
        "stamp": next(_stamps),  # orders answers and events, which may overtake each other
        "saved_at": None if saved_at is None else datetime.fromtimestamp(saved_at, UTC).isoformat(),
        **steps_view(open_gait, pages),
        "document": gait_content(gait),
        "roles": list(gait.roles),
        "mirror": mirror_of(gait, plan.model),
        "edits": list(open_gait.history.newest_edits),
        "notice": open_gait.notice,
        "conversion_refusal": conversion_refusal(gait, plan.model),
        "changed": open_gait.before is not None,
        "provenance": provenance_view(gait, plan),
        "plan": plan_view(plan),
        "verdict": None if open_gait.verdict is None else verdict_view(open_gait.verdict),
        "approval": None if open_gait.approval is None else approval_view(open_gait.approval),
        "revoked": open_gait.revoked if open_gait.approval is None else None,
    }


def plan_view(plan: Plan) -> Json:
    """A plan for preview and plots, SI but for strokes."""
    refusal = plan.refusal
    limits = plan.model.stroke
    content: Json = {
        "hash": plan.session_hash,
        "source": plan.source.value,
        "note": plan.note,
        "seconds": plan.seconds,
        "refusal": None if refusal is None else {"sentence": refusal.sentence, "where": refusal.where},
        "misfit": plan.misfit,
        "clipped_mm": clipped_content(plan.clipped),
        "times": [],
        "contact": [],
        "body": [],
        "heading": [],
        "feet": [],
        "margin": [],
        "balance": plan.balance,
        "robot_margin": plan.model.margin,
        "strokes_mm": None,
        "stroke_limits_mm": [limits.lower * 1000, limits.upper * 1000],
        "foot_speeds_mm_s": None,
        "motor_speeds_mm_s": None,
        "motor_speed_limit_mm_s": limits.speed * 1000,
        "real_heights_mm": None,
        "slip": None if plan.slip is None else plan.slip.tolist(),
        "waypoints_hash": None,
        "waypoint_count": 0,
        "robot_seconds": None,
        "speed_mm_s": None,
        "poses": None,
        "every_knot_seconds": None,
        "stop_seconds": None,
        "waypoint_strokes_mm": [],
        "waypoint_times": [],
        "waypoint_seconds": [],
        "duration": 0.0,
        "live": None if plan.live is None else live_view(plan.live),
        "parts": [asdict(part) for part in plan.parts],
    }
    trajectory = plan.trajectory
    if trajectory is not None:
        content |= {
            "times": trajectory.times.tolist(),
            "contact": trajectory.contact.tolist(),
            "body": np.round(trajectory.body_world, 7).tolist(),
            "heading": trajectory.heading.tolist(),
            "feet": np.round(trajectory.feet_world, 7).tolist(),
            "margin": finite(np.round(plan.margins, 7).tolist()),
            "duration": float(trajectory.times[-1]),
            "foot_speeds_mm_s": np.round(foot_speeds(trajectory) * 1000, 2).tolist(),
            "motor_speeds_mm_s": finite(_motor_speeds_mm_s(plan.model, trajectory).tolist()),
        }
        if plan.made is not None:
            poses = plan.made.poses
            heights_mm = poses.at(trajectory.times, poses.motion.heights) * 1000
            content["real_heights_mm"] = finite(np.round(heights_mm, 4).tolist())
        if plan.waypoints is None:
            content["strokes_mm"] = finite(np.round(plan.free_strokes * 1000, 4).tolist())
    if plan.way is not None:
        content |= _way_view(plan.way)
    times = robot_times(plan)
    if times is not None:
        content["speed_mm_s"] = round(times.speed * 1000, 3)
    if plan.poses is not None:
        content["poses"] = _poses_view(plan)
    return content


def _poses_view(plan: Plan) -> Json:
    """What a gait for the robot's clock has beside its motion.

    `heard` has a time in each move, s: the robot hears a Stop from then on, since its first ramp has ended.
    `pinnable` says whether a pose can be pinned.
    """
    heard = np.zeros(0) if plan.poses is None else heard_times(plan.poses)
    return {
        "solved": plan.source is PlanSource.POSES,
        "explanation": list(plan.infeasible),
        "heard": np.round(heard, 3).tolist(),
        "pinnable": plan.poses is None or plan.poses.problem.is_pinnable,
    }


def _way_view(way: WaypointPlan) -> Json:
    """The waypoints of a plan as sent, with their times as planned and on the robot."""
    seconds = move_estimates(way.waypoints)
    return {
        "strokes_mm": way.knots.strokes_mm.tolist(),
        "waypoints_hash": way.waypoints.content_hash,
        "waypoint_count": way.waypoints.count,
        "robot_seconds": round(estimate_seconds(way.waypoints), 1),
        "every_knot_seconds": round(estimate_seconds(way.knots), 1),
        "stop_seconds": round(stop_time(way.waypoints), 2),
        "waypoint_strokes_mm": way.waypoints.strokes_mm.tolist(),
        "waypoint_times": np.round(way.times, 4).tolist(),
        "waypoint_seconds": np.round(np.cumsum(seconds) - seconds[0], 3).tolist(),
    }


def _motor_speeds_mm_s(model: RobotModel, trajectory: Trajectory) -> Floats:
    """(n, 3·legs), nan where a rod is too short."""
    speeds = motor_speeds(model, trajectory).reshape(trajectory.knot_count, -1)
    return np.round(speeds * 1000, 2)


def live_view(answer: VerifiedResult) -> Json:
    """The live tier's verified result; indices count from 0."""
    result, check = answer.result, answer.check
    figures = {
        "status": answer.status.value,
        "seconds": result.solve_seconds,
        "evidence": None if result.evidence is None else result.evidence.value,
        "explanation": list(answer.explanation),
        "lacks": [
            {**asdict(lack), "rings": reach_rings(answer.problem, result.trajectory, lack)}
            for lack in result.lacks
        ],
        "check": {
            "max_violation": check.max_violation,
            "violations": check.violations,
            "min_margin": check.min_margin,
            "min_cop_margin": check.min_cop_margin,
        },
    }
    content: Json = finite(figures)
    return content
