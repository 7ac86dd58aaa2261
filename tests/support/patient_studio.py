"""The command `footfall`, told to wait longer for the live tier where other tests run beside it.

Everything else is as users have it.
"""

from __future__ import annotations

import sys

from app.cli import main
from app.gaits import live_plans

PATIENT_SECONDS = 60.0

if __name__ == "__main__":
    live_plans.NEXT_SECONDS = PATIENT_SECONDS
    live_plans.FIRST_SECONDS = 2 * PATIENT_SECONDS
    sys.exit(main())
