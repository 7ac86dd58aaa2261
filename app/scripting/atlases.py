"""Atlases for scripts: thousands of evaluated gaits, their front, and one of them as a gait."""

from __future__ import annotations

import os
import warnings
from collections.abc import Mapping
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from app.atlas.atlas_file import AtlasFile
from app.atlas.dask_engine import DaskEngine
from app.atlas.entries import entries_with_physics
from app.atlas.export import table_row
from app.atlas.front import atlas_front, front_keys
from app.atlas.included import INCLUDED, included_or
from app.atlas.opening import opened_gait
from app.atlas.physics import run_physics
from app.atlas.physics_choice import physics_choice, physics_rule
from app.atlas.run import Engine, LocalEngine, run_atlas
from app.atlas.stored_values import MOST_GAITS
from app.cli.atlas.commands import atlas_space
from app.cli.atlas.options import MOST_WORKERS
from app.scripting.gaits import Gait
from app.scripting.html import table
from app.scripting.progress import progress_bar
from core.arrays import Floats
from core.atlas.row import RowStatus
from core.atlas.space import AtlasSpace, space_from_table
from core.errors import InputError
from core.text.documents import as_written

_SHOWN = ("id", "speed", "margin", "order", "step_x", "step_y", "turn", "stop_bound")


@dataclass(frozen=True, eq=False, repr=False)
class Atlas:
    """Thousands of evaluated gaits in one file. `footfall.atlas` gives one.

    Args:
        path: the file.
        space: what its gaits are drawn from, as in a space file.
        counts: how many gaits are `solved`, `infeasible` and `failed`.
        hash: SHA-256 over its results.

    Raises:
        InputError: by its methods, where a key or a number is none of the atlas.

    Example:
        >>> import footfall as ff, tempfile
        >>> file = tempfile.mkdtemp() + "/small.sqlite"
        >>> atlas = ff.atlas(file, count=8, space={"vary": {"step_x": [0.010, 0.012]}}, workers=1)
        >>> sum(atlas.counts.values()), atlas.values("speed").shape
        (8, (8,))
    """

    path: Path
    space: Mapping[str, Any]
    counts: Mapping[str, int]
    hash: str

    def values(self, key: str) -> Floats:
        """One figure or parameter of every solved gait, in the order of their numbers.

        Args:
            key: such as `speed` in m/s, `seconds`, `least_margin` in m, or `step_x` in m.

        Returns:
            (solved,) SI; a figure of physics, such as `walked`, is nan for gaits that were not simulated.

        Raises:
            InputError: the atlas has no such number.

        Example:
            >>> import footfall as ff, tempfile
            >>> file = tempfile.mkdtemp() + "/small.sqlite"
            >>> atlas = ff.atlas(file, count=4, space={"vary": {"step_x": [0.010, 0.012]}}, workers=1)
            >>> bool((atlas.values("seconds") > 10.0).all())
            True
        """
        with closing(AtlasFile(self.path)) as file:
            known = front_keys(file)
            if key not in known:
                raise InputError(f"The atlas has no “{key}”; choose among {', '.join(known)}.", "key")
            entries = list(entries_with_physics(file, RowStatus.SOLVED))
        found = (table_row(*entry)[key] for entry in entries)
        return np.array([np.nan if value is None else value for value in found], dtype=np.float64)

    def rows(self, status: str | None = "solved") -> list[dict[str, Any]]:
        """Its gaits as rows of a table, such as `pandas.DataFrame` takes, in the order of their numbers.

        Args:
            status: `solved`, `infeasible` or `failed`; None for all.

        Returns:
            Of each its `id`, `status`, `reason`, figures, parameters and figures of physics, in SI.

        Raises:
            InputError: there is no such status.

        Example:
            >>> import footfall as ff
            >>> ff.atlas("deltawalker-small").rows("failed")[0]["status"]
            'failed'
        """
        known = [one.value for one in RowStatus]
        if status is not None and status not in known:
            raise InputError(f"status is {status!r}; it must be one of {', '.join(known)}.", "status")
        with closing(AtlasFile(self.path)) as file:
            wanted = None if status is None else RowStatus(status)
            return [table_row(*entry) for entry in entries_with_physics(file, wanted)]

    def front(self, x: str = "margin", y: str = "speed") -> list[dict[str, Any]]:
        """Solved gaits that no other one beats in one of two keys without losing in the other.

        Args:
            x: a figure or a parameter.
            y: another one.

        Returns:
            Of each its `id`, figures, parameters and figures of physics in SI (m, s, rad); the best in `y`
            first.

        Raises:
            InputError: the atlas has no such key.

        Example:
            >>> import footfall as ff, tempfile
            >>> file = tempfile.mkdtemp() + "/small.sqlite"
            >>> atlas = ff.atlas(file, count=8, space={"vary": {"step_x": [0.010, 0.012]}}, workers=1)
            >>> best = atlas.front()[0]
            >>> bool(best["speed"] == atlas.values("speed").max())
            True
        """
        with closing(AtlasFile(self.path)) as file:
            return [table_row(*entry) for entry in atlas_front(file, x, y)]

    def open(self, number: int) -> Gait:
        """One of its gaits, solved again, as a gait from the standard stance to rest.

        A step of mid-walk that is too long for the way from and to the stance becomes the fastest one.

        Args:
            number: `id` of the gait.

        Returns:
            The gait; a plan of it has its poses.

        Raises:
            NotFoundError: the atlas has no gait of that number.
            InputError: the answer differs from the atlas, or the robot's parameters have changed.

        Example:
            >>> import footfall as ff, tempfile
            >>> file = tempfile.mkdtemp() + "/small.sqlite"
            >>> atlas = ff.atlas(file, count=4, space={"vary": {"step_x": [0.010, 0.012]}}, workers=1)
            >>> ff.plan(atlas.open(atlas.front()[0]["id"])).status
            'solved'
        """
        with closing(AtlasFile(self.path)) as file:
            opened = opened_gait(file, number)
        if opened.difference is not None or opened.document is None:
            raise InputError(
                f"Gait {number} of {self.path} differs from its row. {opened.difference} Run the atlas again "
                "into another file.",
                "number",
            )
        return Gait(opened.document)

    def __repr__(self) -> str:
        counts = ", ".join(f"{count} {status}" for status, count in self.counts.items())
        return f"<Atlas {self.path.name}: {counts}>"

    def _repr_html_(self) -> str:
        rows = [[one[key] for key in _SHOWN] for one in self.front()]
        solved, every = self.counts["solved"], sum(self.counts.values())
        return table(_SHOWN, rows, f"{solved} of {every} gaits solved; the fastest for each margin")


