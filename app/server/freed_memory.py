"""Gives freed memory back to the system, where glibc would keep it: mallopt(3).

A body of 20 MB that was read once in each of many threads would otherwise stay in the process for good.
"""

import ctypes
import sys

_M_MMAP_THRESHOLD, _M_ARENA_MAX = -3, -8
LARGE_BYTES = 1_000_000
"""Blocks from this size on have pages of their own, and give them back when they are freed."""
MOST_ARENAS = 4
"""Pools of memory that threads share."""


def give_back_freed_memory() -> None:
    """Sets that up, before threads are started; does nothing where the C library knows no `mallopt`."""
    if sys.platform == "win32":
        return
    mallopt = getattr(ctypes.CDLL(None), "mallopt", None)
    if mallopt is not None:
        mallopt(_M_MMAP_THRESHOLD, LARGE_BYTES)
        mallopt(_M_ARENA_MAX, MOST_ARENAS)
