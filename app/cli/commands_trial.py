"""`trial`."""

import math
from argparse import ArgumentParser, Namespace
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from app.cli.common.argument_types import number, pixel, whole
from app.cli.common.command import set_command
from app.cli.common.output import end_on_signals, note, show
from app.common.json import Json
from app.export.trajectory_files import read_text
from app.trials.figures import movement_content, part_content
from core.errors import InputError
from core.trials.iterations import (
    FoundIterations,
    IterationMovement,
    find_iterations,
    iteration_movements,
    standing_slip,
)
from core.trials.movement import Movement, foot_movements, mean_movement, spread
from core.vision.track import FootTrack
from core.vision.track_csv import FRAME_RATE, PixelScale, read_track_csv

_COLUMNS = ("+x", "−x", "dx", "+y", "−y", "dy", "dist", "angle", "% err", "net", "net angle", "extent")


@dataclass(frozen=True)
class Trial:
    """One file and what came of it."""

    path: Path
    track: FootTrack
    feet: tuple[Movement, ...]
    mean: Movement
    found: FoundIterations | None
    iterations: tuple[IterationMovement, ...]


def trial_command(parser: ArgumentParser) -> None:
    """Makes the parser of `trial`."""
    text = "How far recorded foot tracks went, in cm and degrees, beside what was wanted."
    set_command(parser, run_trial, text)
    add = parser.add_argument
    add("files", type=Path, nargs="+", metavar="TRACK.csv|VIDEO", help="X_D1, Y_D1, …, a row a frame")
    text = "the files are videos: how their camera sees the platform, as the studio exports it"
    add("--setup", type=Path, default=None, metavar="SETUP.json", help=text)
    length = number(0.01, 1000.0, "cm")
    add("--expect", type=length, required=True, metavar="CM", help="the whole wanted way")
    text = "find the ends of so many iterations, and print each"
    add("--iterations", type=whole(1, 50), default=None, metavar="N", help=text)
    rate = number(0.1, 1000.0, "Hz")
    add("--frame-rate", type=rate, default=None, metavar="HZ", help="frames a second (13)")
    text = "the files are in pixels, y downwards, 0,0 a gap: how many are a centimetre"
    add("--pixels-per-cm", type=number(0.1, 10_000.0, "px"), default=None, help=text)
    text = "pixel of the platform's centre"
    add("--origin", type=pixel, default=None, metavar="X,Y", help=text)


def run_trial(options: Namespace) -> int:
    """Movement tables of recorded foot tracks."""
    end_on_signals()
    trials = read_trials(options)
    for trial in trials:
        if trial.track.gaps:
            note(f"{trial.path}: {_gap_words(trial.track)}")
        if trial.found is not None and not trial.found.is_clear:
            note(f"{trial.path}: the feet's steps overlap between iterations, so their ends are unsure.")
    if options.setup is None and options.frame_rate is None and options.iterations is not None:
        note(
            f"The files have no times; they are taken to hold {FRAME_RATE:g} frames a second (--frame-rate)."
        )
    overall, content = [trial.mean for trial in trials], trials_content(trials)
    lines = [line for trial in trials for line in _lines(trial)]
    if len(trials) > 1:
        lines += [f"mean of {len(trials)} files", *_table([("all", mean_movement(overall))])]
    show(options, content, lines)
    return 0


def read_trials(options: Namespace) -> list[Trial]:
    """Every file, and how far its feet went."""
    return [_read(options, path, track) for path, track in _tracks(options)]


def trials_content(trials: list[Trial]) -> Json:
    """Trials as JSON content, cm and degrees."""
    overall = [trial.mean for trial in trials]
    return {
        "files": [_content(trial) for trial in trials],
        "mean": movement_content(mean_movement(overall)),
        "spread": movement_content(spread(overall)) if len(overall) > 1 else None,
    }


def _tracks(options: Namespace) -> Iterator[tuple[Path, FootTrack]]:
    if options.setup is None:
        rate = FRAME_RATE if options.frame_rate is None else options.frame_rate
        for path in options.files:
            read = read_track_csv(read_text(path), str(path), frame_rate=rate, pixels=_pixels(options))
            for sentence in read.notes:
                note(f"{path}: {sentence}")
            yield path, read.track
        return
    # What reads videos takes a moment to load; track files do without it.
    from app.cli.track_video import read_setup, tracked

    for word in ("frame_rate", "pixels_per_cm", "origin"):
        if getattr(options, word) is not None:
            name = "--" + word.replace("_", "-")
            raise InputError(
                f"{name} is for track files; a video has its own rate, a setup its own scale.", name
            )
    setup = read_setup(options.setup)
    for path in options.files:
        yield path, tracked(path, setup)


def _read(options: Namespace, path: Path, track: FootTrack) -> Trial:
    expected = options.expect / 100.0
    feet = foot_movements(track, expected)
    if options.iterations is None:
        return Trial(path, track, feet, mean_movement(feet), None, ())
    found = find_iterations(track, options.iterations)
    parts = iteration_movements(track, found.ends, expected / options.iterations)
    return Trial(path, track, feet, mean_movement(feet), found, parts)


def _pixels(options: Namespace) -> PixelScale | None:
    if options.pixels_per_cm is None and options.origin is None:
        return None
    if options.pixels_per_cm is None or options.origin is None:
        raise InputError("Pixels need both --pixels-per-cm and --origin.", "--pixels-per-cm")
    return PixelScale(0.01 / options.pixels_per_cm, options.origin)


def _gap_words(track: FootTrack) -> str:
    frames = int(track.filled.sum())
    longest = max(last - first + 1 for _, first, last in track.gaps)
    return (
        f"{frames} foot positions were not seen and are filled by straight lines "
        f"({len(track.gaps)} gaps, the longest {longest} frames)."
    )


def _content(trial: Trial) -> Json:
    content: Json = {"file": str(trial.path), **movement_content(trial.mean)}
    content["feet"] = [movement_content(foot) for foot in trial.feet]
    content["frames"] = trial.track.times.size
    content["filled"] = int(trial.track.filled.sum())
    if trial.found is not None:
        content["iterations"] = [
            part_content(part, end) for part, end in zip(trial.iterations, trial.found.ends, strict=True)
        ]
        content["slip"] = (standing_slip(trial.track, trial.found.steps) * 100.0).tolist()
    return content


def _lines(trial: Trial) -> list[str]:
    named = [(f"foot {number}", foot) for number, foot in enumerate(trial.feet, 1)]
    lines = [f"{trial.path} (cm, degrees)", *_table([*named, ("mean", trial.mean)])]
    for index, part in enumerate(trial.iterations, 1):
        lines.append(
            f"  iteration {index}: {part.mean.net_distance * 100:.2f} cm at "
            f"{math.degrees(part.mean.net_angle):.1f}° in {part.seconds:.1f} s, {part.speed * 1000:.2f} mm/s"
        )
    if trial.found is not None:
        slip = standing_slip(trial.track, trial.found.steps).max(axis=1) * 100.0
        lines.append("  slip of standing feet, largest: " + ", ".join(f"{value:.2f} cm" for value in slip))
    return lines


def _table(rows: list[tuple[str, Movement]]) -> list[str]:
    lines = ["  " + " ".join([" " * 7, *(f"{column:>9}" for column in _COLUMNS)])]
    for name, movement in rows:
        figures = [value for key, value in movement_content(movement).items() if key != "net_error_percent"]
        lines.append("  " + " ".join([f"{name:<7}", *(f"{value:9.2f}" for value in figures)]))
    return lines
