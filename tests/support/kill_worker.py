"""A process that edits, saves and names versions until it is killed.

It reads lines `FOLDER SEED` and has a forked child do the work, so that a round costs no start of Python.
The child tells on standard output what is acknowledged: `edit GAIT NUMBER`, `save …`, `version …`. When the
child is dead, the line `ended` follows.
"""

from __future__ import annotations

import os
import random
import sys
from dataclasses import replace
from pathlib import Path

from app.gaits.live_plans import LivePlans
from app.gaits.service import GaitService
from app.gaits.versions import VersionKind
from app.store.database import Database
from app.store.gait_files import GaitFiles
from core.library.library import library
from solver_jobs import SolveStatus
from tests.support.live_tiers import FixedTier

GAITS = ("walk", "amble", "walk-manual-0")


def opened(folder: Path) -> tuple[GaitService, Database]:
    """A service on a folder."""
    database = Database(folder / "studio.sqlite3")
    return GaitService(
        GaitFiles(folder), database, LivePlans(FixedTier(SolveStatus.INFEASIBLE)).solve_for
    ), database


def number_of(name: str) -> int:
    """The number that an edit wrote into a gait's name; 0 for a gait as it came."""
    return int(name.removeprefix("Number ")) if name.startswith("Number ") else 0


def work(folder: Path, seed: int) -> None:
    """Changes gaits, each change with the next number, and tells of each once it is done."""
    dice = random.Random(seed)
    service, _ = opened(folder)
    while True:
        gait_id = dice.choice(GAITS)
        gait = service.open_gait(gait_id).gait
        number = number_of(gait.name)
        deed = dice.choice(("edit", "edit", "edit", "save", "version"))
        if deed == "edit":
            number += 1
            service.edit(gait_id, replace(gait, name=f"Number {number}"), "Name", None)
        elif deed == "save":
            service.save(gait_id)
        else:
            number = service.versions.keep(
                service.open_gait(gait_id), VersionKind.NAMED, name=str(number)
            ).number
        os.write(1, f"{deed} {gait_id} {number}\n".encode())


def main() -> None:
    """Forks a child a line of standard input."""
    library()
    for line in sys.stdin:
        folder, seed = line.split()
        child = os.fork()
        if child == 0:
            work(Path(folder), int(seed))
        os.write(1, f"child {child} 0\n".encode())
        os.waitpid(child, 0)
        os.write(1, b"ended - 0\n")


if __name__ == "__main__":
    main()
