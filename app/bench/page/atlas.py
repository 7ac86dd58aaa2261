"""What a run of an atlas in the background costs: edits with and without one in turn, and memory."""

from __future__ import annotations

import json
import os
import urllib.request
from pathlib import Path
from typing import Any

import numpy as np

from app.bench.common.measure import Row
from app.bench.page.edits import (
    READY_MS,
    REST_MS,
    SIZE,
    bench_drags,
    headless_browser,
    open_drawn_walk,
    served_studio,
)

ROUNDS = 4
"""Rounds of edits with a run, and as many without one, in turn."""
DRAGS = 3
"""Drags of each kind in a round."""
MANY = 1_000_000
WARM_SECONDS = 10.0
"""After the start of a run: its worker has begun then."""
KEYS = ("plots_median_ms", "3d_median_ms")


def bench_atlas() -> list[Row]:
    """Drags in turn without and with a run of an atlas.

    Returns:
        A row a drag: the median over the rounds of each time without and with a run, and their ratio; then
        one with the memory of the studio and its workers, MB (proportional shares of what processes have in
        common).

    Raises:
        InputError: Playwright or Chromium is missing.
        StateError: the studio does not start.
    """
    times: dict[tuple[str, bool], list[Row]] = {}
    memory: dict[bool, list[float]] = {False: [], True: []}
    with headless_browser() as browser, served_studio() as address:
        page = browser.new_page(viewport={"width": SIZE[0], "height": SIZE[1]})
        open_drawn_walk(page, address)
        bench_drags(page, 1)
        for _ in range(ROUNDS):
            for is_on in (False, True):
                job = _ask(address, "POST", "atlases", {"name": "bench", "count": MANY}) if is_on else None
                page.wait_for_timeout(WARM_SECONDS * 1000)
                for row in bench_drags(page, DRAGS):
                    times.setdefault((str(row["drag"]), is_on), []).append(row)
                memory[is_on].append(_memory())
                if job is not None:
                    _ask(address, "DELETE", f"jobs/{job['id']}")
                    page.wait_for_timeout(5 * REST_MS)
    rows = [_compared(drag, times) for drag, is_on in times if not is_on]
    without, running = (float(np.median(memory[is_on])) for is_on in (False, True))
    return [
        *rows,
        {"memory_mb": round(without), "with_run_mb": round(running), "more_mb": round(running - without)},
    ]


def _compared(drag: str, times: dict[tuple[str, bool], list[Row]]) -> Row:
    row: Row = {"drag": drag, "drags": ROUNDS * DRAGS}
    for key in KEYS:
        without, running = (_median(times[drag, is_on], key) for is_on in (False, True))
        name = key.removesuffix("_median_ms")
        row |= {f"{name}_ms": round(without), f"{name}_with_run_ms": round(running)}
        row[f"{name}_ratio"] = round(running / without, 2)
    return row


def _median(rows: list[Row], key: str) -> float:
    return float(np.median([float(str(row[key])) for row in rows if row[key] is not None]))


def _ask(address: str, method: str, path: str, content: Any = None) -> Any:
    body = None if content is None else json.dumps(content).encode()
    asked = urllib.request.Request(
        f"{address}api/{path}", body, {"content-type": "application/json"}, method=method
    )
    with urllib.request.urlopen(asked, timeout=READY_MS / 1000) as answer:
        return json.loads(answer.read())


def _memory() -> float:
    """Proportional memory of this process's Python descendants, the studio and its workers, MB."""
    parents = {}
    for path in Path("/proc").glob("[0-9]*/stat"):
        try:
            parents[int(path.parent.name)] = int(path.read_text().rpartition(")")[2].split()[1])
        except OSError:  # it has ended
            continue
    found, newest = set(), {os.getpid()}
    while newest:
        newest = {process for process, parent in parents.items() if parent in newest}
        found |= newest
    return sum(_share(process) for process in found) / 1000.0


def _share(process: int) -> float:
    """Proportional memory of a Python process, kB; 0 of any other program."""
    folder = Path(f"/proc/{process}")
    try:
        if "python" not in os.path.basename(os.readlink(folder / "exe")):
            return 0.0
        lines = (folder / "smaps_rollup").read_text().splitlines()
    except OSError:  # it has ended
        return 0.0
    return float(next(line for line in lines if line.startswith("Pss:")).split()[1])
