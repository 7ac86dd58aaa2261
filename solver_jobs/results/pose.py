"""What the search for a pose gait reports, as frozen values that carry nothing of the solver itself."""

from dataclasses import dataclass

from core.pose_gaits.pose_check import PoseCheck
from core.pose_gaits.pose_gait import PoseGait
from solver_jobs.results.motion import SolveStatus


@dataclass(frozen=True)
class PoseProgress:
    """What is known in the middle of a search.

    Args:
        stage: what is being done, for a person.
        done: share of the stages, 0 to 1.
        speed: of the fastest gait yet, m/s; None where there is none.
        turn_rate: of the same, rad/s.
    """

    stage: str
    done: float
    speed: float | None = None
    turn_rate: float | None = None


@dataclass(frozen=True, eq=False)
class PoseResult:
    """The outcome of a search.

    Args:
        status: `solved` only where the independent check has confirmed the gait.
        gait: the gait, or None.
        check: of the gait, or None.
        optimal: whether IPOPT ended at a local optimum of the robot's time within its tolerance.
        explanation: sentences where it is not solved.
        solve_seconds: time in IPOPT.
        seconds: of the whole search.
    """

    status: SolveStatus
    gait: PoseGait | None
    check: PoseCheck | None
    optimal: bool
    explanation: tuple[str, ...]
    solve_seconds: float
    seconds: float
