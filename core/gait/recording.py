"""A recorded motion as a gait document keeps it: its file's own text, and what reading it assumed."""

import hashlib
from dataclasses import dataclass
from enum import StrEnum

from core.errors import InputError

MOST_FILE_NAME = 200
"""Characters that the name of a recorded motion's file may have."""
MOST_ASSUMPTIONS, MOST_ASSUMPTION = 20, 500
"""How many assumptions a recording may name, and the characters of each."""


class RecordingForm(StrEnum):
    """What kind of file the motion came from."""

    TRAJECTORY = "trajectory"
    """A trajectory CSV in the lab's layout, with its companion where it had one."""
    WAYPOINTS = "waypoints"
    """A waypoint CSV; the body's motion is made from the strokes."""


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
    """

    file: str
    form: RecordingForm
    text: str
    companion: str | None = None
    assumed: tuple[str, ...] = ()

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
