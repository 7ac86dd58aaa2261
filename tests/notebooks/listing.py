"""Which notebooks there are, and what is read of a kept one."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from tests.support.studio_process import PROJECT

FOLDER = PROJECT / "docs" / "notebooks"
NAMES = tuple(sorted(path.stem for path in FOLDER.glob("*.ipynb")))
"""Files in the folder, without the suffix, in the order in which they are read."""


@dataclass(frozen=True)
class Cell:
    """A cell of a kept notebook.

    Args:
        id: which stays when cells are moved.
        is_code: false for prose.
        source: its text.
        number: of its execution; None where it was not run.
        outputs: as the file has them.
        metadata: as the file has it.
    """

    id: str
    is_code: bool
    source: str
    number: int | None
    outputs: tuple[dict[str, Any], ...]
    metadata: dict[str, Any]

    @property
    def kinds(self) -> list[str]:
        """Kind of each output: `stream stdout`, or the forms in which a value shows itself."""
        return [kind_of(one) for one in self.outputs]

    @property
    def shown(self) -> str:
        """All text of its outputs."""
        texts = (one.get("data", {}) | {"text": one.get("text", "")} for one in self.outputs)
        return "\n".join(_joined(part) for one in texts for form, part in one.items() if "text" in form)


def kind_of(output: dict[str, Any]) -> str:
    """Kind of an output."""
    name = str(output["output_type"])
    if name == "stream":
        return f"stream {output['name']}"
    # A value that is displayed and the value of the last line look the same to the reader.
    return " ".join(sorted(output["data"])) if "data" in output else name


def _joined(text: str | list[str]) -> str:
    return text if isinstance(text, str) else "".join(text)


def path_of(name: str) -> Path:
    """Where a notebook is kept."""
    return FOLDER / f"{name}.ipynb"


def kept_content(name: str) -> dict[str, Any]:
    """A notebook as its file has it."""
    content: dict[str, Any] = json.loads(path_of(name).read_text(encoding="utf-8"))
    return content


def cells_of(content: dict[str, Any]) -> list[Cell]:
    """The cells of a notebook."""
    return [
        Cell(
            str(one["id"]),
            one["cell_type"] == "code",
            _joined(one["source"]),
            one.get("execution_count"),
            tuple(one.get("outputs", ())),
            one["metadata"],
        )
        for one in content["cells"]
    ]
