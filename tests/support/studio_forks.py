"""Studios and their solvers in forks of a process that has loaded the program: no start costs the imports."""

from __future__ import annotations

import multiprocessing
import multiprocessing.forkserver
import os
import sys
from collections.abc import Sequence
from multiprocessing.connection import Connection
from multiprocessing.process import BaseProcess
from pathlib import Path
from typing import TextIO

CONTEXT = multiprocessing.get_context("forkserver")
LOADED = (
    "app.cli.commands_robot",
    "app.server.launch",
    "app.vision.worker",
    "solver_jobs.patterns.solve",
    "solver_jobs.physics.simulate",
    "solver_jobs.pose_gaits.solve",
    "solver_jobs.remedies.search",
    "solver_jobs.tiers.exact_from_live",
    "tests.support.patient_studio",
)
"""Modules of the studio and its solvers that every fork has."""
CONTEXT.set_forkserver_preload(list(LOADED))


def fork_studio(words: Sequence[str], said: Path) -> tuple[BaseProcess, TextIO]:
    """Runs a command of the program, as patiently as `patient_studio`, in a fork.

    Args:
        words: the command with its arguments.
        said: file for what it writes to standard error.

    Returns:
        The process, and its standard output.
    """
    ours, theirs = CONTEXT.Pipe(duplex=False)
    process = CONTEXT.Process(target=_run, args=(tuple(words), said, theirs), name="studio")
    process.start()
    theirs.close()
    output = os.fdopen(os.dup(ours.fileno()), encoding="utf-8")
    ours.close()
    return process, output


def _run(words: Sequence[str], said: Path, output: Connection) -> None:
    with said.open("ab") as errors:
        os.dup2(errors.fileno(), 2)
    os.dup2(output.fileno(), 1)
    output.close()
    sys.stdout.reconfigure(line_buffering=True)  # type: ignore[union-attr]

    from solver_jobs.workers import spawning
    from tests.support.patient_studio import run_patiently

    if sys.version_info < (3, 14):  # later ones do not let a fork ask for a fork
        # Without this, it would start a server of forks of its own.
        multiprocessing.forkserver._forkserver.ensure_running = lambda: None  # type: ignore[method-assign]
        spawning.START_METHOD = "forkserver"
    sys.exit(run_patiently(words))
