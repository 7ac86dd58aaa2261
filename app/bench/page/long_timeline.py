"""The largest timeline that the page has to keep up with, and how its frames and tasks are watched."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from app.documents.gait_json import FORMAT
from app.documents.migrations import VERSION

if TYPE_CHECKING:
    from playwright.sync_api import Page

FEET, SAMPLES = 12, 240
SWING, PERIOD, APART = 12, 60, 20
"""Samples of a swing, from swing to swing of a foot, and from foot to foot."""

NAME = f"{FEET} feet, {SAMPLES} samples"

_WATCH = """() => {
  const seen = (window.footfallBench = { tasks: [], frames: [], on: false });
  new PerformanceObserver((list) => seen.tasks.push(...list.getEntries().map(({ duration }) => duration)))
    .observe({ type: "longtask" });
  let last = performance.now();
  const tick = (now) => {
    if (seen.on) seen.frames.push(now - last);
    last = now;
    requestAnimationFrame(tick);
  };
  requestAnimationFrame(tick);
}"""


def long_gait() -> dict[str, Any]:
    """A document of the dodecapod in which twelve feet swing in turn."""
    sample, foot = np.arange(SAMPLES), np.arange(FEET)[:, None]
    swings = (sample - 5 - APART * foot) % PERIOD < SWING
    swings &= (sample >= 5) & (sample < SAMPLES - 5)
    return {
        "format": FORMAT,
        "version": VERSION,
        "name": NAME,
        "robot": "dodecapod",
        "orientation": "FBS",
        "order": list(range(1, FEET + 1)),
        "step": [0.01, 0.0, 0.0],
        "timeline": {
            "sample_time": 0.4,
            "feet": ["".join("0" if swing else "1" for swing in row) for row in swings],
        },
    }


def watch(page: Page) -> None:
    """From now on the page notes its tasks of over 50 ms, and the frames while a drag is on."""
    page.evaluate(_WATCH)


def forget(page: Page) -> None:
    """Drops what was noted."""
    page.evaluate("() => Object.assign(window.footfallBench, { tasks: [], frames: [] })")


def dragging(page: Page, on: bool) -> None:
    """Notes frames, or no longer."""
    page.evaluate("(on) => { window.footfallBench.on = on; }", on)


def tasks_and_frames(page: Page) -> dict[str, int | None]:
    """Number of tasks over 50 ms and the longest of them, median and 95 % of the time between frames, ms."""
    seen = page.evaluate("() => window.footfallBench")
    frames = np.array(seen["frames"])
    share = {"frame_median_ms": 50, "frame_p95_ms": 95}
    return {
        "long_tasks": len(seen["tasks"]),
        "longest_ms": round(max(seen["tasks"], default=0.0)) or None,
        **{
            key: round(float(np.percentile(frames, at))) if len(frames) else None for key, at in share.items()
        },
    }
