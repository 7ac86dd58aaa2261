"""Recordings and provenances as values: hashes see every character, and what cannot be one is refused."""

from __future__ import annotations

from dataclasses import replace
from hashlib import sha256
from typing import Any

import pytest

from core.errors import InputError
from core.gait.provenance import Provenance
from core.gait.recording import Recording, RecordingForm

WALK = Recording("walk.csv", RecordingForm.TRAJECTORY, "1,2\r\n", "{}")
RESULT = Provenance("0" * 64, "f" * 64, "nlp", "IPOPT", "solved", 0.0, "2026-11-21T18:40:00+00:00", "0.1.0")


def test_the_hash_is_that_of_the_file() -> None:
    assert WALK.sha256 == sha256(b"1,2\r\n").hexdigest()
    assert WALK.companion_sha256 == sha256(b"{}").hexdigest()
    assert replace(WALK, companion=None).companion_sha256 is None
    assert replace(WALK, text="1,2\n").sha256 != WALK.sha256


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"file": ""}, "has 0 characters; it must have 1 to 200"),
        ({"file": "x" * 201}, "has 201 characters"),
        ({"text": "half \ud800"}, "text holds half a character at 5"),
        ({"companion": "\udfff"}, "companion holds half a character at 0"),
        ({"form": RecordingForm.WAYPOINTS}, "Only a trajectory has a companion"),
        ({"assumed": ("words",) * 21}, "more than 20 assumptions"),
        ({"assumed": ("x" * 501,)}, "longer than 500 characters"),
    ],
)
def test_what_is_no_recording_is_refused(changes: dict[str, Any], message: str) -> None:
    with pytest.raises(InputError, match=message):
        replace(WALK, **changes)


@pytest.mark.parametrize(
    ("changes", "field"),
    [
        ({"motion": "0" * 63}, "motion"),
        ({"trajectory": "G" * 64}, "trajectory"),
        ({"method": ""}, "method"),
        ({"solver": "x" * 81}, "solver"),
        ({"status": "two\nlines"}, "status"),
        ({"program": "\ud800"}, "program"),
        ({"seconds": float("nan")}, "seconds"),
        ({"seconds": -0.1}, "seconds"),
        ({"made": "2026-11-21T18:40:00"}, "made"),
        ({"made": "soon"}, "made"),
    ],
)
def test_what_is_no_provenance_is_refused_by_its_field(changes: dict[str, Any], field: str) -> None:
    with pytest.raises(InputError) as refused:
        replace(RESULT, **changes)
    assert refused.value.where == f"provenance.{field}"
