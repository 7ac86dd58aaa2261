"""A run as a file: CSV, and MCAP for Foxglove and other viewers of recordings."""

from __future__ import annotations

import base64
import io
import json
import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from app.common.json import Json
from app.common.table_cell import table_cell
from app.common.version import VERSION
from app.gaits.verdict_views import override_words
from app.runs.record import RunRecord
from core.wire.messages import MOTORS

if TYPE_CHECKING:
    from mcap.writer import Writer

_NUMBERS = {"type": "array", "items": {"type": "number"}, "minItems": 12, "maxItems": 12}
_SECONDS = {"type": "number", "description": "s since the run began"}

_CHANNELS: dict[str, Json] = {
    "measured": {"time": _SECONDS, "strokes_mm": _NUMBERS},
    "commanded": {
        "time": _SECONDS,
        "waypoint": {
            "type": ["integer", "null"],
            "description": "1-based; null on the way to the start pose",
        },
        "iteration": {"type": "integer", "description": "1-based"},
        "arrived": {"type": ["number", "null"], "description": "s since the run began"},
        "strokes_mm": _NUMBERS,
    },
    "state": {
        "time": _SECONDS,
        "link": {"type": "string"},
        "robot": {"type": "string"},
        "cause": {"type": "string"},
    },
    "bytes": {
        "time": _SECONDS,
        "direction": {"enum": ["to robot", "from robot"]},
        "data": {"type": "string", "contentEncoding": "base64"},
    },
}
"""Fields of each channel's messages; the topic is `/run/` and the name."""

_Message = tuple[float, str, Json]


def run_csv(record: RunRecord) -> str:
    """Time in s since the run began, the robot's state, commanded and measured strokes in mm.

    What was commanded is empty before the first message. A run that was approved in spite of errors has a
    last column that says so.
    """
    names = [f"{kind}_h{motor + 1}" for kind in ("commanded", "measured") for motor in range(MOTORS)]
    override = record.content.get("override")
    spite = [] if override is None else ['"{}"'.format(override_words(override).replace('"', '""'))]
    lines = [",".join(["t", "state", *names, *(["approved_in_spite_of"] if spite else [])])]
    series = record.series
    rows = zip(series.times, record.states_told, record.commanded_mm, series.measured_mm, strict=True)
    for time, state, commanded, measured in rows:
        numbers = ["" if math.isnan(value) else f"{value:.4f}" for value in (*commanded, *measured)]
        lines.append(",".join([f"{time:.4f}", table_cell(state), *numbers, *spite]))
    return "\n".join(lines) + "\n"


def run_mcap(record: RunRecord) -> bytes:
    """The run's file: measured and commanded strokes, states, raw bytes, and the record as metadata.

    It holds JSON messages with their schemas. Their times are the wall clock's at the run's beginning plus
    the time since by `boot_seconds`.
    """
    from mcap.writer import Writer  # only who asks for it waits for the package

    stream = io.BytesIO()
    writer = Writer(stream)
    writer.start(profile="", library=f"footfall-studio {VERSION}")
    channels = {name: _register(writer, name, fields) for name, fields in _CHANNELS.items()}
    began = record.content["started"]
    for number, (time, name, content) in enumerate(sorted(_messages(record), key=lambda one: one[0])):
        moment = int((began + time) * 1e9)
        writer.add_message(
            channel_id=channels[name],
            log_time=moment,
            publish_time=moment,
            sequence=number,
            data=json.dumps({"time": round(time, 6), **content}, allow_nan=False).encode(),
        )
    words = {key: str(value) for key, value in record.content.items()}
    if (override := record.content.get("override")) is not None:
        words["override"] = override_words(override)
    writer.add_metadata("run", {**words, "note": record.row.note})
    writer.finish()  # type: ignore[no-untyped-call]
    return stream.getvalue()


def _register(writer: Writer, name: str, fields: Json) -> int:
    schema = {"title": name, "type": "object", "properties": fields, "required": list(fields)}
    number = writer.register_schema(f"footfall.{name}", "jsonschema", json.dumps(schema).encode())
    return writer.register_channel(topic=f"/run/{name}", message_encoding="json", schema_id=number)


def _messages(record: RunRecord) -> Iterator[_Message]:
    for time, strokes in zip(record.series.times.tolist(), record.series.measured_mm.tolist(), strict=True):
        yield time, "measured", {"strokes_mm": strokes}
    for command in record.series.commands:
        yield (
            command.sent,
            "commanded",
            {
                "waypoint": command.index + 1 if command.leads_on else None,
                "iteration": command.lap + 1,
                "arrived": command.arrived if command.measured_mm else None,
                "strokes_mm": list(command.target_mm),
            },
        )
    for state in record.states:
        yield state.time, "state", {"link": state.link, "robot": state.robot, "cause": state.cause}
    for piece in record.pieces:
        direction = "to robot" if piece.to_robot else "from robot"
        yield piece.time, "bytes", {"direction": direction, "data": base64.b64encode(piece.data).decode()}
