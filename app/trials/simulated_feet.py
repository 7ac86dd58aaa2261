"""Physics' feet of what a trial's robot was sent: computed when they are asked for, then kept with the trial.

They come in the frame of the plan. Nothing here is waited for but by a thread of its own.
"""

import hashlib
import json
import logging
import threading
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field

import numpy as np

from app.common.json import Json
from app.common.version import VERSION
from app.simulation.problem import FORM, physics_content
from app.simulation.service import SimulationHandle, SimulationTier
from app.simulation.view import shown_samples
from app.store.tables.trial_reference_store import TrialReferenceStore
from app.trials.planned import sent_problem
from core.arrays import Floats
from core.errors import DamagedRowError, FootfallError
from core.physics.motion import SimulatedMotion
from core.physics.problem import SimulationProblem
from core.trials.alignment import repeated_motion

_log = logging.getLogger(__name__)

NOT_KNOWN = (
    "No simulated feet: what the robot was sent is not known of this trial, or the run did not do all of it."
)
DECIMALS = 6
"""Of positions in m that are kept."""


@dataclass(frozen=True, eq=False)
class SimulatedFeet:
    """Where physics has the feet of one lap, in the plan's frame.

    Args:
        times: (n,) s.
        feet: (n, feet, 2) m.
        physics: title of the parameters.
        ended_early: why it ended before the last waypoint, or "".
    """

    times: Floats
    feet: Floats
    physics: str
    ended_early: str = ""

    def repeated(self, laps: int) -> tuple[Floats, Floats]:
        """Times and feet of several laps, each beginning where the one before has taken the robot.

        A lap that ended early is the last one.
        """
        return repeated_motion(self.times, self.feet, 1 if self.ended_early else laps)


@dataclass(eq=False)
class _Work:
    """A simulation that is on, or that failed."""

    key: str
    handle: SimulationHandle | None = None
    share: float = 0.0
    sentence: str = ""
    has_failed: bool = False
    thread: threading.Thread | None = field(default=None, repr=False)


class TrialSimulations:
    """The simulations of trials; every method may be called from any thread.

    Args:
        log: where they are kept.
        tier: what simulates.
    """

    def __init__(self, log: TrialReferenceStore, tier: SimulationTier) -> None:
        self._log = log
        self._tier = tier
        self._lock = threading.Lock()
        self._works: dict[str, _Work] = {}

    def close(self) -> None:
        """Waits for the threads of simulations, whose answers are there once what simulates is closed."""
        with self._lock:
            threads = [work.thread for work in self._works.values() if work.thread is not None]
        for thread in threads:
            thread.join()

    def feet(self, trial: str) -> SimulatedFeet | None:
        """A trial's simulated feet; None where they are not there, or of other parameters or versions."""
        with suppress(DamagedRowError):
            problem = self._problem(trial)
            return None if problem is None else self._feet(trial, _key(problem))
        return None

    def standing(self, trial: str) -> Json:
        """How a trial's simulation stands: state `none`, `absent`, `running`, `failed` or `done`."""
        try:
            problem = self._problem(trial)
        except DamagedRowError as error:
            return _state("none", sentence=error.sentence)
        return _state("none", sentence=NOT_KNOWN) if problem is None else self._standing(trial, _key(problem))

    def begin(self, trial: str) -> Json:
        """Starts a trial's simulation where there is none and none is on; tells how it stands."""
        problem = self._problem(trial)
        if problem is None:
            return _state("none", sentence=NOT_KNOWN)
        key = _key(problem)
        if self._standing(trial, key)["state"] in ("absent", "failed"):
            self._begin(trial, problem)
        return self._standing(trial, key)

    def _feet(self, trial: str, key: str) -> SimulatedFeet | None:
        kept = self._log.simulated(trial)
        if kept is None or kept[0] != key:
            return None
        content = kept[1]
        times, feet = np.array(content["times"]), np.array(content["feet"])
        return SimulatedFeet(times, feet, content["physics"], content["ended_early"])

    def _standing(self, trial: str, key: str) -> Json:
        if self._feet(trial, key) is not None:
            return _state("done", 1.0)
        with self._lock:
            work = self._works.get(trial)
            if work is None or work.key != key:
                return _state("absent")
            return _state("failed" if work.has_failed else "running", work.share, work.sentence)

    def _begin(self, trial: str, problem: SimulationProblem) -> None:
        work = _Work(_key(problem))
        with self._lock:
            before = self._works.get(trial)
            if before is not None and before.key == work.key and not before.has_failed:
                return
            self._works[trial] = work
        work.handle = self._tier.submit(problem, progress=_teller(work))
        work.thread = threading.Thread(
            target=self._await, args=(trial, work, problem), name=f"trial-{trial}", daemon=True
        )
        work.thread.start()

    def _await(self, trial: str, work: _Work, problem: SimulationProblem) -> None:
        """Waits for the answer, in a thread of its own, and keeps it."""
        try:
            if work.handle is not None:
                content = _content(work.handle.result().motion, problem)
                self._log.put_simulated(trial, work.key, content)
        except FootfallError as error:
            work.sentence, work.has_failed = error.sentence, True
        except Exception as error:
            _log.exception("A trial's simulation broke off.")
            work.sentence, work.has_failed = f"The simulation broke off: {error!r}.", True
        finally:
            work.handle = None  # it holds the whole motion

    def _problem(self, trial: str) -> SimulationProblem | None:
        sent = self._log.sent(trial)
        return None if sent is None else sent_problem(sent)


def _teller(work: _Work) -> Callable[[float], object]:
    def tell(share: float) -> None:
        work.share = share

    return tell


def _state(state: str, share: float = 0.0, sentence: str = "") -> Json:
    return {"state": state, "share": share, "sentence": sentence}


def _key(problem: SimulationProblem) -> str:
    """Hash of everything that the simulated feet depend on, this program's version included."""
    parameters = json.dumps(physics_content(problem.physics), sort_keys=True)
    waypoints, robot = problem.waypoints.content_hash, problem.model.parameters_hash
    parts = [VERSION, str(FORM), robot, waypoints, parameters]
    return hashlib.sha256("\n".join(parts).encode()).hexdigest()


def _content(motion: SimulatedMotion, problem: SimulationProblem) -> Json:
    kept = shown_samples(motion)
    return {
        "times": np.round(motion.times[kept] - motion.times[kept[0]], 4).tolist(),
        "feet": np.round(motion.feet_world[kept, :, :2], DECIMALS).tolist(),
        "physics": problem.physics.title,
        "ended_early": motion.ended_early,
    }
