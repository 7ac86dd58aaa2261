"""Trials of the real robot for scripts: how far its feet went."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from app.cli.commands_trial import read_trials, trials_content
from app.scripting.html import Cell, table
from app.scripting.options import command_options

_COLUMNS = (
    "dx",
    "dy",
    "distance",
    "angle_deg",
    "error_percent",
    "net_distance",
    "net_angle_deg",
    "extent_distance",
)


@dataclass(frozen=True, eq=False, repr=False)
class Trial:
    """How far recorded foot tracks went. `footfall.trial` gives one.

    Args:
        figures: what `footfall trial --json` prints, in cm and degrees as its sources do: `files`, `mean` and
            `spread`.

    Raises:
        FootfallError: never.

    Example:
        >>> import footfall as ff
        >>> ff.trial("track.csv", expect=5.0).mean["distance"]  # doctest: +SKIP
        4.8
    """

    figures: dict[str, Any]

    @property
    def mean(self) -> dict[str, float]:
        """The mean over feet and files: dx, dy and distances in cm, angles in degrees."""
        values: dict[str, float] = self.figures["mean"]
        return values

    def __repr__(self) -> str:
        count, mean = len(self.figures["files"]), self.mean
        files = "one file" if count == 1 else f"{count} files"
        return f"Trial of {files}: {mean['distance']:.2f} cm at {mean['angle_deg']:.1f}°"

    def _repr_html_(self) -> str:
        rows: list[list[Cell]] = [
            [Path(one["file"]).name, *(one[key] for key in _COLUMNS)] for one in self.figures["files"]
        ]
        rows.append(["mean", *(self.mean[key] for key in _COLUMNS)])
        return table(["file, cm and degrees", *_COLUMNS], rows)


def trial(*files: str | Path, expect: float, **options: Any) -> Trial:
    """Movement tables of recorded foot tracks, defined as in the published ones.

    Args:
        files: track files (CSV), or videos with the option setup.
        expect: the whole wanted way, cm.
        options: those of `footfall trial`: iterations, frame_rate (Hz), pixels_per_cm and others.

    Returns:
        The movements, in cm and degrees.

    Raises:
        InputError: a file cannot be read, or an option does not fit.

    Example:
        >>> import footfall as ff
        >>> ff.trial("track_1.csv", "track_2.csv", expect=5.0)  # doctest: +SKIP
        Trial of 2 files: 4.81 cm at -3.2°
    """
    asked = command_options("trial", [str(file) for file in files], expect=expect, **options)
    return Trial(trials_content(read_trials(asked)))
