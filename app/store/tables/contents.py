"""Shapes of what the tables keep as JSON: the keys that this program reads, and their kinds."""

from app.store.tables.shapes import (
    COUNT,
    MOMENT,
    NUMBER,
    POSITIVE,
    WHOLE,
    Fields,
    ListOf,
    Mapped,
    Maybe,
    Number,
    Numbers,
    OneOf,
    Shape,
    anything,
    text,
    truth,
)

OBJECT = Fields()

JOB = Fields(
    {
        "id": text,
        "kind": text,
        "gait": text,
        "gait_name": Maybe(text),
        "motion": text,
        "state": text,
        "sentence": Maybe(text),
        "created": MOMENT,
        "started": Maybe(MOMENT),
        "ended": Maybe(MOMENT),
        "progress": Maybe(ListOf(OBJECT)),
        "result": Maybe(OBJECT),
        "share": Maybe(NUMBER),
        "done": Maybe(COUNT),
        "count": Maybe(COUNT),
    }
)
FOUND_POSES = Fields({"answers": text, "step": NUMBER, "bodies": Numbers(2), "feet": Numbers(3)})
TRAJECTORY = Fields(
    {
        "times": Numbers(1),
        "body_world": Numbers(2),
        "heading": Numbers(1),
        "feet_world": Numbers(3),
        "contact": Numbers(2),
        "body_velocity": Maybe(Numbers(2)),
        "feet_velocity": Maybe(Numbers(3)),
        "contact_forces": Maybe(Numbers(3)),
    }
)
PROVENANCE = Fields({"motion": text, "trajectory": text})
RESULT = Fields(
    {
        "status": Maybe(text),
        "explanation": Maybe(ListOf(text)),
        "solve_seconds": Maybe(NUMBER),
        "trajectory": Maybe(TRAJECTORY),
        "found": Maybe(FOUND_POSES),
        "provenance": Maybe(PROVENANCE),
    }
)

RUN = Fields(
    {
        "id": text,
        "gait": text,
        "gait_name": text,
        "waypoints_hash": text,
        "by": text,
        "from": Maybe(COUNT),
        "iterations": Maybe(COUNT),
        "started": MOMENT,
        "started_monotonic": NUMBER,
        "ended": Maybe(MOMENT),
        "state": text,
        "sentence": text,
        "reached": Maybe(COUNT),
        "count": Maybe(COUNT),
        "seconds": Maybe(NUMBER),
        "left_out": Maybe(COUNT),
        "override": Maybe(OBJECT),
    }
)
SENT: dict[str, Shape] = {
    "robot": text,
    "durations": Numbers(1),
    "strokes_mm": Numbers(2),
    "times": Numbers(1),
    "trajectory": TRAJECTORY,
}
"""Waypoints with the motion that they were made from."""
ERROR = Fields({"rule": text, "severity": text, "sentence": text})
OVERRIDE = Fields({"rules": ListOf(text), "reason": text, "errors": ListOf(ERROR)})
APPROVAL: dict[str, Shape] = {
    "verdict_hash": text,
    "waypoints_hash": text,
    "by": text,
    "when": text,
    "warnings": Maybe(ListOf(text)),
    "robot_hash": Maybe(text),
    "form": Maybe(WHOLE),
    "override": Maybe(OVERRIDE),
}
APPROVAL_FIGURES = Fields(
    {
        "waypoints": Maybe(COUNT),
        "seconds": Maybe(NUMBER),
        "stop_seconds": Maybe(NUMBER),
        "simulated": Maybe(truth),
        "margins": Maybe(Mapped(ListOf(anything, 2))),
    }
)
APPROVAL_RECORD = Fields({**APPROVAL, "version": Maybe(WHOLE), "figures": Maybe(APPROVAL_FIGURES)})
RUN_PLAN = Fields(
    {**SENT, "approval": Maybe(Fields(APPROVAL)), "merge": Maybe(NUMBER), "stop_bound": Maybe(NUMBER)}
)
_SCALARS = (
    "arrived",
    "largest_mm",
    "largest_motor",
    "body_largest_mm",
    "seconds",
    "estimate",
    "start_seconds",
)
_LISTS = (
    "motor_mean_mm",
    "motor_largest_mm",
    "motor_waypoint",
    "foot_mean_mm",
    "foot_largest_mm",
    "foot_path_mm",
)
RUN_FIGURES = Fields(
    {
        "version": WHOLE,
        **dict.fromkeys(_SCALARS, Maybe(NUMBER)),
        **dict.fromkeys(_LISTS, Maybe(ListOf(Maybe(NUMBER)))),
    }
)

