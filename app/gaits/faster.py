"""Compares a drawn gait with the gait for the robot's clock of the same foot order and step."""

import logging
import threading
from collections import OrderedDict
from collections.abc import Callable
from dataclasses import asdict, dataclass, replace
from functools import partial

from app.common.json import Json
from app.documents.gait_json import gait_content, motion_hash
from app.gaits.pose_searches import result_content
from app.plans.make_plan import without_option_names
from app.plans.plan import Plan
from app.plans.walk_figures import plan_figures, pose_figures
from core.errors import FootfallError
from core.gait.gait import Gait
from core.pose_gaits.conversion import as_pose_gait, conversion_notice
from core.pose_gaits.gait_poses import pose_problem, with_poses
from solver_jobs import PoseGaitSolver, PoseProgress, PoseResult, PoseSearch, SolveStatus

logger = logging.getLogger(__name__)

MOST_ANSWERS = 8
"""Searches whose results are remembered."""
OWN_ERROR = "The studio met an error of its own, which its log describes. Try again, and please report it."
ANSWERS = (SolveStatus.SOLVED, SolveStatus.INFEASIBLE)
Show = Callable[[Json | None], object]
"""Told of each state as JSON content, and of None at the end; from a thread of the solver's, or at once."""


@dataclass(frozen=True, eq=False)
class Found:
    """What the searches for a gait ended with.

    Args:
        walk: all cycles, from the standard stance to rest.
        cycle: one cycle in mid-walk.
    """

    walk: PoseResult
    cycle: PoseResult

    @property
    def is_whole(self) -> bool:
        """Whether another search would end with the same."""
        if self.walk.status is SolveStatus.INFEASIBLE:
            return True
        return all(one.status in ANSWERS for one in (self.walk, self.cycle))


class Comparison:
    """The states of one search, as JSON content.

    Args:
        gait: the drawn gait.
        plan: its present one.

    Raises:
        InputError: a gait for the robot's clock cannot express it.
    """

    def __init__(self, gait: Gait, plan: Plan) -> None:
        self.wanted = as_pose_gait(gait, plan.model)
        self.model = plan.model
        now = plan_figures(gait, plan)
        self._base: Json = {
            "state": "running",
            "now": None if now is None else asdict(now),
            "faster": None,
            "stage": "",
            "sentence": "",
            "notice": conversion_notice(gait, self.wanted),
            "document": None,
        }

    def running(self, stage: str) -> Json:
        """While the search is on."""
        return self._base | {"stage": stage}

    def failed(self, sentence: str) -> Json:
        """After the search broke off."""
        return self._base | {"state": "failed", "sentence": sentence}

    def end(self, found: Found) -> Json:
        """After the search."""
        walk = found.walk
        if walk.gait is None or walk.check is None:
            sentence = " ".join(without_option_names(walk.explanation))
            is_infeasible = walk.status is SolveStatus.INFEASIBLE
            return self._base | {"state": "infeasible" if is_infeasible else "failed", "sentence": sentence}
        return self._base | {
            "state": "solved",
            "faster": asdict(pose_figures(walk.gait, walk.check, found.cycle.gait)),
            "document": gait_content(with_poses(self.wanted, walk.gait)),
        }


class FasterGaits:
    """Searches for the gaits for the robot's clock with the order and step of drawn gaits. Thread-safe.

    Args:
        solver: the process that searches.
        keep: told of the hash of what was asked and of the result, so that a gait that asks the same has it.
    """

    def __init__(self, solver: PoseGaitSolver, keep: Callable[[str, Json], object]) -> None:
        self._solver = solver
        self._keep = keep
        self._lock = threading.Lock()
        self._known: OrderedDict[str, Found] = OrderedDict()

    def search(self, gait: Gait, plan: Plan, show: Show) -> Callable[[], None]:
        """Begins a search, or shows at once what is known of the same one.

        Args:
            gait: a drawn gait.
            plan: its present one.
            show: told of each state: `state` is `running`, `solved`, `infeasible` or `failed`; `now` and
                `faster` have the figures of both gaits (see `WalkFigures`), null where they are not known;
                `stage` is what is being done, `sentence` why nothing was found, `notice` what the conversion
                leaves behind, `document` the gait with its poses.

        Returns:
            A function that ends the search.

        Raises:
            InputError: a gait for the robot's clock cannot express it.
        """
        comparison = Comparison(gait, plan)
        motion = motion_hash(comparison.wanted)
        with self._lock:
            known = self._known.get(motion)
        if known is not None:
            show(comparison.end(known))
            show(None)
            return lambda: None
        return self._begin(motion, comparison, show)

    def _begin(self, motion: str, comparison: Comparison, show: Show) -> Callable[[], None]:
        """Submits both searches; the walk, which is what is taken over, comes first."""
        problem = pose_problem(comparison.wanted, comparison.model)
        show(comparison.running("waiting for the solver"))

        def told(where: str, known: PoseProgress) -> None:
            show(comparison.running(f"{where}, {known.stage.lower()}"))

        in_mid_walk = replace(problem, cycles=None)
        walk = self._solver.submit(problem, partial(told, "from rest to rest"))
        cycle = self._solver.submit(in_mid_walk, partial(told, "in mid-walk"), explain=False)

        def on_walk() -> None:
            if not _is_solved(walk):
                cycle.cancel()

        def on_end() -> None:
            try:
                show(self._taken(motion, comparison, Found(walk.result(), cycle.result())))
            except FootfallError as error:
                show(comparison.failed(error.sentence))
            except Exception:  # a callback's error goes nowhere, and the page would wait for good
                logger.exception("The comparison with a faster gait broke off.")
                show(comparison.failed(OWN_ERROR))
            finally:
                show(None)

        def end() -> None:
            walk.cancel()
            cycle.cancel()

        walk.when_done(on_walk)
        cycle.when_done(on_end)
        return end

    def _taken(self, motion: str, comparison: Comparison, found: Found) -> Json:
        """The last state; the results are remembered."""
        content = result_content(found.walk)
        if content is not None:
            self._keep(motion, content)
        if found.is_whole:
            with self._lock:
                self._known[motion] = found
                while len(self._known) > MOST_ANSWERS:
                    self._known.popitem(last=False)
        return comparison.end(found)


def _is_solved(search: PoseSearch) -> bool:
    """Whether a search that has ended found a gait."""
    try:
        return search.result().gait is not None
    except FootfallError:
        return False
