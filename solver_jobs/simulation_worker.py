"""The simulator's own process: one problem after the other.

MuJoCo is imported here and not in the parent. When the parent ends, its end of the pipe closes and the worker
leaves at its next look.
"""

from __future__ import annotations

import signal
import traceback
from collections.abc import Callable
from dataclasses import dataclass
from multiprocessing.connection import Connection

from core.errors import FootfallError
from core.physics.motion import SimulatedMotion
from core.physics.problem import SimulationProblem
from core.physics.variations import VariedRun


@dataclass(frozen=True, eq=False)
class Simulated:
    """What came of a problem.

    Args:
        motion: under the parameters as they are.
        runs: under their variations; empty where none were asked for.
    """

    motion: SimulatedMotion
    runs: tuple[VariedRun, ...] = ()


@dataclass(frozen=True, eq=False)
class Simulate:
    """To the worker: run this."""

    number: int
    problem: SimulationProblem
    variations: int
    seed: int


@dataclass(frozen=True)
class Halt:
    """To the worker: end this run."""

    number: int


@dataclass(frozen=True)
class Share:
    """From the worker: how much is done."""

    number: int
    share: float


@dataclass(frozen=True, eq=False)
class Answer:
    """From the worker: the result, or a refusal's sentence, or the text of a bug."""

    number: int
    result: Simulated | None
    refusal: FootfallError | None = None
    error: str = ""


def run_simulation_worker(pipe: Connection, warm_up: SimulationProblem | None) -> None:
    """Body of the process.

    Args:
        pipe: the worker's end.
        warm_up: run before anything is asked; None for nothing.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    from solver_jobs.physics.simulate import simulate

    if warm_up is not None:
        simulate(warm_up)
    try:
        while True:
            message = pipe.recv()
            if isinstance(message, Simulate):
                pipe.send(_answer(pipe, message))
    except (EOFError, ConnectionError):
        return


def _answer(pipe: Connection, asked: Simulate) -> Answer:
    try:
        return Answer(asked.number, _simulated(asked, _reporter(pipe, asked.number)))
    except FootfallError as refusal:
        return Answer(asked.number, None, refusal)
    except Exception as error:
        # A bug in one run must not end the process; the parent logs it and says so.
        return Answer(asked.number, None, error=f"{error!r}\n{traceback.format_exc()}")


def _simulated(asked: Simulate, report: Callable[[float], bool]) -> Simulated:
    """The run itself and its variations, which count alike in what is told."""
    from solver_jobs.physics.simulate import simulate, simulate_variations

    total = 1 + asked.variations
    motion = simulate(asked.problem, lambda share: report(share / total))
    if not asked.variations:
        return Simulated(motion)

    def varied(share: float) -> bool:
        return report((1 + share * asked.variations) / total)

    return Simulated(motion, simulate_variations(asked.problem, asked.variations, asked.seed, varied))


def _reporter(pipe: Connection, number: int) -> Callable[[float], bool]:
    """Sends the share and looks for an end; the parent sends nothing else in the middle of a run."""

    def report(share: float) -> bool:
        try:
            pipe.send(Share(number, share))
            while pipe.poll():
                message = pipe.recv()
                if isinstance(message, Halt) and message.number == number:
                    return False
        except (EOFError, OSError):
            return False
        return True

    return report
