"""Searches for the fastest gait as jobs in the list, and the prices of options."""

import logging
import threading
import uuid
from collections.abc import Callable
from dataclasses import dataclass, field

from app.common.json import Json
from app.fastest.prices import Prices, price_content, price_key
from app.fastest.question import FastestQuestion, Option, options
from app.fastest.search import BOUNDS, FOOT_ORDERS, search_content, searched, tried_content
from app.jobs.job_tracker import JobTracker
from app.jobs.repository import JobRepository
from core.errors import FootfallError, InputError, StateError
from core.pose_gaits.pose_gait import PoseGait
from core.pose_gaits.pose_problem import PoseProblem
from solver_jobs import FastestSearch, SearchStep

_log = logging.getLogger(__name__)

KIND = "fastest"
"""What pages and scripts call these jobs."""
Show = Callable[[Json | None], object]
"""Told of what is known, and None at the end; from another thread."""
NEAR = frozenset({"stop_bound", "margin", "step", "clearance"})
"""Options whose gaits are looked for beside the asked one."""
_SHARES = {FOOT_ORDERS: (0.0, 0.25), BOUNDS: (0.25, 0.75)}
"""Where in a search with a front its parts begin, and how much of it they are."""


@dataclass(frozen=True, eq=False)
class Work:
    """Something that goes on in a thread of its own, and can be ended.

    Args:
        ending: set to end it.
    """

    ending: threading.Event = field(default_factory=threading.Event)

    def cancel(self) -> None:
        """Ends it."""
        self.ending.set()