def atlas(
    path: str | Path,
    *,
    count: int | None = None,
    robot: str | None = None,
    space: str | Path | Mapping[str, Any] | None = None,
    seed: int | None = None,
    workers: int | None = None,
    dask: str | None = None,
    physics: str | int | None = None,
) -> Atlas:
    """Evaluates thousands of gaits and keeps them in a file, or opens such a file.

    Args:
        path: ATLAS.sqlite; made, or gone on with. `deltawalker-small` is the one that comes with the program.
        count: how many gaits it is to have; None to open a file as it is.
        robot: its name; None for that of the space, or the DeltaWalker.
        space: what varies: a TOML file, or its content as a mapping; None for the default space.
        seed: of the draw; None for that of the space.
        workers: processes on this computer; None for one a core.
        dask: `local`, or the address of a Dask scheduler; None for processes of this computer.
        physics: which solved gaits are simulated with variations, in processes of this computer: `front`,
            `all`, or the size of a sample; None for none.

    Returns:
        The atlas. Lengths are in m, angles in rad, times in s.

    Raises:
        InputError: something does not fit, or the file is of another space.
        UserWarning: a sample is larger than the number of solved gaits; all of them are simulated.
        NotFoundError: there is no such file, and `count` is None.
        StateError: a cluster went away; what was computed is kept.

    Example:
        >>> import footfall as ff, tempfile
        >>> file = tempfile.mkdtemp() + "/small.sqlite"
        >>> ff.atlas(file, count=4, space={"vary": {"step_x": [0.010, 0.012]}}, workers=1)
        <Atlas small.sqlite: 4 solved, 0 infeasible, 0 failed>
    """
    _require_whole("count", count, MOST_GAITS)
    _require_whole("workers", workers, MOST_WORKERS)
    where = included_or(Path(path)) if count is None else Path(path)
    rule = None if physics is None else physics_rule(physics, "physics")
    makes_new = count is not None and str(path) in INCLUDED and not where.exists()
    if makes_new or (rule is not None and where in INCLUDED.values()):
        raise InputError(
            f"The atlas {path} comes with the program and stays as it is. Make one of your own: "
            "ff.atlas(FILE.sqlite, count=N).",
            "path",
        )
    wanted = None if count is None else _space(robot, space, seed)
    with closing(AtlasFile(where, wanted, adds=rule is not None)) as file:
        if count is not None:
            _run(file, count, workers, dask)
        if rule is not None:
            _simulate(file, rule, workers)
        counts = {status.value: number for status, number in file.counts().items()}
        return Atlas(where, file.space.content(), counts, file.hash)


def _space(robot: str | None, space: str | Path | Mapping[str, Any] | None, seed: int | None) -> AtlasSpace:
    if not isinstance(space, Mapping):
        return atlas_space(robot, None if space is None else Path(space), seed)
    own = {} if robot is None else {"robot": robot}
    drawn = {} if seed is None else {"seed": seed}
    return space_from_table({**space, **own, **drawn}, "the space")


def _require_whole(name: str, value: int | None, most: int) -> None:
    is_whole = isinstance(value, int) and not isinstance(value, bool)
    if value is not None and not (is_whole and 1 <= value <= most):
        raise InputError(f"{name} is {as_written(value)}; it must be a whole number from 1 to {most}.", name)


def _run(file: AtlasFile, count: int, workers: int | None, dask: str | None) -> None:
    processes = workers or os.cpu_count() or 1
    engine: Engine = LocalEngine(processes) if dask is None else DaskEngine(dask, processes)
    with progress_bar("Atlas") as tell:
        run_atlas(file, count, engine, lambda progress: tell(progress.done / max(progress.count, 1)))


def _simulate(file: AtlasFile, rule: str | int, workers: int | None) -> None:
    choice = physics_choice(file, rule)
    if choice.notice is not None:
        warnings.warn(choice.notice, stacklevel=3)
    with progress_bar("Physics") as tell:
        run_physics(
            file,
            choice,
            workers or os.cpu_count() or 1,
            lambda progress: tell((progress.done + progress.begun) / max(progress.count, 1)),
        )
