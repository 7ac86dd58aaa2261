"""The gait document as JSON: its schema, reading with sentences for what is wrong, and writing."""

import hashlib
import json
from dataclasses import replace
from math import ceil
from typing import Any

import numpy as np
from pydantic import ValidationError

from app.common.json import Json
from app.documents.gait_schema import (
    GaitDocument,
    OptionsModel,
    PosesModel,
    ProvenanceModel,
    RecordingFitModel,
    RecordingModel,
    SegmentTableModel,
    SingleGaitModel,
    TimelineModel,
)
from app.documents.migrations import VERSION, migrated
from core.errors import InputError
from core.gait.gait import Gait, SequencePart
from core.gait.held_feet import HeldFeet
from core.gait.options import GaitOptions
from core.gait.poses import POSE_LIMITS, FoundPoses, PinnedPose, Poses
from core.gait.provenance import Provenance
from core.gait.recording import AS_RECORDED, Recording, RecordingFit
from core.motion.contact_timeline import ContactTimeline, bits_from_rows, rows_from_bits
from core.robot.model import RobotModel, load_robot
from core.segments.segment_table import Segment, SegmentTable, SegmentVocabulary, require_heights
from core.text.documents import json_content
from core.text.json_size import require_few_values

FORMAT = "footfall-gait"
MOST_BYTES = 2_000_000
"""A document of more bytes is not taken."""


def gait_schema() -> Json:
    """The published JSON Schema (2020-12) of the document."""
    return GaitDocument.model_json_schema()


def parse_gait(text: str | bytes, where: str = "gait") -> Gait:
    """Reads a gait document.

    Args:
        text: the JSON text.
        where: file name or field, for messages.

    Raises:
        InputError: naming the field, what is wrong and what would be right.
    """
    require_few_values(text, where)
    return gait_from_content(json_content(text, where), where)


def gait_from_content(content: Any, where: str = "gait") -> Gait:
    """Reads a gait document that is already parsed JSON (see `parse_gait`)."""
    if not isinstance(content, dict) or content.get("format") != FORMAT:
        raise InputError(f'{where} is not a gait document: "format" must be "{FORMAT}".', f"{where}.format")
    content = _parts_migrated(migrated(content, where), where)
    try:
        document = GaitDocument.model_validate(content)
    except ValidationError as error:
        first = error.errors()[0]
        field = ".".join(str(part) for part in first["loc"]).encode(errors="backslashreplace").decode()
        raise InputError(f"{where}, field {field}: {first['msg']}.", f"{where}.{field}") from error
    _require_whole(content, where)
    parts = [
        SequencePart(_to_gait(part.gait), part.times, part.source, part.restarts)
        for part in document.sequence
    ]
    return _to_gait(document, tuple(parts))


def _require_whole(content: Json, where: str) -> None:
    """Every text and name can be written down: none holds half of a character (a lone surrogate).

    Raises:
        InputError: one does.
    """
    text = json.dumps(content, ensure_ascii=False)
    try:
        text.encode()
    except UnicodeEncodeError as error:
        beside = text[max(error.start - 30, 0) : error.start]
        raise InputError(f"{where} holds half a character after “{beside}”; type it again.", where) from error


def _parts_migrated(content: Json, where: str) -> Json:
    """A sequence's parts in the present version as well; what is no part is left to the schema."""
    parts = content.get("sequence")
    if not isinstance(parts, list):
        return content
    moved = [
        {**part, "gait": migrated(part["gait"], f"{where}.sequence.{index}.gait")}
        if isinstance(part, dict) and isinstance(part.get("gait"), dict)
        else part
        for index, part in enumerate(parts)
    ]
    return {**content, "sequence": moved}


def _to_gait(document: SingleGaitModel, parts: tuple[SequencePart, ...] = ()) -> Gait:
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
        segment_table=_to_table(document.segment_table, model),
        options=GaitOptions(**document.options.model_dump()),
        notes=document.notes,
        recorded=_to_recording(document.recorded),
        provenance=None if document.provenance is None else Provenance(**document.provenance.model_dump()),
        sequence=parts,
        held=HeldFeet(tuple(document.held.start), tuple(document.held.end)),
        poses=_to_poses(document.poses, feet),
    )


