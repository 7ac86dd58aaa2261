"""The atlas that comes with the program: `python -m app.atlas.included` makes it anew.

It has the gaits of the group *For this robot*, and some thousands beside them.
"""

import os
import sys
from collections.abc import Mapping
from contextlib import closing
from pathlib import Path
from types import MappingProxyType

from app.atlas.atlas_file import AtlasFile
from app.atlas.run import LocalEngine, run_atlas
from core.atlas.space import AtlasSpace, space_from_table
from core.data.tables import data_table
from core.library.for_robot import ATLAS

INCLUDED: Mapping[str, Path] = MappingProxyType({ATLAS: Path(__file__).with_name(f"{ATLAS}.sqlite")})
"""The file of each atlas that comes with the program, by its name."""
COUNT = 4_000
"""Gaits of it: a file of less than 2 MB."""


def included_or(path: Path) -> Path:
    """The file of an atlas that is given by its path, or of an included one by its name."""
    return path if path.exists() else INCLUDED.get(str(path), path)


def included_space() -> AtlasSpace:
    """What the gaits of the included atlas are drawn from."""
    return space_from_table(data_table("atlas.toml")["small"], "atlas.toml")


def main() -> int:
    """Makes the file anew."""
    (path,) = INCLUDED.values()
    path.unlink(missing_ok=True)
    with closing(AtlasFile(path, included_space())) as atlas:
        run_atlas(atlas, COUNT, LocalEngine(os.cpu_count() or 1))
        sys.stdout.write(f"{path}: {atlas.counts()}\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
