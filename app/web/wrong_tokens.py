"""Wrong tokens are answered late, so that nobody tries many; all other requests never wait."""

import asyncio
import time
from collections import deque
from collections.abc import Callable

FIRST_SECONDS, LONGEST_SECONDS = 0.25, 4.0
"""How late the answer to a wrong token is; each further one in a minute doubles it up to the longest."""

REMEMBERED_SECONDS = 60.0
MOST_REMEMBERED = 16


class WrongTokens:
    """Counts wrong tokens, whoever sends them: one attacker may have many addresses.

    Args:
        clock: seconds that only grow.
    """

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self._clock = clock
        self._times: deque[float] = deque(maxlen=MOST_REMEMBERED)

    def seconds(self) -> float:
        """Counts one more, and gives how long its answer waits."""
        now = self._clock()
        while self._times and now - self._times[0] > REMEMBERED_SECONDS:
            self._times.popleft()
        self._times.append(now)
        return float(min(FIRST_SECONDS * 2.0 ** (len(self._times) - 1), LONGEST_SECONDS))

    async def wait(self) -> None:
        """Lets the answer to one wrong token wait, and no other one."""
        await asyncio.sleep(self.seconds())
