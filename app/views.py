"""What pages and scripts are shown: JSON content of gaits, plans and verdicts."""

from __future__ import annotations

import time
from dataclasses import asdict
from datetime import UTC, datetime
from typing import Any

import numpy as np

from app.documents import gait_content
from app.finite import finite
from app.open_gait import OpenGait
from app.plans import Plan
from core.findings import Approval, Verdict
from core.segments import SegmentTable


def summary_view(open_gait: OpenGait) -> dict[str, Any]:
    """A line of the list of gaits."""
    gait = open_gait.gait
    return {
        "id": open_gait.id,
        "name": gait.name,
        "kind": "builtin" if open_gait.builtin else "saved",
        "source": "optimised" if gait.segment_table is None else "manual",
        "orientation": gait.orientation.value,
        "order": list(gait.order),
        "step": list(gait.step),
        "edited": open_gait.edited,
    }


def gait_view(open_gait: OpenGait, plan: Plan) -> dict[str, Any]:
    """Everything that the page shows of one gait."""
    gait = open_gait.gait
    saved_at = open_gait.saved_at
    return {
        **summary_view(open_gait),
        "revision": open_gait.revision,
        "stamp": time.time_ns() // 1000,  # orders answers and events, which may overtake each other
        "saved_at": None if saved_at is None else datetime.fromtimestamp(saved_at, UTC).isoformat(),
        "undo": open_gait.undo_label,
        "redo": open_gait.redo_label,
        "document": gait_content(gait),
        "roles": list(gait.roles),
        "segments": None if gait.segment_table is None else _segments(gait.segment_table, gait.quarter_turns),
        "notice": open_gait.notice,
        "plan": plan_view(plan),
        "verdict": None if open_gait.verdict is None else verdict_view(open_gait.verdict),
        "approval": None if open_gait.approval is None else approval_view(open_gait.approval),
    }


def _segments(table: SegmentTable, quarter_turns: int) -> dict[str, Any]:
    rows = table.turned(quarter_turns).rows
    swings = [name for name, segment in table.vocabulary.segments.items() if segment.swing]
    return {
        "feet": [list(row) for row in rows],
        "swings": swings,
        "samples_per_segment": table.samples_per_segment,
    }


def plan_view(plan: Plan) -> dict[str, Any]:
    """A plan for preview and plots, SI but for strokes."""
    refusal = plan.refusal
    limits = plan.model.stroke
    content: dict[str, Any] = {
        "hash": plan.hash,
        "source": plan.source.value,
        "note": plan.note,
        "refusal": None if refusal is None else {"sentence": refusal.sentence, "where": refusal.where},
        "times": [],
        "contact": [],
        "body": [],
        "heading": [],
        "feet": [],
        "margin": [],
        "balance": plan.balance,
        "strokes_mm": None,
        "stroke_limits_mm": [limits.lower * 1000, limits.upper * 1000],
        "slip": None if plan.slip is None else plan.slip.tolist(),
        "waypoints_hash": None,
        "waypoint_count": 0,
        "duration": 0.0,
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
        }
    if plan.waypoints is not None:
        content |= {
            "strokes_mm": plan.waypoints.strokes_mm.tolist(),
            "waypoints_hash": plan.waypoints.content_hash,
            "waypoint_count": plan.waypoints.count,
        }
    return content


def verdict_view(verdict: Verdict) -> dict[str, Any]:
    """A verdict with its findings, errors first; indices count from 0."""
    return {**asdict(verdict), "passed": verdict.passed, "hash": verdict.content_hash}


def approval_view(approval: Approval) -> dict[str, Any]:
    """An approval."""
    return asdict(approval)
