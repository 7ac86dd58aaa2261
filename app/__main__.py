"""`python -m app` in the source tree is the command `footfall`."""

import sys

from footfall import main

sys.exit(main())
