"""Runs a notebook in this Python, with a data folder of its own, and leaves out what changes each time."""

from __future__ import annotations

import json
import os
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from tests.notebooks.listing import path_of
from tests.support.studio_process import PROJECT

CELL_SECONDS = 600
"""Longest time of one cell: a deadline for loaded machines, which no test waits out."""
METADATA = {
    "kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"},
    "language_info": {"name": "python"},
}
"""All that a kept notebook says of where it was run."""
OWN_FOLDERS = ("XDG_DATA_HOME", "IPYTHONDIR", "JUPYTER_CONFIG_DIR", "TMPDIR")
"""Folders of the environment that are new and empty for each notebook."""
WORK = "work"
"""The empty folder in which a notebook is run."""
FONTS = "building the font cache"
"""What matplotlib remarks once on a computer."""


class NotebookError(Exception):
    """A notebook did not run as it has to."""


@dataclass(frozen=True)
class Executed:
    """A notebook that has been run.

    Args:
        content: the notebook with its outputs, as it is kept.
        seconds: how long it took, its kernel's start and end included.
    """

    content: dict[str, Any]
    seconds: float


def executed(name: str) -> Executed:
    """Runs a notebook of the documentation from its first cell to its last.

    Raises:
        NotebookError: a cell raised, or warned.
    """
    # Loaded here, so that tests that only read notebooks do without.
    import nbformat

    begin = time.monotonic()
    content = run(nbformat.read(path_of(name), as_version=4), name)
    nbformat.validate(content)
    return Executed(content, time.monotonic() - begin)


def run(notebook: Any, name: str) -> Any:
    """Runs a notebook of `nbformat`, and gives it back as it is kept.

    Args:
        notebook: its outputs are replaced.
        name: for messages.

    Raises:
        NotebookError: a cell raised or warned, or an output names the folder in which it was run.
    """
    from jupyter_client.kernelspec import KernelSpecManager
    from jupyter_client.manager import AsyncKernelManager
    from nbclient import NotebookClient
    from nbclient.exceptions import CellExecutionError

    with _folders() as (home, environment):
        # No kernel but that of this Python: others that are installed on the computer are not looked at.
        manager = AsyncKernelManager(
            kernel_name="python3",
            kernel_spec_manager=KernelSpecManager(kernel_dirs=[]),
            transport="ipc",
            connection_file=str(home / "kernel.json"),
        )
        client = NotebookClient(notebook, km=manager, timeout=CELL_SECONDS, record_timing=False)
        try:
            client.execute(cleanup_kc=True, env=environment, cwd=str(home / WORK))
        except CellExecutionError as error:
            raise NotebookError(f"{name}: {error}") from error
        content = _kept(notebook, name)
        if str(home) in json.dumps(content):
            raise NotebookError(f"{name}: an output names the folder in which it was run.")
    return content


def keep(name: str, content: dict[str, Any]) -> None:
    """Writes a notebook to its place."""
    import nbformat

    nbformat.write(content, path_of(name))


@contextmanager
def _folders() -> Iterator[tuple[Path, dict[str, str]]]:
    """A folder to work in, and an environment in which nothing of the user is read or written."""
    with tempfile.TemporaryDirectory(prefix="notebook-") as home:
        folders = {variable: Path(home, variable.lower()) for variable in OWN_FOLDERS}
        for folder in (Path(home, WORK), *folders.values()):
            folder.mkdir()
        places = {variable: str(folder) for variable, folder in folders.items()}
        yield Path(home), {**os.environ, **places, "PYTHONPATH": str(PROJECT)}


def _kept(notebook: Any, name: str) -> Any:
    """The notebook without what changes each time or says where it was run."""
    notebook.metadata = METADATA
    for number, cell in enumerate(notebook.cells, 1):
        cell.metadata = {}
        if cell.cell_type != "code":
            continue
        cell.outputs = _joined_streams(cell.outputs)
        for output in cell.outputs:
            if output.get("name") == "stderr":
                output.text = "".join(f"{line}\n" for line in _remarks(output.text))
                if "Warning" in output.text:
                    raise NotebookError(f"{name}: cell {number} warns: {output.text}")
        cell.outputs = [one for one in cell.outputs if one.get("text") != ""]
    return notebook


def _remarks(text: str) -> list[str]:
    """What is left of standard error without progress bars, which remove themselves."""
    return [line for line in left_on_screen(text).split("\n") if line and FONTS not in line]


def _joined_streams(outputs: list[Any]) -> list[Any]:
    """Outputs with each stream's text as one, where it was written first."""
    first: dict[str, Any] = {}
    kept = []
    for one in outputs:
        if one.output_type == "stream" and one.name in first:
            first[one.name].text += one.text
            continue
        if one.output_type == "stream":
            first[one.name] = one
        kept.append(one)
    return kept


def left_on_screen(text: str) -> str:
    """What a terminal shows of a text in the end: a carriage return begins its line anew."""
    lines = []
    for line in text.split("\n"):
        shown = ""
        for part in line.split("\r"):
            shown = part + shown[len(part) :]
        lines.append(shown.rstrip())
    return "\n".join(lines)
