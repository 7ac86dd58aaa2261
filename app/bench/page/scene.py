"""The 3D preview as users see it: poses a second while it plays, in headless Chromium.

A pose counts when the client has drawn a frame in which the robot stands elsewhere than in the frame before.
Everything is drawn in software, on the processor's own cores; a machine with a GPU is not measured here. The
machine's load during a row stands beside it, since other programs take from the same cores.
"""

from __future__ import annotations

import json
import os
import urllib.request
from typing import TYPE_CHECKING, Any

import numpy as np

from app.bench.common.measure import Row
from app.bench.page.edits import READY_MS, SIZE, headless_browser, served_studio
from app.common.json import Json

if TYPE_CHECKING:
    from playwright.sync_api import Page

PLAYED_MS = 5000
ROUNDS = 5
HIGHER = (0.0545, 0.0555)
"""Body heights of the edits that make another version to be shown as ghost, m."""

EVERYTHING = {"ghosts": {"before": True, "saved": True}, "scene": {"reach": True}}
_READY = """() => document.querySelector("#viser").contentWindow
  ?.__viserMutable?.nodeRefFromName?.["/overlay/com"]?.visible === true"""

_PLAYED = """(duration) => new Promise((done) => {
  const inside = document.querySelector("#viser").contentWindow.__viserMutable;
  const drawn = inside.scene.__r3f.root.getState().gl.info.render;
  const parts = Object.entries(inside.nodeRefFromName).filter(([name]) => /body$|foot$/.test(name));
  const place = () => parts.map(([, { position }]) => position.toArray().join()).join();
  const start = performance.now();
  let [frame, last, shown, longest] = [drawn.frame, place(), start, 0];
  let poses = 0;
  const look = () => {
    const now = performance.now();
    if (drawn.frame !== frame && place() !== last) {
      [frame, last, poses] = [drawn.frame, place(), poses + 1];
      [shown, longest] = [now, Math.max(longest, now - shown)];
    }
    if (now - start < duration) requestAnimationFrame(look);
    else done({ rate: poses / ((now - start) / 1000), longest });
  };
  requestAnimationFrame(look);
})"""


def bench_scene(rounds: int = ROUNDS) -> list[Row]:
    """Plays a walk bare, with ghosts and reach, and so beside the exact optimiser.

    Args:
        rounds: of each row; the median counts.

    Raises:
        InputError: Playwright or Chromium is missing.
        StateError: the studio does not start.
    """
    with headless_browser() as browser, served_studio() as address:
        for height in HIGHER:
            _raise_body(address, height)
        page = browser.new_page(viewport={"width": SIZE[0], "height": SIZE[1]})
        rows = [_row(page, address, "as it opens", {}, rounds)]
        rows.append(_row(page, address, "two ghosts, reach", EVERYTHING, rounds))
        _keep_solvers_busy(address)
        return [*rows, _row(page, address, "the same, optimising", EVERYTHING, rounds)]


def _row(page: Page, address: str, name: str, choices: Json, rounds: int) -> Row:
    page.goto(address)
    page.evaluate("localStorage.setItem('footfall.gait', 'walk')")
    for key, choice in choices.items():
        page.evaluate(
            "([key, value]) => localStorage.setItem(key, value)", [f"footfall.{key}", json.dumps(choice)]
        )
    page.reload()
    page.wait_for_function(_READY, timeout=READY_MS)
    page.get_by_role("button", name="Loop").click()
    page.get_by_role("button", name="Play", exact=True).click()
    page.mouse.move(SIZE[0] / 2, 1.0)
    page.evaluate(_PLAYED, PLAYED_MS / 5)
    found = [page.evaluate(_PLAYED, PLAYED_MS) for _ in range(rounds)]
    running = [job for job in _ask(f"{address}api/jobs", "GET")["jobs"] if job["state"] == "running"]
    return {
        "shown": name,
        "jobs running": len(running),
        "load": round(os.getloadavg()[0], 1),
        "poses_per_s": round(float(np.median([one["rate"] for one in found])), 1),
        "longest_gap_ms": round(float(np.median([one["longest"] for one in found]))),
    }


def _raise_body(address: str, height: float) -> None:
    document = _ask(f"{address}api/gaits/walk", "GET")
    document["options"]["plane_height"] = height
    _ask(f"{address}api/gaits/walk?label=Height", "PUT", document)


def _keep_solvers_busy(address: str) -> None:
    """Queues the search for the fastest timing of every gait of the library that walks without turning."""
    for gait in _ask(f"{address}api/gaits", "GET")["gaits"]:
        if gait["source"] == "optimised" and gait["step"][2] == 0 and gait["group"] != "Textbook":
            _ask(f"{address}api/jobs", "POST", {"kind": "timing", "gait": gait["id"]})


def _ask(url: str, method: str, content: Json | None = None) -> Any:
    body = None if content is None else json.dumps(content).encode()
    request = urllib.request.Request(url, body, {"content-type": "application/json"}, method=method)
    with urllib.request.urlopen(request) as answer:
        return json.load(answer)