def _to_timeline(model: TimelineModel) -> ContactTimeline:
    stance = bits_from_rows(model.feet, "timeline.feet")
    locked = (
        np.zeros_like(stance) if model.locked is None else bits_from_rows(model.locked, "timeline.locked")
    )
    return ContactTimeline(stance, locked, model.sample_time)


def _to_table(model: SegmentTableModel | None, robot: RobotModel) -> SegmentTable | None:
    if model is None:
        return None
    if len(model.feet) != robot.leg_count:
        raise InputError(
            f"The segment table has {len(model.feet)} feet; the robot has {robot.leg_count}.",
            "segment_table.feet",
        )
    require_heights(model.definitions.z, robot.stroke)
    segments = {name: Segment(**s.model_dump()) for name, s in model.definitions.segments.items()}
    vocabulary = SegmentVocabulary(model.definitions.xy, model.definitions.z, segments)
    rows, link = (tuple(tuple(row) for row in rows) for rows in (model.feet, model.link))
    return SegmentTable(rows, model.samples_per_segment, model.repeat_from, vocabulary, model.repeat_to, link)


def _to_poses(model: PosesModel | None, feet: int) -> Poses | None:
    if model is None:
        return None
    found = model.found
    if found is not None and any(len(pose) != feet for pose in found.feet):
        raise InputError(f"poses.found.feet needs {feet} feet at each pose.", "poses.found.feet")
    kept = None if found is None else FoundPoses(**found.model_dump())
    pinned = tuple(PinnedPose(pin.pose, pin.along, pin.sideways) for pin in model.pinned)
    limits = {name: getattr(model, name) for name in POSE_LIMITS}
    return Poses(model.free_step, **limits, sway=model.sway, overlap=model.overlap, found=kept, pinned=pinned)


def _to_recording(model: RecordingModel | None) -> Recording | None:
    if model is None:
        return None
    fit = RecordingFit(**model.fit.model_dump())
    recording = Recording(model.file, model.form, model.text, model.companion, tuple(model.assumed), fit)
    if recording.sha256 != model.sha256:
        raise InputError(
            f"The recorded motion's text has the SHA-256 {recording.sha256[:10]}…, the document says "
            f"{model.sha256[:10]}…: the text was changed since. Import {model.file} again.",
            "recorded.sha256",
        )
    return recording


def gait_content(gait: Gait) -> Json:
    """The document as JSON content; reading it back gives the same gait."""
    table = gait.segment_table
    options = gait.options
    content: Json = {
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
        "recorded": None if gait.recorded is None else _recording_content(gait.recorded),
        "provenance": None
        if gait.provenance is None
        else ProvenanceModel(**vars(gait.provenance)).model_dump(),
    }
    if gait.held.any:
        content["held"] = {"start": list(gait.held.start), "end": list(gait.held.end)}
    if gait.poses is not None:
        content["poses"] = _poses_content(gait.poses)
    if gait.sequence:
        content["sequence"] = [
            {"gait": gait_content(part.gait), "times": part.times, "source": part.source, **_restarts(part)}
            for part in gait.sequence
        ]
    return content


def _restarts(part: SequencePart) -> Json:
    """Left out where it is not asked, so that documents without it keep their text and their hash."""
    return {"restarts": True} if part.restarts else {}


def _poses_content(poses: Poses) -> Json:
    found = poses.found
    content = {name: getattr(poses, name) for name in ("free_step", *POSE_LIMITS)}
    if poses.overlap:
        content["overlap"] = True
    if poses.sway:
        content["sway"] = poses.sway
    if poses.pinned:
        content["pinned"] = [vars(pin) for pin in poses.pinned]
    return content | {"found": None if found is None else found_content(found)}


def found_content(found: FoundPoses) -> Json:
    """Poses that were found, as JSON content."""
    headings = {} if found.headings is None else {"headings": found.headings.tolist()}
    return {
        "answers": found.answers,
        "step": found.step,
        "bodies": found.bodies.tolist(),
        "feet": found.feet.tolist(),
        **headings,
    }


def _recording_content(recording: Recording) -> Json:
    return {
        "file": recording.file,
        "form": recording.form.value,
        "text": recording.text,
        "companion": recording.companion,
        "sha256": recording.sha256,
        "assumed": list(recording.assumed),
        **_fit_content(recording),
    }


