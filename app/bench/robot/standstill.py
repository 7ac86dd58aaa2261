"""From a stop's click to standing still, by the emulated motors, for stop bounds to choose from."""

import random

import numpy as np

from app.bench.common.measure import Row
from app.bridge.states import IN_RUN, LinkState, RobotState, RunPlan
from app.emulator.profiles import ProfileName
from app.emulator.virtual_link import VirtualLink
from core.findings import Approval
from core.wire.messages import HIGHEST_MM, LOWEST_MM, MOTORS
from core.wire.waypoint_path import cut_parts
from core.wire.waypoints import Waypoints

BOUNDS = (0.8, 1.0, 2.5)
"""Longest time for which the robot may be deaf, s."""

STOPS = 30
WAYPOINTS = 4
DURATION = 1.0
LATEST_STOP = 4.0
"""A stop comes up to this long after the first approved waypoint was sent, s."""

BY = "bench"


def bench_still(stops: int = STOPS, seed: int = 0) -> list[Row]:
    """Random moves over the whole stroke, cut to keep each bound; stops at random moments."""
    rows = []
    for bound in BOUNDS:
        for profile in (ProfileName.PUBLISHED, ProfileName.SLOW):
            dice = random.Random(f"{seed} {bound} {profile}")
            seconds = [seconds_to_stand(bound, profile, dice) for _ in range(stops)]
            rows.append(
                {
                    "stop_bound_s": bound,
                    "profile": profile.value,
                    "stops": stops,
                    "median_s": round(float(np.median(seconds)), 2),
                    "max_s": round(max(seconds), 2),
                }
            )
    return rows


def seconds_to_stand(bound: float, profile: ProfileName, dice: random.Random) -> float:
    """Time from a stop in a run to the last movement of any motor, s of the robot."""
    bridge = VirtualLink(profile)
    bridge.boot()
    bridge.open()
    bridge.until(lambda s: s.link is LinkState.READY)
    bridge.machine.arm(BY)
    bridge.machine.send(_plan(bound, dice), BY, bridge.now)
    bridge.until(lambda s: s.run is not None and s.run.sent > 0)
    stop_at = bridge.now + dice.uniform(0.0, LATEST_STOP)
    while bridge.now < stop_at and bridge.machine.robot in IN_RUN:
        bridge.step()
    asked = moved = bridge.now
    bridge.stop(BY)
    stood = bridge.strokes_mm
    while bridge.machine.robot is not RobotState.STOPPED:
        bridge.step()
        if bridge.strokes_mm != stood:
            stood, moved = bridge.strokes_mm, bridge.now
    return moved - asked


def _plan(bound: float, dice: random.Random) -> RunPlan:
    rows = np.random.default_rng(dice.randrange(2**31)).uniform(LOWEST_MM, HIGHEST_MM, (WAYPOINTS, MOTORS))
    rows[0] = LOWEST_MM
    whole = Waypoints(rows.reshape(-1, MOTORS // 3, 3) / 1000.0, np.full(WAYPOINTS, DURATION))
    parts = cut_parts(whole, bound)
    # Rounded to what the wire carries.
    cut = [
        (rows[i - 1] + (rows[i] - rows[i - 1]) * part / parts[i]).round(4)
        for i in range(1, WAYPOINTS)
        for part in range(1, parts[i] + 1)
    ]
    waypoints = Waypoints(np.array(cut).reshape(-1, MOTORS // 3, 3) / 1000.0, np.full(len(cut), DURATION))
    approval = Approval("bench", waypoints.content_hash, BY, "2026-01-01T00:00:00+00:00")
    return RunPlan(waypoints, approval, (True,) * waypoints.count)
