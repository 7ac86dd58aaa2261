"""Segment tables: made of a drawn timeline, and mended where an edited segment does not fit."""

from dataclasses import replace
from typing import Annotated

from fastapi import APIRouter
from pydantic import Field

from app.common.json import Json
from app.documents.gait_json import gait_content, gait_from_content
from app.documents.gait_schema import SegmentTableModel
from app.web.dependencies import MOST_MOTORS, RequestBody, strokes_from_mm
from core.errors import InputError
from core.jog.pose_to_segment import pose_to_segment
from core.library.library import default_vocabulary
from core.robot.coupled_strokes import real_strokes
from core.robot.model import load_robot
from core.segments.from_timeline import table_from_timeline
from core.segments.repair import DraftTable, Repair, repairs
from core.segments.segment_table import Segment, SegmentVocabulary

router = APIRouter(tags=["segment tables"])

NOTICED_MM = 0.25
"""A foot that is further from where the names put it is named, mm."""


class Make(RequestBody):
    """A gait document whose timeline is to be said in segments."""

    document: Json


class Mend(RequestBody):
    """A table as it was typed, and its cells that must stay: foot and segment, counted from 0."""

    table: SegmentTableModel
    kept: list[tuple[int, int]] = Field(default_factory=list, max_length=4000)


class Take(RequestBody):
    """A gait document, and strokes of its robot's motors whose pose its table is to end with."""

    document: Json
    strokes_mm: list[Annotated[float, Field(allow_inf_nan=False)]] = Field(max_length=MOST_MOTORS)


@router.post("/api/tables/made")
def made_table(make: Make) -> Json:
    """The segment table that would imply a gait's timeline, or the sentence why there is none."""
    gait = gait_from_content(make.document, "document")
    if gait.segment_table is not None:
        return {"table": gait_content(gait)["segment_table"], "sentence": None}
    try:
        table = table_from_timeline(gait.timeline, gait.iterations, gait.quarter_turns, default_vocabulary())
    except InputError as error:
        return {"table": None, "sentence": error.sentence}
    return {"table": gait_content(replace(gait, segment_table=table))["segment_table"], "sentence": None}


@router.post("/api/tables/repairs")
def mended_tables(mend: Mend) -> Json:
    """Ways to mend a table in which a segment does not start where the one before ends."""
    draft = _draft(mend.table)
    found = repairs(draft, {(foot, segment) for foot, segment in mend.kept})
    return {"repairs": [_repair_content(repair, mend.table) for repair in found]}


@router.post("/api/tables/pose")
def table_with_pose(take: Take) -> Json:
    """The segment table with one more segment, in which every foot goes to where the strokes put it."""
    gait = gait_from_content(take.document, "document")
    model = load_robot(gait.robot)
    taken = pose_to_segment(
        gait, model, real_strokes(model, strokes_from_mm(model, take.strokes_mm, "strokes_mm"))
    )
    beside_mm = taken.beside * 1000
    return {
        "table": gait_content(replace(gait, segment_table=taken.table))["segment_table"],
        "name": taken.name,
        "segment": taken.table.segment_count,
        "sentences": [
            f"Foot {foot} stands {off:.1f} mm beside the line of the step, which a named place cannot say."
            for foot, off in enumerate(beside_mm.tolist(), 1)
            if off > NOTICED_MM
        ],
    }


def _draft(model: SegmentTableModel) -> DraftTable:
    segments = {name: Segment(**s.model_dump()) for name, s in model.definitions.segments.items()}
    vocabulary = SegmentVocabulary(model.definitions.xy, model.definitions.z, segments)
    rows, link = (tuple(tuple(row) for row in rows) for rows in (model.feet, model.link))
    return DraftTable(rows, model.samples_per_segment, model.repeat_from, model.repeat_to, link, vocabulary)


def _repair_content(repair: Repair, before: SegmentTableModel) -> Json:
    table = repair.table
    return {
        "foot": repair.foot,
        "first": repair.first,
        "names": list(repair.names),
        "inserted": repair.inserted,
        "table": before.model_dump()
        | {
            "feet": [list(row) for row in table.rows],
            "link": [list(row) for row in table.link],
            "repeat_from": table.repeat_from,
            "repeat_to": table.repeat_to,
        },
    }
