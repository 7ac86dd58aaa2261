"""Documents that the studio kept itself: what earlier versions allowed opens, with a sentence."""

from __future__ import annotations

import json
from typing import Any

import pytest

from app.documents.gait_json import gait_content, gait_from_content
from app.documents.stored_gait import stored_content, stored_gait
from core.errors import InputError
from core.library.library import library


def walk(margin: float) -> dict[str, Any]:
    content: dict[str, Any] = json.loads(json.dumps(gait_content(library()["walk"].gait)))
    content["options"]["margin"] = margin
    return content


def test_a_kept_negative_margin_opens_as_none_with_a_sentence() -> None:
    stored = stored_content(walk(-0.004))
    assert stored.gait.options.margin == 0.0
    assert stored.notice == (
        "Kept by an earlier version with a stability margin of -4 mm (now 0): a margin is at least 0."
    )


def test_a_part_of_a_kept_sequence_too() -> None:
    content = json.loads(json.dumps(gait_content(library()["walk-turn-s-gait"].gait)))
    content["sequence"][0]["gait"]["options"]["margin"] = -0.001
    stored = stored_gait(json.dumps(content))
    assert stored.gait.sequence[0].gait.options.margin == 0.0
    assert stored.notice is not None
    assert "-1 mm (now 0)" in stored.notice


def test_nothing_is_said_of_what_is_as_it_was() -> None:
    assert stored_content(walk(0.003)).notice is None


def test_a_negative_margin_from_elsewhere_is_refused() -> None:
    with pytest.raises(InputError, match="it must lie between 0 and 50 mm"):
        gait_from_content(walk(-0.004), "gait")
