"""Runs the notebooks of docs/notebooks and keeps their outputs: `python -m tests.notebooks [NAME ...]`.

Without a name all of them. A name is that of a file without its suffix, such as `01_first_gait`. Change the
cells in the file, in JupyterLab or by hand, run this, and read the notebook before it is committed. Each is
run by this Python in an empty folder, with a data folder of its own.
"""

from __future__ import annotations

import sys

from tests.notebooks.listing import NAMES, path_of
from tests.notebooks.running import NotebookError, executed, keep
from tests.support.process_defaults import restore_defaults


def main(names: list[str]) -> int:
    """Runs the named notebooks, or all, and says how long each took."""
    unknown = sorted(set(names) - set(NAMES))
    if unknown:
        sys.stderr.write(f"No notebook has the name {unknown[0]}. There are: {', '.join(NAMES)}\n")
        return 2
    restore_defaults()
    total = 0.0
    for name in NAMES:
        if names and name not in names:
            continue
        try:
            done = executed(name)
        except NotebookError as error:
            sys.stderr.write(f"{error}\n")
            return 1
        keep(name, done.content)
        total += done.seconds
        size = path_of(name).stat().st_size / 1000
        sys.stdout.write(f"{name}: {done.seconds:.1f} s, {size:.0f} kB\n")
        sys.stdout.flush()
    sys.stdout.write(f"together: {total:.1f} s\n")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
