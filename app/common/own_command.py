"""The command line that starts this program in a process of its own."""

import sys
from pathlib import Path

import footfall


def own_command(*words: str) -> list[str]:
    """Runs a command of this same program, wherever it stands, with output that nothing holds back.

    Args:
        *words: the command and its arguments, as after `footfall`.
    """
    folder = str(Path(footfall.__file__).resolve().parent)
    script = f"import sys; sys.path.insert(0, {folder!r}); import footfall; sys.exit(footfall.main())"
    # Neither the working folder nor that of a script comes first.
    return [sys.executable, "-uPc", script, *words]
