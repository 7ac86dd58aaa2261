"""Whole contents of rows, as the studio keeps them."""

from __future__ import annotations

from typing import Any

Content = dict[str, Any]

PHYSICS: Content = {
    **dict.fromkeys(("name", "title", "masses"), "scales"),
    **dict.fromkeys(("friction", "link_stiffness", "motor_speed", "motor_force", "weak_share"), 1.0),
    **dict.fromkeys(("body_mass_factor", "cable_drag", "backlash", "gravity"), 1.0),
    "weak_motor": None,
    "ground_tilt": [0.0, 0.0],
    "centre_offset": [0.0, 0.0],
}


def job(key: str, made: float = 1.0, state: str = "done", **more: Any) -> Content:
    """A job."""
    names = {"id": key, "kind": "track", "gait": "walk", "motion": "0" * 64, "state": state}
    return {**names, "created": made, **more}


def run(key: str, made: float = 1.0, state: str = "done", **more: Any) -> Content:
    """A run."""
    names = {"id": key, "gait": "w", "gait_name": "W", "waypoints_hash": "0" * 64, "by": "Ada"}
    times = {"started": made, "started_monotonic": made, "ended": made}
    return {**names, **times, "state": state, "sentence": "", **more}


def simulation(key: str, made: float = 1.0) -> Content:
    """A simulation."""
    names = {"key": key, "gait": "walk", "robot": "deltawalker", "waypoints_hash": "w", "physics": PHYSICS}
    results: Content = {"report": {}, "findings": [], "variations": None, "motion": {}}
    return {**names, "made": made, "seconds": 1.0, **results}


def learning(key: str, made: float = 1.0, state: str = "done") -> Content:
    """A course of learning."""
    words = {"by": "", "source": "", "robot": "deltawalker", "sentence": "", "state": state}
    numbers = {"gaits": 3, "done": 0, "total": 9, "left_seconds": None, "ended": None}
    return {"id": key, "made": made, **words, **numbers, "result": None}


def trial(key: str, made: float = 1.0) -> Content:
    """A trial."""
    words = dict.fromkeys(("name", "by", "note", "gait", "gait_name", "run"), "")
    numbers = {"expected_cm": 1.0, "iterations": 1, "frame_rate": 13.0}
    return {"id": key, "made": made, **words, **numbers, "ends": None, "plan": None, "sight": None}


def video(key: str, made: float = 1.0) -> Content:
    """A video."""
    words = dict.fromkeys(("name", "run", "camera", "trial", "sentence"), "")
    numbers = {"bytes": 1, "frames": 1, "rate": 13.0, "size": [64, 64], "seconds": 0.1}
    return {
        "id": key,
        "made": made,
        "kind": "upload",
        "file": f"{key}.avi",
        "state": "kept",
        **words,
        **numbers,
    }