def _fit_content(recording: Recording) -> Json:
    """Left out where the motion is as recorded, so that documents without it keep their text and hash."""
    if recording.fit == AS_RECORDED:
        return {}
    return {"fit": RecordingFitModel(**vars(recording.fit)).model_dump(mode="json")}


def _table_content(table: SegmentTable) -> Json:
    words = table.vocabulary
    return {
        "samples_per_segment": table.samples_per_segment,
        "repeat_from": table.repeat_from,
        "repeat_to": table.repeat_to,
        "link": [list(row) for row in table.link],
        "feet": [list(row) for row in table.rows],
        "definitions": {
            "xy": dict(words.xy),
            "z": dict(words.z),
            "segments": {
                name: {"start": s.start, "end": s.end, "swing": s.swing} for name, s in words.segments.items()
            },
        },
    }


_WORDS_ALONE = ("name", "notes", "provenance")
"""Fields that no motion depends on."""
_SENDING = ("merge", "stop_bound")
"""Options of how a motion is sent, which it does not depend on."""
_OF_POSES = ("margin", "clearance", "stop_bound")
"""Options that a gait with poses asks; the others do nothing there."""


def motion_hash(gait: Gait) -> str:
    """SHA-256 of everything in the document that a motion depends on: all but name, notes and provenance."""
    content = {key: value for key, value in gait_content(gait).items() if key not in _WORDS_ALONE}
    if gait.poses is None:
        content["options"] = {key: value for key, value in content["options"].items() if key not in _SENDING}
    # The usual foot speed, which earlier documents did not name, changes no hash.
    if content["options"].get("foot_speed") == GaitOptions.foot_speed:
        del content["options"]["foot_speed"]
    # A gait without a recorded motion keeps the hash under which earlier results of it are kept.
    recording = content.pop("recorded")
    if gait.recorded is not None:
        content["recorded"] = {"form": recording["form"], "sha256": recording["sha256"]}
        content["recorded"]["companion"] = gait.recorded.companion_sha256
        content["recorded"] |= _fit_content(gait.recorded)
    if gait.poses is not None:
        content = _asked_poses(content, gait.poses)
    if gait.sequence:
        parts = [
            {"motion": motion_hash(part.gait), "times": part.times, **_restarts(part)}
            for part in gait.sequence
        ]
        content["sequence"] = parts
    return hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()


def _asked_poses(content: Json, poses: Poses) -> Json:
    """What a gait with poses asks; the poses that were found, a free step and the timeline follow from it."""
    asked = {key: value for key, value in content.items() if key != "timeline"}
    asked["options"] = {name: content["options"][name] for name in _OF_POSES}
    asked["poses"] = {key: value for key, value in content["poses"].items() if key != "found"}
    if poses.free_step:
        dx, dy, turn = content["step"]
        length = float(np.hypot(dx, dy))
        turn = turn if length else float(np.sign(turn))  # on the spot it is the turn that is free
        asked["step"] = [round(dx / (length or 1.0), 9), round(dy / (length or 1.0), 9), round(turn, 9)]
    return asked


def sent_hash(gait: Gait) -> str:
    """SHA-256 of everything in the document that its waypoints depend on: the motion, and how it is sent."""
    if gait.poses is not None:
        return motion_hash(gait)
    sending = {name: getattr(gait.options, name) for name in _SENDING}
    return hashlib.sha256(f"{motion_hash(gait)}{json.dumps(sending, sort_keys=True)}".encode()).hexdigest()


def asked_hash(gait: Gait) -> str:
    """SHA-256 of what a solver is asked for a gait, whose own recorded motion is left aside."""
    return motion_hash(replace(gait, recorded=None))


def require_size(gait: Gait, where: str) -> None:
    """A gait that is to become a document is small enough for one.

    Raises:
        InputError: it is too large.
    """
    require_bytes(len(json.dumps(gait_content(gait), ensure_ascii=False).encode()), where)


def require_bytes(size: int, where: str) -> None:
    """What is to stand in a document leaves it small enough (see `require_size`)."""
    if size > MOST_BYTES:
        raise InputError(
            f"{where} would make a gait document of {ceil(size / 1000)} kB; at most {MOST_BYTES // 1000} kB "
            "are kept. Sample the motion more coarsely, or cut it into several files.",
            where,
        )
