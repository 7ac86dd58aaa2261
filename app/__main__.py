"""`python -m app` is the command `footfall`."""

import sys

from app.cli import main

sys.exit(main())
