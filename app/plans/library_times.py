"""Finds the times of the library: `python -m app.plans.library_times`.

It writes core/data/times.toml anew; a test holds the library to what stands there.
"""

import sys
from pathlib import Path

from app.plans.robot_times import robot_times
from app.plans.sequence_plan import plan_of
from core.gait.gait import Gait
from core.library.library import library
from core.library.robot_times import RobotTimes
from solver_jobs import solve_live

FILE = Path(__file__).resolve().parents[2] / "core" / "data" / "times.toml"


def found_times(gait: Gait) -> RobotTimes | None:
    """Times of the plan that the page shows of a gait; None where no motion of it keeps every limit."""
    plan = plan_of(gait, lambda motion: None, lambda single: solve_live)
    return None if plan.is_draft else robot_times(plan)


def main() -> int:
    """Plans every gait and writes the file."""
    tables = ["# Written by app/plans/library_times.py; s, m/s and rad/s.\n"]
    for entry in library().values():
        times = found_times(entry.gait)
        sys.stdout.write(f"{entry.id}: {times}\n")
        if times is not None:
            values = "".join(f"{name} = {value!r}\n" for name, value in vars(times).items())
            tables.append(f"[{entry.id}]\n{values}")
    FILE.write_text("\n".join(tables))
    return 0


if __name__ == "__main__":
    sys.exit(main())
