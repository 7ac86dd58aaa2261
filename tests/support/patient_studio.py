"""The command `footfall`, told to wait longer for robots and the live tier where other tests run beside it.

Everything else is as users have it.
"""

from __future__ import annotations

import sys

from app.cli import main
from app.gaits import live_plans
from tests.support.patience import PATIENT_SECONDS, be_patient

if __name__ == "__main__":
    be_patient()
    live_plans.NEXT_SECONDS = PATIENT_SECONDS
    live_plans.FIRST_SECONDS = 2 * PATIENT_SECONDS
    sys.exit(main())
