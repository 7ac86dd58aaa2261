"""A recorded motion as a gait document keeps it: its file's own text, and what reading it assumed."""

import hashlib
from dataclasses import dataclass
from enum import StrEnum

from core.errors import InputError

MOST_FILE_NAME = 200
"""Characters that the name of a recorded motion's file may have."""
MOST_ASSUMPTIONS, MOST_ASSUMPTION = 20, 500
"""How many assumptions a recording may name, and the characters of each."""
MOST_RAISED = 0.05
"""A recorded motion's body and feet are raised or lowered by no more, m."""
LEAST_SCALE, MOST_SCALE = 0.1, 2.0
"""Bounds of a recorded motion's scale."""


class RecordingForm(StrEnum):
    """What kind of file the motion came from."""

    TRAJECTORY = "trajectory"
    """A trajectory CSV in the lab's layout, with its companion where it had one."""
    WAYPOINTS = "waypoints"
    """A waypoint CSV; the body's motion is made from the strokes."""


class WithinStroke(StrEnum):
    """What becomes of strokes beyond the motors' range."""

    CLIP = "clip"
    """Each goes to the end of the range, as the lab's own program did."""


@dataclass(frozen=True)
class RecordingFit:
    """How a recorded motion is changed to fit the robot, while its file stays as it is.

    Args:
        body: added to the body's heights, m.
        feet: added to the heights of the feet, m.
        scale: of the way of body and feet from the first sample on.
        within_stroke: what becomes of strokes beyond the range; None where the motion is refused then.
    """

    body: float = 0.0
    feet: float = 0.0
    scale: float = 1.0
    within_stroke: WithinStroke | None = None

    def __post_init__(self) -> None:
        for name, value in (("body", self.body), ("feet", self.feet)):
            if not abs(value) <= MOST_RAISED:
                raise InputError(
                    f"The recorded motion's {name} would be raised by {value * 1000:g} mm; at most "
                    f"±{MOST_RAISED * 1000:g} mm can be chosen.",
                    f"recorded.fit.{name}",
                )
        if not LEAST_SCALE <= self.scale <= MOST_SCALE:
            raise InputError(
                f"The recorded motion would be scaled by {self.scale:g}; it must lie in {LEAST_SCALE:g} to "
                f"{MOST_SCALE:g}.",
                "recorded.fit.scale",
            )


AS_RECORDED = RecordingFit()


def text_sha256(text: str) -> str:
    """SHA-256 of a text in UTF-8, hexadecimal."""
    return hashlib.sha256(text.encode()).hexdigest()


@dataclass(frozen=True)
class Recording:
    """A motion's file, kept to the last character.

    Args:
        file: its name.
        form: of which kind it is.
        text: what stands in it.
        companion: text of the trajectory's companion; None where it came without one.
        assumed: sentences on what reading it assumed.
        fit: how the motion in it is changed to fit the robot.
    """

    file: str
    form: RecordingForm
    text: str
    companion: str | None = None
    assumed: tuple[str, ...] = ()
    fit: RecordingFit = AS_RECORDED

    def __post_init__(self) -> None:
        if not 1 <= len(self.file) <= MOST_FILE_NAME:
            raise InputError(
                f"The recorded motion's file name has {len(self.file)} characters; it must have 1 to "
                f"{MOST_FILE_NAME}.",
                "recorded.file",
            )
        if len(self.assumed) > MOST_ASSUMPTIONS or any(len(s) > MOST_ASSUMPTION for s in self.assumed):
            raise InputError(
                f"The recorded motion names more than {MOST_ASSUMPTIONS} assumptions, or one longer than "
                f"{MOST_ASSUMPTION} characters. Import the file again.",
                "recorded.assumed",
            )
        if self.companion is not None and self.form is not RecordingForm.TRAJECTORY:
            raise InputError("Only a trajectory has a companion; leave it out.", "recorded.companion")
        for name, text in (("file", self.file), ("text", self.text), ("companion", self.companion or "")):
            _require_encodable(name, text)

    @property
    def sha256(self) -> str:
        """SHA-256 of the file's text, hexadecimal."""
        return text_sha256(self.text)

    @property
    def companion_sha256(self) -> str | None:
        """SHA-256 of the companion's text, hexadecimal; None where there is none."""
        return None if self.companion is None else text_sha256(self.companion)


def _require_encodable(name: str, text: str) -> None:
    try:
        text.encode()
    except UnicodeEncodeError as error:
        raise InputError(
            f"The recorded motion's {name} holds half a character at {error.start}. Import the file again.",
            f"recorded.{name}",
        ) from error
