"""Printing results, for people or as one JSON object."""

import errno
import json
import os
import signal
import sys
from argparse import Namespace
from collections.abc import Sequence
from pathlib import Path
from types import FrameType
from typing import IO, Any, AnyStr

from app.common.json import finite
from app.common.signals import Interrupted, ending_signals
from app.store.named_file import is_plain, open_file_number
from core.errors import InputError
from core.findings import SendCost, Severity, Verdict
from core.text.printable import printable_line

INFEASIBLE, NOT_FIT = 3, 4
"""Exit status of a command that found no motion or pattern, and of one whose check failed."""
INTERRUPTED = 130
"""Exit status of a command that Ctrl-C, SIGTERM or SIGHUP ended."""
UNWRITABLE = "output"
"""Place of a refusal that standard output takes nothing."""
_NO_READER = (errno.EPIPE, errno.EIO)
"""The pipe's other end is closed; the terminal is closed."""


def end_on_signals() -> None:
    """Makes SIGTERM unwind the command as Ctrl-C does, and SIGHUP too unless `nohup` has it ignored."""
    endings = ending_signals()

    def raise_interrupted(number: int, frame: FrameType | None) -> None:
        del number, frame
        for ending in endings:  # a terminal that is closed sends several
            signal.signal(ending, signal.SIG_IGN)
        raise Interrupted

    for number in endings:
        signal.signal(number, raise_interrupted)


def show(options: Namespace, content: dict[str, Any], lines: Sequence[str]) -> None:
    """Prints content as JSON, or lines for people; beside a file that goes to /dev/stdout, as a note."""
    text = json.dumps(finite(content), allow_nan=False) if options.json else _joined(lines)
    output: Path | None = getattr(options, "output", None)
    is_taken = output is not None and open_file_number(output) == 1
    write(sys.stderr if is_taken else sys.stdout, text + "\n")


def show_file(content: str) -> None:
    """Prints what a file would hold, to the last byte and in UTF-8 unless it goes to a terminal."""
    if sys.stdout.isatty() or not hasattr(sys.stdout, "buffer"):
        write(sys.stdout, content)
    else:
        write(sys.stdout.buffer, content.encode())


def note(*lines: str) -> None:
    """Says something beside the result, on standard error."""
    write(sys.stderr, _joined(lines) + "\n")


def written_lines(output: Path | None, *, has_companion: bool = False) -> list[str]:
    """Says which file was written, if one was.

    Args:
        output: the file.
        has_companion: whether a companion belongs beside it.
    """
    if output is None:
        return []
    if has_companion and not is_plain(output):
        return [f"Wrote {output}. It is no plain file, so that no companion was written."]
    return [f"Wrote {output}."]


def _joined(lines: Sequence[str]) -> str:
    """Lines that stay lines, whatever names they contain."""
    return "\n".join(map(printable_line, lines))


def duration(seconds: float) -> str:
    """A time for people, such as `2 min 5 s`."""
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    if hours:
        return f"{hours} h {minutes} min"
    return f"{minutes} min {rest} s" if minutes else f"{rest} s"


def write(stream: IO[AnyStr], text: AnyStr) -> None:
    """Writes text at once. Where nobody is left to read it, what follows is dropped: a run has to go on.

    Raises:
        InputError: the output goes to a file that does not take it.
    """
    try:
        stream.write(text)
        stream.flush()
    except OSError as error:
        drop(stream)
        if stream is not sys.stderr and error.errno not in _NO_READER:
            raise InputError(
                f"The output cannot be written: {error.strerror}. Make room, or write it elsewhere.",
                UNWRITABLE,
            ) from error


def drop(stream: IO[Any]) -> None:
    """Drops what is still to be written to a stream, and all that follows."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())


def tally(errors: int, warnings: int) -> str:
    """How many findings of each kind, in words."""
    counts = ((errors, "error"), (warnings, "warning"))
    return ", ".join(f"{count} {name}{'' if count == 1 else 's'}" for count, name in counts)


def verdict_lines(verdict: Verdict) -> list[str]:
    """A verdict for people: findings, then margins."""
    errors = sum(f.severity is Severity.ERROR for f in verdict.findings)
    warnings = len(verdict.findings) - errors
    lines = [f"{'Passed' if verdict.passed else 'Not fit'}: {tally(errors, warnings)}."]
    lines += [f"  {f.severity.value}: {f.rule}: {f.sentence}" for f in verdict.findings]
    lines += [f"  margin {m.rule:<12} {_in_unit(m.margin, m.unit)}" for m in verdict.margins]
    lines += [_cost_line(cost) for cost in verdict.costs]
    lines += [f"  {sentence}" for sentence in verdict.notes]
    return lines


def _cost_line(cost: SendCost) -> str:
    bound = "none" if cost.stop_bound is None else f"{cost.stop_bound:g} s"
    chosen = " (chosen)" if cost.is_chosen else ""
    return (
        f"  stop bound {bound}{chosen}: {cost.merged_seconds:.1f} s merged within "
        f"{cost.merge * 1000:g} mm, {cost.every_seconds:.1f} s with one waypoint a sample"
    )


def _in_unit(value: float | None, unit: str) -> str:
    if value is None:
        return "         – (no number)"
    return f"{value * 1000:10.3f} mm{unit[1:]}" if unit.startswith("m") else f"{value:10.3f} {unit}"
