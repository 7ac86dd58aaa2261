"""The gait document as JSON: its schema, reading with sentences for what is wrong, and writing."""

from __future__ import annotations

import hashlib
import json
from typing import Any, Literal

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, ValidationError

from core.errors import InputError
from core.gait import Gait, GaitOptions, Orientation
from core.motion_problem import Cost, Workspace
from core.robot import load_robot
from core.segments import Segment, SegmentTable, SegmentVocabulary
from core.timeline import ContactTimeline, bits_from_rows, rows_from_bits

FORMAT = "footfall-gait"
VERSION = 1


class _Model(BaseModel):
    model_config = ConfigDict(extra="forbid", allow_inf_nan=False)


class TimelineModel(_Model):
    """Contact of each foot: a string of 1 (stance) and 0 (swing), foot 1 first; `locked` likewise."""

    sample_time: float = Field(description="time between samples, s")
    feet: list[str] = Field(min_length=1)
    locked: list[str] | None = None


class SegmentModel(_Model):
    """A segment between two named positions."""

    start: str
    end: str
    swing: bool


class VocabularyModel(_Model):
    """What the names of a segment table mean: xy factors, z strokes in m, segments."""

    xy: dict[str, float]
    z: dict[str, float]
    segments: dict[str, SegmentModel]


class SegmentTableModel(_Model):
    """A row of segment names a foot, one iteration at direction 1."""

    samples_per_segment: int
    repeat_from: int = 1
    feet: list[list[str]] = Field(min_length=1)
    definitions: VocabularyModel


class OptionsModel(_Model):
    """What the optimiser is asked, SI."""

    clearance: float = GaitOptions.clearance
    margin: float = GaitOptions.margin
    body_speed: float = GaitOptions.body_speed
    plane_height: float = GaitOptions.plane_height
    workspace: Workspace = GaitOptions.workspace
    cost: Cost = GaitOptions.cost
    phase_knots: int = GaitOptions.phase_knots
    closing_knots: int = GaitOptions.closing_knots


class GaitDocument(_Model):
    """A gait as it stands in a file."""

    format: Literal["footfall-gait"]
    version: Literal[1]
    name: str
    robot: str = "deltawalker"
    orientation: Orientation
    direction: int = 1
    order: list[int]
    step: tuple[float, float, float] = Field(description="dx, dy in m and yaw in rad, an iteration")
    iterations: int = 1
    timeline: TimelineModel
    segment_table: SegmentTableModel | None = None
    options: OptionsModel = Field(default_factory=OptionsModel)
    notes: str = ""


def gait_schema() -> dict[str, Any]:
    """The published JSON Schema of the document."""
    return GaitDocument.model_json_schema()


def parse_gait(text: str | bytes, where: str = "gait") -> Gait:
    """Reads a gait document.

    Args:
        text: the JSON text.
        where: file name or field, for messages.

    Raises:
        InputError: naming the field, what is wrong and what would be right.
    """
    try:
        content = json.loads(text)
    except RecursionError as error:
        raise InputError(f"{where} is nested too deeply to be a gait.", where) from error
    except ValueError as error:
        raise InputError(f"{where} is not JSON: {error}.", where) from error
    return gait_from_content(content, where)


def gait_from_content(content: Any, where: str = "gait") -> Gait:
    """Reads a gait document that is already parsed JSON (see `parse_gait`)."""
    if not isinstance(content, dict) or content.get("format") != FORMAT:
        raise InputError(f'{where} is not a gait document: "format" must be "{FORMAT}".', f"{where}.format")
    if content.get("version") != VERSION or isinstance(content["version"], bool):
        raise InputError(
            f"{where} has version {content.get('version')!r}; this program reads version {VERSION}. "
            "Open it with the program that wrote it.",
            f"{where}.version",
        )
    try:
        document = GaitDocument.model_validate(content)
    except ValidationError as error:
        first = error.errors()[0]
        field = ".".join(str(part) for part in first["loc"])
        raise InputError(f"{where}, field {field}: {first['msg']}.", f"{where}.{field}") from error
    return _to_gait(document)


def _to_gait(document: GaitDocument) -> Gait:
    model = load_robot(document.robot)
    feet = len(document.timeline.feet)
    if feet != model.leg_count:
        raise InputError(
            f"The timeline has {feet} feet; {document.robot} has {model.leg_count}.", "timeline.feet"
        )
    timeline = _to_timeline(document.timeline)
    return Gait(
        name=document.name,
        robot=document.robot,
        orientation=document.orientation,
        direction=document.direction,
        order=tuple(document.order),
        step=document.step,
        iterations=document.iterations,
        timeline=timeline,
        segment_table=_to_table(document.segment_table, model.leg_count),
        options=GaitOptions(**document.options.model_dump()),
        notes=document.notes,
    )


def _to_timeline(model: TimelineModel) -> ContactTimeline:
    stance = bits_from_rows(model.feet, "timeline.feet")
    locked = (
        np.zeros_like(stance) if model.locked is None else bits_from_rows(model.locked, "timeline.locked")
    )
    return ContactTimeline(stance, locked, model.sample_time)


def _to_table(model: SegmentTableModel | None, legs: int) -> SegmentTable | None:
    if model is None:
        return None
    if len(model.feet) != legs:
        raise InputError(
            f"The segment table has {len(model.feet)} feet; the robot has {legs}.", "segment_table.feet"
        )
    segments = {name: Segment(**s.model_dump()) for name, s in model.definitions.segments.items()}
    vocabulary = SegmentVocabulary(model.definitions.xy, model.definitions.z, segments)
    rows = tuple(tuple(row) for row in model.feet)
    return SegmentTable(rows, model.samples_per_segment, model.repeat_from, vocabulary)


def gait_content(gait: Gait) -> dict[str, Any]:
    """The document as JSON content; reading it back gives the same gait."""
    table = gait.segment_table
    options = gait.options
    return {
        "format": FORMAT,
        "version": VERSION,
        "name": gait.name,
        "robot": gait.robot,
        "orientation": gait.orientation.value,
        "direction": gait.direction,
        "order": list(gait.order),
        "step": [float(value) for value in gait.step],
        "iterations": gait.iterations,
        "timeline": {
            "sample_time": gait.timeline.sample_time,
            "feet": list(rows_from_bits(gait.timeline.stance)),
            "locked": list(rows_from_bits(gait.timeline.locked)),
        },
        "segment_table": None if table is None else _table_content(table),
        "options": OptionsModel(**vars(options)).model_dump(mode="json"),
        "notes": gait.notes,
    }


def _table_content(table: SegmentTable) -> dict[str, Any]:
    words = table.vocabulary
    return {
        "samples_per_segment": table.samples_per_segment,
        "repeat_from": table.repeat_from,
        "feet": [list(row) for row in table.rows],
        "definitions": {
            "xy": dict(words.xy),
            "z": dict(words.z),
            "segments": {
                name: {"start": s.start, "end": s.end, "swing": s.swing} for name, s in words.segments.items()
            },
        },
    }


def motion_hash(gait: Gait) -> str:
    """SHA-256 of everything in the document that a motion depends on: all but name and notes."""
    content = {key: value for key, value in gait_content(gait).items() if key not in ("name", "notes")}
    return hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()
