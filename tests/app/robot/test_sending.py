"""How a gait is sent stands in its document: old ones, recorded ones, and what depends on it."""

from __future__ import annotations

from typing import Any

import pytest

from app.documents.gait_json import gait_content, gait_from_content, motion_hash
from app.documents.migrations import filled
from app.plans.make_plan import make_plan
from core.errors import InputError
from core.library.library import library
from solver_jobs import solve_live

WALK = library()["walk-manual-0"].gait


def without_sending(content: dict[str, Any]) -> dict[str, Any]:
    kept = {key: value for key, value in content["options"].items() if key not in ("merge", "stop_bound")}
    return {**content, "options": kept}


def test_a_document_of_before_is_merged_and_bounded() -> None:
    options = gait_from_content(without_sending(gait_content(WALK))).options
    assert (options.merge, options.stop_bound) == (0.001, 1.0)


def test_sending_changes_the_waypoints_and_no_result() -> None:
    whole = WALK.with_options(merge=0.0, stop_bound=None)
    assert motion_hash(whole) == motion_hash(WALK)
    plans = [make_plan(gait, None, solve_live) for gait in (WALK, whole, WALK.with_options(stop_bound=0.8))]
    hashes = {plan.waypoints.content_hash for plan in plans if plan.waypoints is not None}
    assert len(hashes) == 3
    assert len({plan.session_hash for plan in plans}) == 3


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"merge": -0.001}, "merge is -1 mm"),
        ({"stop_bound": 0.5}, "stop bound is 0.5 s"),
        ({"merge": 0.1}, "100 mm"),
    ],
)
def test_what_cannot_be_sent_so_is_refused(options: dict[str, Any], words: str) -> None:
    with pytest.raises(InputError, match=words):
        WALK.with_options(**options)


def test_a_recorded_motion_of_before_is_sent_as_it_is() -> None:
    assert filled({"recorded": {}, "options": {}})["options"] == {"merge": 0.0, "stop_bound": None}
    assert filled({"recorded": {}, "options": {"merge": 0.001}})["options"]["merge"] == 0.001
    assert filled({"recorded": None, "options": {}})["options"] == {}
