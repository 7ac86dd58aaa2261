"""Runs `footfall serve` again and again, each time in a fork of this process: no start costs the imports.

It reads JSON lists, one a line: a mark for the processes that the studio starts, then the command's words. On
standard output stand `child PID`, what the studio itself prints, and `ended STATUS` once the child is dead.
"""

from __future__ import annotations

import json
import os
import sys

from tests.support.storm.processes import MARK


def run(mark: str, words: list[str]) -> None:
    """Runs the command in this process and ends it."""
    from app.cli import main as footfall

    os.environ[MARK] = mark
    status = 1
    try:
        status = footfall(words)
    finally:
        sys.stdout.flush()
        os._exit(status)


def main() -> None:
    """Forks a studio a line of standard input."""
    # Not at the top: the studio's worker processes load this module, and need none of it.
    import app.cli.commands_robot
    import app.server.launch  # noqa: F401
    from core.library.library import library

    library()
    for line in sys.stdin:
        mark, *words = json.loads(line)
        child = os.fork()
        if child == 0:
            run(mark, words)
        os.write(1, f"child {child}\n".encode())
        _, status = os.waitpid(child, 0)
        os.write(1, f"ended {os.waitstatus_to_exitcode(status)}\n".encode())


if __name__ == "__main__":
    main()
