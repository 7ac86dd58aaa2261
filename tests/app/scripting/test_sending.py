"""Sending and showing by scripts: to the emulated robot, and in a studio of their own."""

from __future__ import annotations

import json
import signal
import threading
import time
import urllib.request
from pathlib import Path

import numpy as np
import pytest

import footfall as ff

pytestmark = pytest.mark.heavy

# A body that goes 3 mm down and up again, all feet on the ground.
BOW = np.full((4, 4, 3), 0.0055) + np.array([0.0, 0.003, 0.003, 0.0])[:, None, None]


def test_measured_strokes_are_those_that_were_commanded(tmp_path: Path) -> None:
    run = ff.send(BOW, to="emulator", by="Ada", data=tmp_path)
    lines = len(run.times)
    assert (run.state, run.reached) == ("done", 4)
    assert run.measured.shape == run.commanded.shape == (lines, 4, 3)
    assert run.measured[-1] == pytest.approx(BOW[-1], abs=0.0005)
    assert np.nanmax(np.abs(run.error[-1])) < 0.0005
    assert "4 waypoints" in repr(run)


def test_an_interrupt_stops_the_robot_and_gives_the_signals_back(tmp_path: Path) -> None:
    handler = signal.getsignal(signal.SIGINT)
    plan = ff.optimise("walk", method="live", iterations=3)
    timer = threading.Timer(14.0, signal.raise_signal, (signal.SIGINT,))
    timer.start()
    with pytest.raises(KeyboardInterrupt, match="Interrupted"):
        ff.send(plan, to="emulator", by="Ada", data=tmp_path)
    assert signal.getsignal(signal.SIGINT) is handler


def test_what_is_not_fit_is_not_sent(tmp_path: Path) -> None:
    tipping = ff.optimise("walk", method="live", margin=0.0)
    lifted = tipping.waypoints.copy()
    lifted[3:6, 1:3] = 0.0005
    with pytest.raises(ff.CheckError, match=r"Not fit to send: .* Nothing was sent\."):
        ff.send(lifted, to="emulator", by="Ada", data=tmp_path)


def test_errors_are_overridden_with_a_reason_alone(tmp_path: Path) -> None:
    walk = ff.plan("walk-manual-2")
    with pytest.raises(ff.CheckError, match=r"Not fit to send: .* Nothing was sent\."):
        ff.send(walk, to="emulator", by="Ada", data=tmp_path)
    with pytest.raises(ff.InputError, match="needs a reason"):
        ff.send(walk, to="emulator", by="Ada", data=tmp_path, override=" ")
    with pytest.raises(ff.InputError, match="No error stands that could be overridden"):
        ff.send(BOW, to="emulator", by="Ada", data=tmp_path, override="It walked.")
    far = BOW.copy()
    far[1] = 0.021
    with pytest.raises(ff.InputError, match=r"Errors of the rule “(stroke|deafness)” cannot be overridden"):
        ff.send(far, to="emulator", by="Ada", data=tmp_path, override="It walked.")
    assert not list(tmp_path.iterdir())
    run = ff.send(walk, to="emulator", by="Ada", data=tmp_path, override="It walked.")
    assert (run.state, run.reached) == ("done", len(walk.waypoints))


def test_a_studio_is_begun_and_shows_the_gait(tmp_path: Path) -> None:
    begin = time.monotonic()
    page = ff.show("walk", data=tmp_path, opens_browser=False)
    assert page.endswith("/?gait=walk")
    changed = ff.gait("walk", step=0.012)
    other = ff.show(changed, data=tmp_path, opens_browser=False)
    assert other.split("?")[0] == page.split("?")[0], "the same studio"
    gait_id = other.split("=")[1]
    with urllib.request.urlopen(f"{page.split('?')[0]}api/gaits/{gait_id}", timeout=10) as answer:
        assert np.hypot(*json.load(answer)["step"][:2]) == pytest.approx(0.012)
    assert time.monotonic() - begin < 60