_FACTORS = (
    "friction",
    "link_stiffness",
    "motor_speed",
    "motor_force",
    "weak_share",
    "body_mass_factor",
    "cable_drag",
    "backlash",
    "gravity",
)
PHYSICS = Fields(
    {
        **dict.fromkeys(("name", "title", "masses"), text),
        **dict.fromkeys(_FACTORS, NUMBER),
        "weak_motor": Maybe(WHOLE),
        **dict.fromkeys(("ground_tilt", "centre_offset"), ListOf(NUMBER, 2)),
    }
)
"""A set of physics parameters."""

SIMULATION = Fields(
    {
        "key": text,
        "gait": text,
        "robot": text,
        "waypoints_hash": text,
        "physics": PHYSICS,
        "made": MOMENT,
        "seconds": NUMBER,
        "report": OBJECT,
        "findings": ListOf(ERROR),
        "variations": Maybe(anything),
        "motion": OBJECT,
    }
)

TRIAL_PLAN = Fields(
    {"times": Numbers(1), "feet": Numbers(3), "laps": Maybe(COUNT), "lap_seconds": Maybe(NUMBER)}
)
SIGHT = Fields(
    {
        "times": Numbers(1),
        "source": anything,
        "unseen": anything,
        "false": anything,
        "remarks": ListOf(text),
        "run_ends": Maybe(ListOf(COUNT)),
    }
)
TRIAL = Fields(
    {
        "id": text,
        "made": MOMENT,
        "name": text,
        "by": text,
        "expected_cm": POSITIVE,
        "iterations": Number(least=1, most=10_000, is_whole=True),
        "note": text,
        "gait": text,
        "gait_name": text,
        "run": text,
        "is_example": Maybe(truth),
        "frame_rate": Number(1e-3, 1e5),
        "ends": Maybe(ListOf(COUNT)),
        "plan": Maybe(TRIAL_PLAN),
        "sight": Maybe(SIGHT),
        "revision": Maybe(COUNT),
    }
)
TRIAL_SENT = Fields(SENT)
TRIAL_SIMULATED = Fields({"times": Numbers(1), "feet": Numbers(3), "physics": text, "ended_early": text})
PHOTO = Fields(
    {
        "id": text,
        "trial": text,
        "made": MOMENT,
        "by": text,
        "name": text,
        "caption": text,
        "width": COUNT,
        "height": COUNT,
    }
)

VIDEO = Fields(
    {
        "id": text,
        "name": text,
        "kind": OneOf(("upload", "recording")),
        "made": MOMENT,
        "file": text,
        "bytes": COUNT,
        "frames": COUNT,
        "rate": NUMBER,
        "size": ListOf(COUNT, 2),
        "seconds": NUMBER,
        "run": text,
        "camera": text,
        "trial": text,
        "state": OneOf(("kept", "recording", "removed")),
        "sentence": text,
        "hash": Maybe(text),
    }
)
SETUP = Fields(
    {
        "name": text,
        "size": Maybe(ListOf(COUNT, 2)),
        "lens": Maybe(OBJECT),
        "points": ListOf(Fields({"pixel": ListOf(NUMBER, 2), "place_cm": ListOf(NUMBER, 2)})),
        "colours": ListOf(OBJECT),
        "limits": OBJECT,
        "note": text,
    }
)
CAMERA = Fields({"name": text, "use": text, "setup": text, "records": truth})

PARAMETER = Fields({"name": text, "is_identifiable": truth})
LEARNING = Fields(
    {
        "id": text,
        "made": MOMENT,
        "ended": Maybe(MOMENT),
        "by": text,
        "source": text,
        "robot": text,
        "gaits": COUNT,
        "state": text,
        "sentence": text,
        "done": COUNT,
        "left_seconds": Maybe(NUMBER),
        "total": COUNT,
        "result": Maybe(Fields({"parameters": ListOf(PARAMETER), "physics": PHYSICS})),
    }
)
PHYSICS_SET = Fields(
    {
        "name": text,
        "version": WHOLE,
        "robot": text,
        "physics": PHYSICS,
        "learning": text,
        "made": MOMENT,
        "by": text,
        "note": text,
    }
)

_BODY_WAY, _FEET_WAY = Numbers(2, (2,)), Numbers(3, (4, 2))
PUBLISHED = Fields(
    {
        "figures": Mapped(Mapped(Maybe(NUMBER))),
        "sentence": text,
        "is_refused": truth,
        "ways": Maybe(
            Fields(
                {
                    "planned_body": _BODY_WAY,
                    "planned_feet": _FEET_WAY,
                    "body": _BODY_WAY,
                    "feet": _FEET_WAY,
                }
            )
        ),
    }
)
"""Figures of a published gait by definition and name, and ways for the plot: (n, 2) and (n, legs, 2) m."""
