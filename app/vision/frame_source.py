"""A source of frames: a video file, or the recording of a camera."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any, Protocol

PICTURES, TABLE = "pictures.mjpeg", "pictures.table"
"""Files of a recording: JPEG pictures one after the other, and where each is and when."""


@dataclass(frozen=True)
class Facts:
    """What a video says of itself.

    Args:
        rate: frames a second.
        count: how many pictures; a file may hold a few less.
        size: width and height, px.
    """

    rate: float
    count: int
    size: tuple[int, int]

    @property
    def seconds(self) -> float:
        """How long it lasts."""
        return self.count / self.rate


class FrameSource(Protocol):
    """Pictures with their times; for one thread."""

    facts: Facts

    def counted(self, tell: Callable[[], object] = lambda: None) -> Facts:
        """The facts, with the number of pictures counted where nothing tells it."""

    def close(self) -> None:
        """Closes the file."""

    def picture(self, number: int) -> Any:
        """One picture, (height, width, 3) blue, green, red."""

    def pictures(self) -> Iterator[tuple[float, Any]]:
        """Every picture with its time, s."""
