"""Large blocks that many threads have freed are no longer in the process."""

from __future__ import annotations

import ctypes
import subprocess
import sys

import pytest

BLOCKS, BLOCK = 12, 20_000_000
PROGRAM = f"""
import threading
from app.server.freed_memory import give_back_freed_memory
{{}}
def resident():
    with open("/proc/self/status") as status:
        return next(int(line.split()[1]) for line in status if line.startswith("VmRSS")) * 1000
before = resident()
together = threading.Barrier({BLOCKS})
kept = []
def use():
    for size in range({BLOCK}, {BLOCK} // 2, -({BLOCK} // 10)):
        block = bytearray(b"x") * size
        kept.append(bytearray(2000))  # stands behind it, as something always does in a long life
        together.wait()
        del block
threads = [threading.Thread(target=use) for _ in range({BLOCKS})]
for thread in threads: thread.start()
for thread in threads: thread.join()
print(resident() - before)
"""


def left(preparation: str) -> int:
    """Bytes that stay in a process after its threads have used and freed large blocks."""
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM.format(preparation)], capture_output=True, text=True, check=True
    )
    return int(done.stdout)


@pytest.mark.skipif(
    sys.platform != "linux" or not hasattr(ctypes.CDLL(None), "mallopt"), reason="only glibc keeps them"
)
def test_large_blocks_of_many_threads_go_back_to_the_system() -> None:
    assert left("give_back_freed_memory()") < BLOCK < left("")
