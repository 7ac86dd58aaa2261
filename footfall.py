"""Footfall Studio in Python: from a gait's name to measured strokes.

    import footfall as ff

    plan = ff.optimise("walk", step=0.010, margin=0.006)
    print(plan.status, ff.check(plan).passed)
    run = ff.send(plan, to="emulator", by="Ada")
    print(run.measured.shape)

Functions are called like the commands of `footfall` on the command line, and take the same options in SI
(m, s, rad). Every refusal is a `FootfallError` with a sentence that says what is wrong and what to do. In a
notebook, values show themselves as pictures and tables.

The program's packages are loaded as parts of this module, such as `footfall.core`, so that they get along
with a `core.py` or an `app.py` of your own. The command goes the same way, also as `python -m footfall`.
"""

import builtins
import importlib
import os
import sys
from collections.abc import Mapping, Sequence
from importlib.machinery import ModuleSpec, PathFinder, SourceFileLoader
from types import ModuleType
from typing import Any

_NAME = "footfall"
_PACKAGES = frozenset({"app", "core", "robot_description", "solver_jobs"})
_FOLDER = os.path.dirname(os.path.realpath(__file__))
_INSTALLED = os.path.join(_FOLDER, "footfall_studio")
_HOME = _INSTALLED if os.path.isdir(_INSTALLED) else _FOLDER
"""Where the packages stand: in a folder of our own if installed, beside this file in a checkout."""
__path__: list[str] = []
"""Makes them parts of this module, and nothing else that stands there."""


def _import(
    name: str,
    scope: Mapping[str, object] | None = None,
    local: Mapping[str, object] | None = None,
    fromlist: Sequence[str] | None = (),
    level: int = 0,
) -> ModuleType:
    """What `import` means in the program's own files: its packages are parts of this module."""
    top = name.partition(".")[0]
    if level or top not in _PACKAGES:
        return builtins.__import__(name, scope, local, fromlist or (), level)
    found = builtins.__import__(f"{_NAME}.{name}", scope, local, fromlist or (), 0)
    return found if fromlist else sys.modules[f"{_NAME}.{top}"]


_BUILTINS = {**vars(builtins), "__import__": _import}


class _Loader(SourceFileLoader):
    """Loads a file of the program with an `import` of its own."""

    def exec_module(self, module: ModuleType) -> None:
        """Runs the file."""
        vars(module)["__builtins__"] = _BUILTINS
        super().exec_module(module)


class _FootfallFinder:
    """Finds the program's packages under this module's name."""

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        """A file of the program; nothing else is a part of this module."""
        top, _, rest = fullname.partition(".")
        if top != _NAME or rest.partition(".")[0] not in _PACKAGES:
            return None
        spec = PathFinder.find_spec(fullname, [_HOME] if "." not in rest else path, target)
        if spec is not None and type(spec.loader) is SourceFileLoader:
            spec.loader = _Loader(spec.loader.name, spec.loader.path)
        return spec


if __name__ == _NAME and not any(
    type(finder).__name__ == _FootfallFinder.__name__ for finder in sys.meta_path
):
    sys.meta_path.insert(0, _FootfallFinder())

_HOMES = {
    "gaits": ("Gait", "gait", "gaits", "sequence"),
    "plans": ("Plan",),
    "planning": ("fastest", "frontier", "optimise", "plan"),
    "patterns": ("Pattern", "pattern", "transition"),
    "remedies": ("Remedies", "Remedy", "remedies"),
    "segments": ("Segments", "segments"),
    "verdicts": ("Verdict", "check"),
    "physics": ("Simulation", "simulate"),
    "published": ("Published", "published"),
    "sending": ("Run", "send"),
    "robots": ("Robot", "robot", "robots"),
    "trials": ("Trial", "trial"),
    "atlases": ("Atlas", "atlas"),
    "studio": ("show",),
    "errors": (
        "CheckError",
        "FootfallError",
        "InfeasibleError",
        "InputError",
        "RobotError",
        "StateError",
        "StorageError",
    ),
}
"""The files of `app/scripting`, and what each has for scripts."""
_HOME_OF = {name: home for home, names in _HOMES.items() for name in names}

__all__ = sorted(_HOME_OF)


def main() -> int:
    """Runs the command whose arguments the process has, and returns its exit status."""
    status: int = importlib.import_module(f"{_NAME}.app.cli").main()
    return status


def __getattr__(name: str) -> Any:
    """A function or a class, whose file is loaded when it is first asked for."""
    if name == "__version__":
        return importlib.import_module(f"{_NAME}.app.common.version").VERSION
    home = _HOME_OF.get(name)
    if home is None:
        raise AttributeError(f"module {_NAME!r} has no attribute {name!r}")
    value = getattr(importlib.import_module(f"{_NAME}.app.scripting.{home}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return [*__all__, "__version__"]


if __name__ == "__main__":
    sys.exit(importlib.import_module(_NAME).main())
