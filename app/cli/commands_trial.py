"""`trial`."""

from argparse import ArgumentParser, Namespace
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from app.cli.common.argument_types import number, pixel, whole
from app.cli.common.command import set_command
from app.cli.common.output import end_on_signals, note, show
from app.common.json import Json
from app.export.trajectory_files import read_text
from app.trials.figures import (
    PACE,
    mean_content,
    movement_content,
    pace_content,
    part_content,
    step_content,
)
from core.errors import InputError
from core.trials.iterations import (
    FoundIterations,
    IterationMovement,
    find_iterations,
    iteration_movements,
    standing_slip,
)
from core.trials.movement import Movement, foot_movements, mean_movement, spread
from core.vision.frame_times import FrameTimes, read_frame_times
from core.vision.track import FootTrack
from core.vision.track_csv import FRAME_RATE, PixelScale, read_track_csv

_COLUMNS = {
    "plus_x": "+x",
    "minus_x": "−x",
    "dx": "dx",
    "plus_y": "+y",
    "minus_y": "−y",
    "dy": "dy",
    "net_distance": "net",
    "net_angle_deg": "angle",
    "net_error_percent": "error %",
    "distance": "published",
    "angle_deg": "angle",
    "error_percent": "error %",
    "extent_distance": "extent",
}
"""Columns of the table in order: places, the net figures, and those of the published tables."""


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
    text = "find the ends of so many iterations, and print each; without it `steps` is empty"
    add("--iterations", type=whole(1, 50), default=None, metavar="N", help=text)
    rate = number(0.1, 1000.0, "Hz")
    add("--frame-rate", type=rate, default=None, metavar="HZ", help="frames a second (13)")
    text = "times of the frames in s, one a line or a column “time”; once for each file, in their order"
    add("--frame-times", type=Path, action="append", default=[], metavar="FILE", help=text)
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
    if options.setup is None and options.frame_rate is None and not options.frame_times:
        note(
            f"The files have no times; they are taken to hold {FRAME_RATE:g} frames a second (--frame-rate, "
            "--frame-times)."
        )
    content = trials_content(trials)
    lines = [
        line for trial, file in zip(trials, content["files"], strict=True) for line in _lines(trial, file)
    ]
    if len(trials) > 1:
        overall = mean_movement([trial.mean for trial in trials])
        lines += [f"mean of {len(trials)} files", *_table([("all", overall)]), *_pace_lines(content["mean"])]
    show(options, content, lines)
    return 0


def read_trials(options: Namespace) -> list[Trial]:
    """Every file, and how far its feet went."""
    return [_read(options, path, track) for path, track in _tracks(options)]


def trials_content(trials: list[Trial]) -> Json:
    """Trials as JSON content, cm and degrees."""
    overall, files = [trial.mean for trial in trials], [_content(trial) for trial in trials]
    pace = mean_content([{key: file[key] for key in PACE} for file in files])
    steps = [file["step_mean"] for file in files if file["step_mean"] is not None]
    return {
        "files": files,
        "mean": {
            **movement_content(mean_movement(overall)),
            **(pace or {}),
            "step_mean": mean_content(steps),
        },
        "spread": movement_content(spread(overall)) if len(overall) > 1 else None,
    }


def _tracks(options: Namespace) -> Iterator[tuple[Path, FootTrack]]:
    """Each file's track, at its frames' times where these are given."""
    clocks = [_frame_times(path) for path in options.frame_times]
    if clocks and len(clocks) != len(options.files):
        raise InputError(
            f"{len(clocks)} files of frame times for {len(options.files)} tracks; give --frame-times once "
            "for each, in their order.",
            "--frame-times",
        )
    if clocks and options.frame_rate is not None:
        raise InputError("Give either --frame-rate or --frame-times.", "--frame-times")
    for index, (path, track) in enumerate(_untimed_tracks(options)):
        yield path, clocks[index].timed(track, str(path)) if clocks else track


def _frame_times(path: Path) -> FrameTimes:
    clock = read_frame_times(read_text(path), str(path))
    for sentence in clock.notes:
        note(f"{path}: {sentence}")
    return clock


def _untimed_tracks(options: Namespace) -> Iterator[tuple[Path, FootTrack]]:
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
    content |= pace_content(trial.mean, trial.track.seconds)
    content["feet"] = [movement_content(foot) for foot in trial.feet]
    content["frames"] = trial.track.times.size
    content["filled"] = int(trial.track.filled.sum())
    content["steps"] = [step_content(part) for part in trial.iterations]
    content["step_mean"] = mean_content(content["steps"])
    if trial.found is not None:
        content["iterations"] = [
            part_content(part, end) for part, end in zip(trial.iterations, trial.found.ends, strict=True)
        ]
        content["slip"] = (standing_slip(trial.track, trial.found.steps) * 100.0).tolist()
    return content


def _lines(trial: Trial, content: Json) -> list[str]:
    named = [(f"foot {number}", foot) for number, foot in enumerate(trial.feet, 1)]
    lines = [f"{trial.path} (cm, degrees)", *_table([*named, ("mean", trial.mean)])]
    lines += [f"  iteration {index}: {_step(step)}" for index, step in enumerate(content["steps"], 1)]
    lines += _pace_lines(content)
    if trial.found is not None:
        slip = standing_slip(trial.track, trial.found.steps).max(axis=1) * 100.0
        lines.append("  slip of standing feet, largest: " + ", ".join(f"{value:.2f} cm" for value in slip))
    return lines


def _pace_lines(content: Json) -> list[str]:
    """The mean iteration, and the pace of the whole."""
    mean = content["step_mean"]
    return [*([] if mean is None else [f"  mean iteration: {_step(mean)}"]), f"  whole: {_pace(content)}"]


def _step(step: Mapping[str, float]) -> str:
    return f"{step['distance']:.2f} cm at {step['angle_deg']:.1f}° in {_pace(step)}"


def _pace(content: Mapping[str, float]) -> str:
    speed, lengths = content["speed_mm_s"], content["body_lengths_s"]
    return f"{content['seconds']:.1f} s, {speed:.2f} mm/s, {lengths:.4f} body lengths/s"


def _table(rows: list[tuple[str, Movement]]) -> list[str]:
    lines = ["  " + " ".join([" " * 7, *(f"{column:>9}" for column in _COLUMNS.values())])]
    for name, movement in rows:
        content = movement_content(movement)
        lines.append("  " + " ".join([f"{name:<7}", *(f"{content[key]:9.2f}" for key in _COLUMNS)]))
    return lines
