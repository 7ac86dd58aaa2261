"""Gaits for scripts: from the library, the data folder or a file, changed by options, and written."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from difflib import get_close_matches
from pathlib import Path
from typing import Any

import numpy as np

from app.cli.commands_files import imported_gait, stored_gait
from app.cli.gait_options import gait_with_options
from app.documents.gait_json import gait_content
from app.export.formats import ExportFormat, export
from app.export.gait_diagram import gait_diagram
from app.export.source import Exportable
from app.export.svg import svg
from app.scripting.html import table
from app.scripting.options import command_options
from app.store.gait_files import GaitFiles, default_data_folder
from app.store.named_file import file_path, write_named
from core.arrays import Bools, Floats
from core.errors import InputError, NotFoundError
from core.gait.gait import Gait as Document
from core.gait.gait import SequencePart
from core.gait.motion_source import motion_source
from core.library.library import library
from core.library.robot_times import library_times
from core.library.sequence import sequence_gait
from core.robot.model import load_robot

_FORMS = {".json": ExportFormat.JSON, ".svg": ExportFormat.SVG, ".png": ExportFormat.PNG}
_PHASES = ".phases.json"
_FILES = (".csv", ".npz", ".json")


@dataclass(frozen=True, repr=False)
class Gait:
    """A gait as a document: footfalls, step and limits, from which a plan is made. `footfall.gait` gives one.

    Args:
        document: all that the gait asks for.
        id: of the library or the data folder; None for one that was read from a file or changed.

    Raises:
        InputError: by its methods, where what is asked does not fit together.

    Example:
        >>> import footfall as ff
        >>> walk = ff.gait("walk")
        >>> walk.order, walk.stance.shape, walk.step.round(4).tolist()
        ((3, 2, 4, 1), (4, 45), [0.0071, 0.0071, 0.0])
    """

    document: Document
    id: str | None = None

    @property
    def name(self) -> str:
        """What a person calls it."""
        return self.document.name

    @property
    def robot(self) -> str:
        """Name of its robot."""
        return self.document.robot

    @property
    def order(self) -> tuple[int, ...]:
        """Feet in the order of their swings, from 1."""
        return self.document.order

    @property
    def step(self) -> Floats:
        """(3,) travel x, y and turn of an iteration at direction 1, m, m and rad."""
        return np.array(self.document.step)

    @property
    def stance(self) -> Bools:
        """(legs, samples) which feet stand; false in a swing."""
        return self.document.timeline.stance

    @property
    def sample_time(self) -> float:
        """Time between two samples, s."""
        return self.document.timeline.sample_time

    @property
    def content(self) -> dict[str, Any]:
        """The document as JSON content, in SI."""
        content: dict[str, Any] = gait_content(self.document)
        return content

    def changed(self, *, name: str | None = None, **options: Any) -> Gait:
        """The gait with other options; it stays as it is itself.

        Args:
            name: what the new one is called.
            options: those of `footfall optimise`, in SI: step, margin, clearance, iterations and others.

        Returns:
            Another gait, without an id.

        Raises:
            InputError: there is no such option, or its value does not fit.

        Example:
            >>> import footfall as ff
            >>> ff.gait("walk").changed(step=0.012, iterations=2).stance.shape
            (4, 85)
        """
        words = command_options("optimise", [self.id or ""], ("method", "remedy"), **options)
        # A recorded motion is what the gait has, not what is asked.
        asked = gait_with_options(replace(self.document, recorded=None), words)
        return Gait(asked if name is None else replace(asked, name=name))

    def save(self, path: str | Path) -> Path:
        """Writes the document, its phases, or a picture of its footfalls.

        Args:
            path: `X.json` for the document, `X.phases.json` for contact and phase durations of each foot,
                `.svg` or `.png` for a picture; SI units.

        Returns:
            The path.

        Raises:
            InputError: the suffix is another one, or the file cannot be written.

        Example:
            >>> import footfall as ff, tempfile
            >>> ff.gait("walk").save(f"{tempfile.mkdtemp()}/walk.json").name
            'walk.json'
        """
        file = file_path(path)
        form = ExportFormat.PHASES if file.name.endswith(_PHASES) else _FORMS.get(file.suffix)
        if form is None:
            known = ", ".join((*_FORMS, _PHASES))
            raise InputError(
                f"{file.name}: a gait is written as {known}. Its motion is written by its plan: "
                "footfall.plan(gait).save(…).",
                "path",
            )
        no_motion = InputError("This form needs no motion.", "plan")
        write_named(file, export(Exportable(file.stem, self.document, no_motion), form).content)
        return file

    def __repr__(self) -> str:
        dx, dy, turn = self.document.step
        angle = f", {np.degrees(turn):.1f}°" if turn else ""
        feet = "-".join(map(str, self.order))
        return f"Gait “{self.name}”: {self.robot}, feet {feet}, {np.hypot(dx, dy) * 1000:.1f} mm{angle}"

    def _repr_html_(self) -> str:
        return svg(gait_diagram(self.document, load_robot(self.robot)))


class Gaits(tuple[Gait, ...]):
    """Several gaits, which a notebook shows as a table."""

    def _repr_html_(self) -> str:
        times = library_times()
        rows = []
        for one in self:
            known = times.get(one.id or "")
            speed = None if known is None or known.speed is None else known.speed * 1000
            kind = motion_source(one.document).value
            rows.append([one.id, one.name, one.robot, "-".join(map(str, one.order)), kind, speed])
        return table(["id", "name", "robot", "foot order", "made", "mm/s on the robot"], rows)


def gait(source: str | Path | Gait, **options: Any) -> Gait:
    """A gait of the library, of the data folder or of a file.

    Args:
        source: an id that `footfall.gaits()` lists; or a file: a gait (.json), a trajectory or waypoints
            (.csv), a motion (.npz) or a phase list (.json); or a gait.
        options: those of `footfall optimise`, in SI, to change it (see `Gait.changed`).

    Returns:
        The gait.

    Raises:
        InputError: there is no such gait, the file cannot be read, or an option does not fit.

    Example:
        >>> import footfall as ff
        >>> ff.gait("amble", step=0.012)
        Gait “Amble 10 mm”: deltawalker, feet 3-1-4-2, 12.0 mm
    """
    if not isinstance(source, str | Path | Gait):
        raise InputError("A gait is named by its id, by a file, or is a gait itself.", "source")
    found = source if isinstance(source, Gait) else _read(source)
    return found.changed(**options) if options else found


def _read(source: str | Path) -> Gait:
    if Path(source).suffix in _FILES:
        return Gait(imported_gait(command_options("import", [str(source)])).gait)
    try:
        gait_id, document = stored_gait(str(source), None)
    except InputError as error:
        folder = default_data_folder()
        known = [*library(), *(GaitFiles(folder).ids() if folder.exists() else ())]
        near = get_close_matches(str(source), known, 3, 0.5)
        if not near:
            raise
        raise NotFoundError(
            f"There is no gait “{source}”. Did you mean {' or '.join(f'“{one}”' for one in near)}?", "gait"
        ) from error
    return Gait(document, gait_id)


def gaits() -> Gaits:
    """The gaits that come with the program, and those that were saved in the data folder.

    Returns:
        A tuple of gaits; in a notebook a table with their speeds on the robot in mm/s, where known.

    Raises:
        InputError: a saved gait cannot be read.

    Example:
        >>> import footfall as ff
        >>> "fast-c-gait" in [gait.id for gait in ff.gaits()]
        True
    """
    ours = [Gait(entry.gait, entry.id) for entry in library().values()]
    folder = default_data_folder()
    files = GaitFiles(folder) if folder.exists() else None
    saved = [] if files is None else [Gait(files.read(gait_id), gait_id) for gait_id in files.ids()]
    return Gaits([*ours, *saved])


def sequence(*parts: str | Path | Gait | tuple[str | Path | Gait, int], name: str = "Sequence") -> Gait:
    """Gaits one after the other as one gait, with the moves between them.

    Args:
        parts: gaits as for `footfall.gait`, each alone or with how often it runs.
        name: what the sequence is called.

    Returns:
        The sequence; its step is the whole travel, m, and turn, rad.

    Raises:
        InputError: a gait cannot be a part, or robots or sample times differ.
        InfeasibleError: two parts do not fit together.

    Example:
        >>> import footfall as ff
        >>> ff.sequence(("walk", 2), "rotate", name="Walk and turn").step.round(4).tolist()
        [0.0141, 0.0141, 0.2618]
    """
    return Gait(sequence_gait(name, tuple(_parts(parts))))


def _parts(parts: Iterable[str | Path | Gait | tuple[str | Path | Gait, int]]) -> Iterable[SequencePart]:
    for part in parts:
        source, times = part if isinstance(part, tuple) else (part, 1)
        found = gait(source)
        own = found.document.sequence or (SequencePart(found.document, 1, found.id),)
        yield from own * times if found.document.sequence else (replace(own[0], times=times),)