class FastestService:
    """Searches and prices share a few processes, started when they are first needed.

    `submit` and `cancel` belong to the command queue's thread; `prices` may be called from any.

    Args:
        job_repository: the list of jobs.
        later: does something on the command queue's thread.
        shown: told of each job that changed, on the command queue's thread.
    """

    def __init__(
        self,
        job_repository: JobRepository,
        later: Callable[[Callable[[], None]], object],
        shown: Callable[[Json], object],
    ) -> None:
        self._job_repository = job_repository
        self._tracker = JobTracker(job_repository, later, shown, "Tries foot orders.")
        self._search = FastestSearch()
        self._prices = Prices()
        self._lock = threading.Lock()
        self._on: dict[Work, threading.Thread] = {}
        self._closed = False

    def submit(self, question: FastestQuestion, has_front: bool) -> Json:
        """Starts a search over all foot orders.

        Args:
            question: what is asked; its order is chosen.
            has_front: whether other margins and stop bounds are tried too.

        Raises:
            InputError: the question asks for what such a gait cannot have.
            StateError: a search is on.
        """
        problem = question.problem()
        if self._tracker.contents():
            raise StateError(
                "A search for the fastest gait is on. Wait for it, or cancel it in Jobs.", "search"
            )
        job_id = uuid.uuid4().hex[:12]
        seen = {"share": 0.0, "question": vars(question), "front": has_front, "tried": []}
        job = self._job_repository.begin(job_id, KIND, "", question.model.title, "", **seen)
        work = Work()
        self._tracker.begin(job_id, work)
        self._start(work, lambda: self._run(job_id, problem, has_front, work))
        return job

    def cancel(self, job_id: str) -> Json:
        """Asks a search to end; one that ended already stays as it is."""
        return self._tracker.cancel(job_id)

    def _run(self, job_id: str, problem: PoseProblem, has_front: bool, work: Work) -> None:
        tell = self._tracker.teller(job_id)
        tried: list[Json] = []

        def report(part: str, step: SearchStep) -> None:
            self._prices.keep(step.newest)
            tried.append(tried_content(step.newest))
            begin, width = _SHARES[part] if has_front else (0.0, 1.0)
            sentence = f"{part}: {step.done} of {step.count} tried."
            tell(begin + width * step.done / step.count, {"sentence": sentence, "tried": list(tried)})

        end: Json
        try:
            found = searched(self._search, problem, None, has_front, report, work.ending)
        except FootfallError as error:
            end = {"state": "failed", "sentence": error.sentence}
        except Exception as error:
            _log.exception("A search for the fastest gait broke off")
            end = {"state": "failed", "sentence": f"The search broke off ({error!r}); this is a bug."}
        else:
            content = search_content(found)
            best = found.ranked[0][1] if found.ranked else None
            sentence = f"{len(tried)} gaits were tried."
            end = {"state": "done", "sentence": sentence, "share": 1.0, "result": content}
            if best is None:
                end = {"state": "infeasible", "sentence": f"None of {len(tried)} gaits keeps every limit."}
            if work.ending.is_set():
                end = {"state": "cancelled", "sentence": "Cancelled."}
        if not self._closed:  # else it counts as interrupted
            self._tracker.end(job_id, end)

    def prices(self, question: FastestQuestion, show: Show) -> Callable[[], None]:
        """Looks for the prices of every option of a question.

        Args:
            question: what is asked.
            show: told of the options with the prices that are known, then of each new price, then None.

        Returns:
            A function that ends it.

        Raises:
            InputError: the question asks for what such a gait cannot have.
        """
        asked = question.problem()
        listed = [_priced(option) for option in options(question)]
        work = Work()
        self._start(work, lambda: self._price(listed, asked, show, work))
        return work.cancel

    def _price(self, listed: "list[_Priced]", asked: PoseProblem, show: Show, work: Work) -> None:
        try:
            show({"options": [self._priced_content(one) for one in listed]})
            self._look_for(listed, asked, show, work)
        except FootfallError as error:
            show({"sentence": error.sentence})
        finally:
            show(None)

    def _look_for(self, listed: "list[_Priced]", asked: PoseProblem, show: Show, work: Work) -> None:
        """Solves what has no price yet: the asked gait first, then what may begin beside it."""

        def report(step: SearchStep) -> None:
            self._prices.keep(step.newest)
            key = price_key(step.newest.problem)
            answered = [number for number, one in enumerate(listed) if one.key == key]
            show({"prices": [{"number": n, **self._priced_content(listed[n])} for n in answered]})

        near: PoseGait | None = None
        unknown = self._unknown(listed)
        if self._prices.known(asked) is None or any(one.option.group in NEAR for one in unknown):
            [tried] = self._search.solve([asked], report, ending=work.ending)
            near = tried.result.gait
        unknown = self._unknown(listed)
        problems = [one.problem for one in unknown if one.problem is not None]
        beside = [near if one.option.group in NEAR else None for one in unknown]
        self._search.solve(problems, report, beside, work.ending)

    def _unknown(self, listed: "list[_Priced]") -> "list[_Priced]":
        """One option of each price that is not known."""
        open_ = {one.key: one for one in reversed(listed) if one.problem is not None}
        return [
            one
            for one in reversed(open_.values())
            if one.problem is not None and self._prices.known(one.problem) is None
        ]

    def _priced_content(self, one: "_Priced") -> Json:
        option, problem = one.option, one.problem
        price = None if problem is None else self._prices.known(problem)
        return {
            "group": option.group,
            "value": option.value,
            "name": option.name,
            "sentence": one.sentence,
            "price": None if price is None or problem is None else price_content(price, problem),
        }

    def _start(self, work: Work, act: Callable[[], None]) -> None:
        def run() -> None:
            try:
                act()
            finally:
                with self._lock:
                    self._on.pop(work, None)

        thread = threading.Thread(target=run, name="fastest", daemon=True)
        with self._lock:
            if self._closed:
                raise StateError("The studio is closing.", "studio")
            self._on[work] = thread
            thread.start()

    def close(self) -> None:
        """Ends what is on, and the processes."""
        with self._lock:
            self._closed = True
            running = dict(self._on)
        for work in running:
            work.cancel()
        for thread in running.values():
            thread.join()
        self._search.close()


@dataclass(frozen=True, eq=False)
class _Priced:
    """An option, its problem with the key of its price, or why there is none."""

    option: Option
    problem: PoseProblem | None
    key: str = ""
    sentence: str = ""


def _priced(option: Option) -> _Priced:
    try:
        problem = option.question.problem()
    except InputError as error:
        return _Priced(option, None, sentence=error.sentence)
    return _Priced(option, problem, price_key(problem))
