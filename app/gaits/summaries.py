"""The list of gaits: a line each, made once and again only where its file or its editing changed."""

from typing import Any

from app.gaits.service import GaitService
from app.gaits.views import line_view
from core.errors import FootfallError

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

    def lines(self) -> list[Line]:
        """A line of every gait that can be opened; one whose file is damaged is left out."""
        marks = self._service.marks()
        self._kept = {gait_id: self._line(gait_id, mark) for gait_id, mark in marks.items()}
        return [line for _, line in self._kept.values() if line is not None]

    def has(self, gait_id: str) -> bool:
        """Whether the list that was given out last has a gait."""
        return self._kept.get(gait_id, ((), None))[1] is not None

    def _line(self, gait_id: str, mark: Mark) -> tuple[Mark, Line | None]:
        kept = self._kept.get(gait_id)
        if kept is not None and kept[0] == mark:
            return kept
        try:
            return mark, line_view(gait_id, *self._service.glance(gait_id))
        except FootfallError:
            return mark, None
