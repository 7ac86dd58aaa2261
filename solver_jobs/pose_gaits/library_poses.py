"""Finds the poses of the library: `python -m solver_jobs.pose_gaits.library_poses`.

It writes core/data/poses.toml anew; a test holds the library to what stands there.
"""

import sys
from collections.abc import Sequence
from pathlib import Path

from core.data.tables import data_table
from core.gait.poses import FoundPoses
from core.library.for_robot import asked_gait, found_poses
from core.library.library import library
from core.pose_gaits.gait_poses import asked_of, found_of, pose_problem
from core.pose_gaits.pace import pace_words
from core.robot.model import load_robot
from solver_jobs.pose_gaits.solve import solve_poses
from solver_jobs.results.motion import SolveStatus

FILE = Path(__file__).resolve().parents[2] / "core" / "data" / "poses.toml"
DECIMALS = 8
"""Of a metre."""


def main() -> int:
    """Solves the gaits that have no poses in the file yet; exit status 1 if one has no solution."""
    tables: list[str] = []
    for item in data_table("for_robot.toml")["gait"]:
        gait = asked_gait(item, library()[item["like"]].gait)
        problem = pose_problem(gait, load_robot(gait.robot))
        known = found_poses().get(item["id"])
        if known is not None and known.answers == asked_of(problem):
            tables.append(_table(item["id"], known))
            continue
        result = solve_poses(problem)
        if result.status is not SolveStatus.SOLVED or result.gait is None:
            sys.stderr.write(f"{item['id']}: {' '.join(result.explanation)}\n")
            return 1
        pace = pace_words(result.gait.pace, result.gait.problem.on_the_spot)
        sys.stdout.write(f"{item['id']}: {pace}\n")
        tables.append(_table(item["id"], found_of(result.gait)))
    head = "# Written by solver_jobs/pose_gaits/library_poses.py; lengths in m, headings in rad.\n\n"
    FILE.write_text(head + "\n".join(tables))
    return 0


def _table(gait_id: str, found: FoundPoses) -> str:
    bodies = ",\n".join(f"  {_row(body)}" for body in found.bodies.tolist())
    feet = ",\n".join("  [" + ", ".join(_row(foot) for foot in pose) + "]" for pose in found.feet.tolist())
    head = f'[{gait_id}]\nanswers = "{found.answers}"\nstep = {found.step!r}\n'
    headings = "" if found.headings is None else f"headings = {_row(found.headings.tolist())}\n"
    return f"{head}{headings}bodies = [\n{bodies},\n]\nfeet = [\n{feet},\n]\n"


def _row(values: Sequence[float]) -> str:
    return "[" + ", ".join(repr(round(value, DECIMALS) + 0.0) for value in values) + "]"


if __name__ == "__main__":
    sys.exit(main())
