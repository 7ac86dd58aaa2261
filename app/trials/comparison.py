"""Compares a trial with its plan and with physics: figures of the three, tracks in one frame, bands."""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from app.common.json import Json
from app.store.tables.table import reading
from app.trials.bands import band_content
from app.trials.figures import FIGURES, ROBOT, movement_content, path_content
from app.trials.record import TrialRecord
from app.trials.service import MOST_PLACES, TrialService
from app.trials.simulated_feet import TrialSimulations
from core.errors import InputError
from core.robot.model import load_robot
from core.trials.alignment import foot_gaps, placed_motion, track_of_motion
from core.trials.movement import foot_movements, mean_movement
from core.vision.track import FootTrack

SCENE_PLACES = 400
"""Places of a foot's way in 3D."""
MOST_TOGETHER = 20
"""Trials that are laid over each other."""


class TrialComparison:
    """Compares trials with plan and simulation. Thread-safe.

    Args:
        service: the trials.
        simulations: of what their robots were sent.
    """

    def __init__(self, service: TrialService, simulations: TrialSimulations) -> None:
        self._service = service
        self._simulations = simulations

    def figures(self, trial: str) -> Json:
        """How the trial's simulation stands, a row of figures a source, and physics' feet for a plot."""
        record = self._service.record(trial)
        with reading(f"The trial {trial} cannot be read: "):
            simulated, remark = self._simulated(record)
            rows = [_row(source, record, motion) for source, motion in self.sources(record).items()]
        return {
            "id": trial,
            "simulation": {**self._simulations.standing(trial), "remark": remark},
            "rows": rows,
            "simulated": None if simulated is None else path_content(simulated, MOST_PLACES),
        }

    def sources(self, record: TrialRecord) -> dict[str, FootTrack]:
        """The feet as `planned`, `simulated` and `tracked`, those that there are, in the track's frame."""
        simulated, _ = self._simulated(record)
        known = {"planned": record.placed_plan, "simulated": simulated, "tracked": record.track}
        return {source: motion for source, motion in known.items() if motion is not None}

    def simulate(self, trial: str) -> Json:
        """Starts a trial's simulation where there is none; tells how it stands."""
        self._service.record(trial)
        return self._simulations.begin(trial)

    def _simulated(self, record: TrialRecord) -> tuple[FootTrack | None, str]:
        """Physics' feet in the track's frame, and a remark on them."""
        feet = self._simulations.feet(record.content["id"])
        if feet is None or record.planned is None:
            return None, ""
        times, places = feet.repeated(record.planned.laps)
        words = f"Physics: {feet.physics}. {feet.ended_early}".strip()
        return placed_motion(times, places, record.alignment), words

    def scene(self, trial: str, lap: int = 1) -> Json:
        """The track in the frame of the plan's lap, m, by shares of the whole walk; and how the robot stood.

        Raises:
            InputError: there is no such lap.
        """
        record = self._service.record(trial)
        track = track_of_motion(record.track, record.alignment_of_lap(lap))
        kept = _thinned(track.times.size, SCENE_PLACES)
        shares = np.interp(kept, [0, *record.ends], np.linspace(0.0, 1.0, len(record.ends) + 1))
        return {
            "id": trial,
            "name": record.content["name"],
            "gait": record.content["gait"],
            "robot": ROBOT,
            "laps": record.laps,
            "playing": _playing(record, lap),
            "turn_deg": math.degrees(record.alignment.turn),
            "gaps_mm": (record.alignment.gaps * 1000.0).tolist(),
            "colours": list(load_robot(ROBOT).colours),
            "shares": np.round(shares, 5).tolist(),
            "feet": np.round(track.feet[kept].swapaxes(0, 1), 5).tolist(),
            "filled": track.filled[kept].T.tolist(),
        }

    def band(self, trials: Sequence[str]) -> Json:
        """Several trials over each other in the plan's frame: their mean way, the spread, and the plan; cm.

        Raises:
            InputError: too many, the same twice, or of other feet or iterations.
        """
        if not 1 <= len(set(trials)) == len(trials) <= MOST_TOGETHER:
            raise InputError(f"Choose 1 to {MOST_TOGETHER} different trials.", "trial")
        records = [self._service.record(trial) for trial in trials]
        return band_content(records)


def _playing(record: TrialRecord, lap: int) -> list[float]:
    """Shares of the walk at which a lap of the plan begins and ends; outside of 0 to 1 it was not done.

    Plans begin at 0 s; a run from a later pose on begins within the first lap.
    """
    if record.planned is None:
        return [0.0, 1.0]
    begin, end = float(record.planned.times[0]), float(record.planned.times[-1])
    first = (lap - 1) * record.lap_seconds
    return [(time - begin) / (end - begin) for time in (first, first + record.lap_seconds)]


def _row(source: str, record: TrialRecord, motion: FootTrack) -> Json:
    """Mean figures of a motion, how long it takes, and how far its feet are from the tracked ones."""
    mean = movement_content(mean_movement(foot_movements(motion, record.expected)))
    gaps = foot_gaps(record.track, record.ends, motion) * 1000.0 if motion is not record.track else None
    return {
        "source": source,
        "seconds": motion.seconds,
        **{key: mean[key] for key in FIGURES},
        "gap_mm": None if gaps is None else float(gaps.mean()),
        "gaps_mm": None if gaps is None else gaps.tolist(),
    }


def _thinned(count: int, most: int) -> Any:
    every = max(1, -(-count // most))
    return np.unique(np.append(np.arange(0, count, every), count - 1))
