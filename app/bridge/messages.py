"""The sentences of the bridge's states."""

import re
from itertools import zip_longest

from app.bridge.states import RobotState
from core.wire.lines import LONGEST_LINE, Line
from core.wire.messages import THRESHOLD_MM, name_motor

NOTICED_MM = 0.9 * THRESHOLD_MM
"""A motor that is nearer to its target is sure not to be moved by the robot."""

SENTENCES: dict[RobotState, str] = {
    RobotState.UNKNOWN: "What the robot does is not known.",
    RobotState.DISARMED: "The robot answers and stands still. Arm it to let it move.",
    RobotState.ARMED: "The robot is armed: sending a plan moves it.",
    RobotState.MOVING: "The robot is moving.",
    RobotState.PAUSING: "The robot goes on to the next pose with all feet down and pauses there.",
    RobotState.PAUSED: "The robot stands with all feet down. Resume goes on.",
    RobotState.STOPPING: "Stop was sent. It takes effect when the running ramp is over.",
    RobotState.STOPPED: "Stopped. Nothing moves until you clear and arm.",
    RobotState.DONE: "The plan is done. Arm the robot for another run.",
    RobotState.FAULT: "The robot stands still after a fault. Clear it, then arm the robot again.",
}

SHOWN_AROUND = 12
"""Characters that are shown on each side of a difference."""

CITED = 40
"""Characters of a line that are shown."""

NOT_CONNECTED = "No robot is connected."
CONNECTING = (
    "Waiting for the robot. Its board may restart when it is connected, or carry out a message that was cut "
    "off; its motors may then move for about 8 s."
)
RESTARTED = "The robot restarted by itself and moves its motors to 0.5 mm."
NOT_STOPPED = "NOT STOPPED: the robot has not confirmed the stop. Use the power switch."
NOT_SENT = "NOT STOPPED: the line did not take the stop. Use the power switch."


OVERLONG = (
    f"The robot sent a line of more than {LONGEST_LINE} bytes. It was cut there, and its rest is left out. "
    "Look at the robot's cable and at the program on its board."
)
FLOODED = (
    "The robot sends faster than the program can read: what found no room was left out. Look at the robot's "
    "cable and at the program on its board."
)


def clearing_sentence(
    measured_mm: tuple[float, ...], target_mm: tuple[float, ...], *, confirmed: bool
) -> str:
    """Says what a clear does: nothing, unless a motor stands too far outside the range that may be sent."""
    moves = [
        f"{name_motor(i)} moves {abs(t - m):.2f} mm to {t:.2f} mm, the end of its range"
        for i, (m, t) in enumerate(zip(measured_mm, target_mm, strict=True))
        if abs(t - m) > NOTICED_MM
    ]
    doubt = "" if confirmed else "The robot has not confirmed the stop. "
    return f"{doubt}Clearing the stop; {'; '.join(moves) or 'no motor moves'}."


def without_remedy(sentence: str) -> str:
    """What happened, without what was to be done about it: for when that has been done."""
    happened, _, _ = sentence.partition(". ")
    return f"{happened.removesuffix('.')}."


def misread_sentence(sent: str, read: str) -> str:
    """Says where the robot's echo first differs from what was sent, with some characters around."""
    pairs = zip_longest(sent, read)
    place = next((index for index, (ours, theirs) in enumerate(pairs) if ours != theirs), len(sent))
    return (
        f"The robot read another text than was sent, from character {place + 1} on: it read "
        f"{_around(read, place)} where {_around(sent, place)} was sent."
    )


def cited(text: str) -> str:
    """The beginning of what the robot said, in quotes."""
    return _around(text, 0, CITED)


def _around(text: str, place: int, around: int = SHOWN_AROUND) -> str:
    """A text near a place, in quotes; what cannot be printed stands as its code."""
    begin, end = max(place - around, 0), place + around + 1
    shown = "".join(c if c.isprintable() else f"\\x{ord(c):02x}" for c in text[begin:end])
    quoted = f"“{'…' if begin else ''}{shown}{'…' if end < len(text) else ''}”"
    return quoted if place < len(text) else f"nothing more after {quoted}"


def words_of(line: Line | None) -> str:
    """A line's kind in words, for people: `ErrorScan` becomes “error scan”."""
    if line is None:
        return "nothing"
    return re.sub(r"(?<!^)(?=[A-Z])", " ", type(line).__name__).lower()


def away_sentence(seconds: float) -> str:
    """Says that the program itself did not get to run."""
    return f"The program did not run for {seconds:.1f} s."


def silent_sentence(silence: float, limit: float, place: str) -> str:
    """Says that an answering robot fell silent."""
    return (
        f"The robot has been silent for {silence:.1f} s {place} (limit {limit:.1f} s): its board restarted "
        "or hangs, or power or cable failed. If it moves, use its power switch; then connect again."
    ).replace("  ", " ")


def unread_sentence(unread: float, limit: float, said: str, place: str) -> str:
    """Says that a robot talks but gives no strokes that can be read."""
    last = f"its telemetry was {cited(said)}" if said else "no telemetry came"
    return (
        f"The robot talks, but for {unread:.1f} s {place} it gave no strokes that can be read "
        f"(limit {limit:.1f} s): {last}. Look at its cable and at the program on its board before you clear."
    ).replace("  ", " ")


def stranger_sentence(device: str | None, limit: float, *, talks: bool) -> str:
    """Says that nothing like the robot is on the line: something else, or nothing at all."""
    if talks:
        return (
            f"Something on {device} sends, but no line answered like the robot within {limit:.0f} s: "
            "it is another device. Choose the robot's, then connect again."
        )
    return (
        f"Nothing on {device} answered like the robot within {limit:.0f} s; not a byte came. "
        "Check power and cable or choose another device, then connect again."
    )


def restless_sentence(device: str | None, limit: float) -> str:
    """Says that the robot talks but does not come to rest."""
    return (
        f"The robot on {device} answers but did not come to rest within {limit:.0f} s. "
        "If it moves, use its power switch; then connect again."
    )


def displaced_sentence(distance_mm: float, limit_mm: float) -> str:
    """Says that a paused robot was moved."""
    return (
        f"A motor stands {distance_mm:.2f} mm from where the run paused (limit {limit_mm:.2f} mm). "
        "Stop, clear, and send the plan anew."
    )
