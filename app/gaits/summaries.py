"""The list of gaits: a line each, made once and again only where its file or its editing changed."""

import logging
from typing import Any

from app.gaits.recovery import WayOut
from app.gaits.repository import MISNAMED
from app.gaits.service import GaitService
from app.gaits.views import line_view, problem_view
from core.errors import FootfallError, NotFoundError
from core.library.library import library

logger = logging.getLogger(__name__)

Line = dict[str, Any]
"""What the list shows of a gait."""

Mark = tuple[object, ...]
"""Changes whenever a gait's line may."""


class GaitSummaries:
    """The lines, kept by gait.

    Args:
        service: the gaits.
    """

    def __init__(self, service: GaitService) -> None:
        self._service = service
        self._kept: dict[str, tuple[Mark, Line | None]] = {}
        self._given: frozenset[str] = frozenset()

    def lines(self) -> list[Line]:
        """A line of every gait, and of every file that cannot be opened, which says why."""
        lines = self._lines()
        self._given = frozenset(line["id"] for line in lines)
        return lines

    def _lines(self) -> list[Line]:
        marks = self._service.open_gaits.marks()
        self._kept = {gait_id: self._line(gait_id, mark) for gait_id, mark in marks.items()}
        lines = [line for _, line in self._kept.values() if line is not None]
        misnamed = self._service.open_gaits.misnamed()
        return lines + [problem_view(name, MISNAMED.format(name)) for name in misnamed]

    def troubles(self) -> dict[str, str]:
        """What is wrong with files, in sentences, by gait; nobody is given a list."""
        found = ((line["id"], line["problem"] or line["outside"]) for line in self._lines())
        return {gait_id: sentence for gait_id, sentence in found if sentence is not None}

    def has(self, gait_id: str) -> bool:
        """Whether the list that was given out last has a gait."""
        return gait_id in self._given

    def _line(self, gait_id: str, mark: Mark) -> tuple[Mark, Line | None]:
        kept = self._kept.get(gait_id)
        if kept is not None and kept[0] == mark:
            return kept
        try:
            outside = self._service.open_gaits.outside(gait_id)
            gait, builtin, edited = self._service.open_gaits.glance(gait_id)
            times = self._service.times.of(gait_id, gait, is_original=builtin and not edited)
            return mark, line_view(gait_id, gait, builtin, edited, outside, times)
        except NotFoundError:
            return mark, None
        except FootfallError as error:
            sentence = error.sentence
        except Exception as error:  # one gait that nobody foresaw must not hide all others
            logger.exception("The line of %s in the list of gaits cannot be made.", gait_id)
            sentence = (
                f"The studio met an error of its own ({type(error).__name__}), which its log describes."
            )
        return mark, problem_view(gait_id, sentence, gait_id in library(), self._way_out(gait_id))

    def _way_out(self, gait_id: str) -> WayOut | None:
        """The way out of a gait that cannot be shown; None where that cannot be found out either."""
        try:
            return self._service.open_gaits.way_out(gait_id)
        except Exception:  # the row must stand all the same
            logger.exception("The way out of %s cannot be found.", gait_id)
            return None
