"""The command `footfall`, told to wait longer for robots and the live tier where other tests run beside it.

It starts a solver when it is first asked. Everything else is as users have it.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence

from app.cli import main
from app.gaits import live_plans
from app.studio import studio
from tests.support.patience import PATIENT_SECONDS, be_patient


def run_patiently(words: Sequence[str] | None = None) -> int:
    """Runs a command of the program; see `main`."""
    be_patient()
    live_plans.NEXT_SECONDS = PATIENT_SECONDS
    live_plans.FIRST_SECONDS = 2 * PATIENT_SECONDS
    studio.STARTS_SOLVERS_AHEAD = False
    return main(words)


if __name__ == "__main__":
    sys.exit(run_patiently())
