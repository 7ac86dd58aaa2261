"""Searches for footfall patterns: one at a time for each page; a new search ends the old one.

Any thread may ask; nothing here knows the open gaits, and the command queue's thread never waits for it.
"""

import itertools
import logging
import secrets
import threading
import time
from collections import OrderedDict
from collections.abc import Callable, Sequence
from concurrent.futures import Future
from dataclasses import dataclass, replace
from typing import Protocol

from app.common.json import Json
from app.pattern_search.views import progress_content, result_content
from core.errors import FootfallError, NotFoundError
from core.patterns.problem import (
    PatternProblem,
    PatternProgress,
    PatternResult,
    PatternStatus,
    Relaxation,
    Rule,
)
from core.patterns.sentences import explanation, failing_ends, failing_samples, length_words

_log = logging.getLogger(__name__)

Tell = Callable[[str, Json], None]
"""Shows an event to a page."""

MOST_KEPT = 32
"""Searches whose answers can still be asked for."""
TELL_SECONDS = 0.1
"""Between two reports of a search to its page."""
LEAST_SECONDS = 0.05
"""What a length is given at least."""


class PatternHandle(Protocol):
    """A search under way; `solver_jobs.PatternSearch` in the studio."""

    def result(self) -> PatternResult:
        """Waits for its answer."""

    def use_now(self) -> None:
        """Ends it with the best pattern yet."""

    def cancel(self) -> None:
        """Ends it."""


class PatternTier(Protocol):
    """Interface to the pattern solver; the studio passes `solver_jobs.PatternSolver`."""

    def submit(
        self,
        problem: PatternProblem,
        *,
        count: int = 1,
        seconds: float = 30.0,
        progress: Callable[[PatternProgress], object] = lambda known: None,
    ) -> PatternHandle:
        """Begins a search."""


@dataclass(frozen=True)
class PatternRequest:
    """What is asked.

    Args:
        problem_of: the problem of a length, or of its own for None.
        lengths: of which the first that works is sought; None for the problem's own.
        count: how many of the best patterns are wanted.
        seconds: longest search.
        too_few: samples that were asked for, where they are too few for what the cursors cut: the answer says
            so and offers the first of the lengths that works. None where any length is an answer.
    """

    problem_of: Callable[[int | None], PatternProblem]
    lengths: range | None
    count: int
    seconds: float
    too_few: int | None = None


class Search:
    """A question under way, or answered.

    Args:
        number: later questions have greater ones.
        page: whose it is; empty for a script's.
    """

    def __init__(self, number: int, page: str) -> None:
        self.id = number
        self.page = page
        self.future: Future[Json] = Future()
        self.progress: Json | None = None
        self.handle: PatternHandle | None = None
        self.is_superseded = False
        self.is_ended = False
        self.is_detached = False
        self.told_at = 0.0

    def content(self) -> Json:
        """The search as JSON content."""
        if self.future.done():
            return self.future.result()
        return {"id": self.id, "state": "running", "progress": self.progress}


class PatternSearchService:
    """The searches.

    Args:
        tiers: what searches; a search goes to the one that has the fewest.
        tell: shows an event to a page.
    """

    def __init__(self, tiers: Sequence[PatternTier], tell: Tell) -> None:
        self._tiers = tiers
        self._loads = [0] * len(tiers)
        self._tell = tell
        # Not from 1: a page may still name a search of a studio that has ended.
        self._numbers = itertools.count(secrets.randbelow(1 << 40))
        self._lock = threading.Lock()
        self._searches: OrderedDict[int, Search] = OrderedDict()
        self._newest: dict[str, Search] = {}

    def ask(self, page: str, question: PatternRequest) -> Search:
        """Begins a search in the place of the page's last one.

        Args:
            page: whose question it is; empty for a script, whose searches do not replace each other.
            question: what is asked.

        Raises:
            InputError: the problem cannot be posed.
        """
        problem = question.problem_of(question.lengths[0] if question.lengths else None)
        search = Search(next(self._numbers), page)
        with self._lock:
            self._remember(search)
            before = self._newest.pop(page, None) if page else None
            if page:
                self._newest[page] = search
        if before is not None:
            self._supersede(before)
        work = (search, question, problem)
        threading.Thread(target=self._work, args=work, name=f"pattern-{search.id}", daemon=True).start()
        return search

    def search(self, number: int) -> Search:
        """A search by its id.

        Raises:
            NotFoundError: there is none, or it is long ago.
        """
        with self._lock:
            if number not in self._searches:
                raise NotFoundError(
                    f"There is no search {number}; the last {MOST_KEPT} are kept.", str(number)
                )
            return self._searches[number]

    def cancel(self, number: int) -> Json:
        """Ends a search; one that is answered stays as it is."""
        search = self.search(number)
        _end(search)
        return search.content()

    def use_now(self, number: int) -> Json:
        """Ends a search with the best pattern yet."""
        search = self.search(number)
        search.is_ended = True
        if search.handle is not None and not search.future.done():
            search.handle.use_now()
        return search.content()

    def detach(self, search: Search) -> bool:
        """Lets the page hear of a search by events from now on; false where its answer is there already."""
        with self._lock:
            search.is_detached = not search.future.done()
            return search.is_detached

    def forget(self, page: str) -> None:
        """Ends the search of a page that is gone."""
        with self._lock:
            search = self._newest.pop(page, None)
        if search is not None:
            self._supersede(search)

    def _remember(self, search: Search) -> None:
        self._searches[search.id] = search
        while len(self._searches) > MOST_KEPT:
            self._searches.popitem(last=False)

    def _supersede(self, search: Search) -> None:
        search.is_superseded = True
        _end(search)

    def _work(self, search: Search, question: PatternRequest, problem: PatternProblem) -> None:
        with self._lock:
            which = self._loads.index(min(self._loads))
            self._loads[which] += 1
        try:
            problem, result = self._searched(self._tiers[which], search, question, problem)
            if question.too_few is not None:
                result = too_short(problem, result, question.too_few)
            content = {"id": search.id, "state": "done", "result": result_content(problem, result)}
        except FootfallError as error:
            content = {"id": search.id, "state": "failed", "sentence": error.sentence}
        except Exception as error:
            _log.exception("A pattern search broke off.")
            content = {"id": search.id, "state": "failed", "sentence": f"The search broke off: {error!r}."}
        finally:
            with self._lock:
                self._loads[which] -= 1
        self._finish(search, content)

    def _searched(
        self, tier: PatternTier, search: Search, question: PatternRequest, problem: PatternProblem
    ) -> tuple[PatternProblem, PatternResult]:
        """The answer of the first length that works, or of the last one for which there was time."""
        deadline = time.monotonic() + question.seconds
        lengths = helpful_lengths(question)
        while True:
            left = max(deadline - time.monotonic(), LEAST_SECONDS)
            result = self._solved(tier, search, problem, question.count, left)
            longer = next_length(problem, result, lengths)
            if longer is None:
                return problem, none_up_to(problem, result, lengths)
            if not search.is_ended and time.monotonic() > deadline:
                return problem, none_up_to(problem, result, lengths, "; there was no time for longer ones")
            if search.is_ended:
                # This length has no pattern, but longer ones were asked for as well.
                return problem, PatternResult(PatternStatus.CANCELLED, (), None, result.solve_seconds)
            problem = question.problem_of(longer)

    def _solved(
        self, tier: PatternTier, search: Search, problem: PatternProblem, count: int, seconds: float
    ) -> PatternResult:
        handle = tier.submit(
            problem,
            count=count,
            seconds=seconds,
            progress=lambda progress: self._progressed(search, problem, progress),
        )
        search.handle = handle
        if search.is_ended:
            handle.cancel()
        return handle.result()

    def _progressed(self, search: Search, problem: PatternProblem, progress: PatternProgress) -> None:
        search.progress = progress_content(problem, progress)
        now = time.monotonic()
        if search.is_detached and not search.is_superseded and now - search.told_at >= TELL_SECONDS:
            search.told_at = now
            self._tell(search.page, {"type": "pattern", **search.content()})

    def _finish(self, search: Search, content: Json) -> None:
        with self._lock:
            search.future.set_result(content)
            is_told = search.is_detached and not search.is_superseded
            if self._newest.get(search.page) is search:
                del self._newest[search.page]
        if is_told and search.page:
            self._tell(search.page, {"type": "pattern", **content})


def _end(search: Search) -> None:
    """Ends a search, also one that has only just begun, or is between two lengths."""
    search.is_ended = True
    if search.handle is not None and not search.future.done():
        search.handle.cancel()


def helpful_lengths(question: PatternRequest) -> range | None:
    """The lengths that may be tried; None where what is drawn leaves too few feet down in every one of them.

    Cells that finish a phase which a cursor cuts may overlap in a short length and not in a longer one, so
    the longest length tells.
    """
    lengths = question.lengths
    if lengths is None or failing_samples(question.problem_of(lengths[-1])):
        return None
    return lengths


def none_up_to(
    problem: PatternProblem, result: PatternResult, lengths: range | None, ending: str = ""
) -> PatternResult:
    """The answer of the last length, which says that no shorter one has a pattern either.

    Args:
        problem: of the last length that was tried.
        result: its answer.
        lengths: that may be tried; None where the length is given.
        ending: of the sentence.
    """
    if lengths is None or result.status is not PatternStatus.INFEASIBLE or failing_ends(problem):
        return result
    sentence = f"None of {lengths[0]} to {problem.sample_count} samples works{ending}."
    return replace(result, explanation=(sentence, *result.explanation))


def next_length(problem: PatternProblem, result: PatternResult, lengths: range | None) -> int | None:
    """The length that is tried after one that has no pattern; None where the search is at its end.

    An explanation that offers more samples has proven each smaller number of them to have no pattern.

    Args:
        problem: that was solved.
        result: its answer.
        lengths: that may be tried; None where the length is given.
    """
    if lengths is None or result.status is not PatternStatus.INFEASIBLE or failing_ends(problem):
        return None
    offered = [one.samples for one in result.relaxations if one.samples is not None]
    longer = min(offered, default=problem.sample_count + 1)
    return longer if longer in lengths else None


def too_short(problem: PatternProblem, result: PatternResult, samples: int) -> PatternResult:
    """The answer where a transition is too short to finish what its cursors cut: that, and what would help.

    Args:
        problem: of the last length that was tried.
        result: its answer.
        samples: that were asked for.
    """
    if result.status is PatternStatus.CANCELLED:
        return result
    sentence = f"{samples} samples are too few to finish the swings and stances that the cursors cut."
    if not result.patterns:
        return replace(result, explanation=(sentence, *result.explanation))
    works = problem.sample_count
    longer = Relaxation(Rule.FIXED, None, (), length_words(works, samples), works)
    return PatternResult(
        status=PatternStatus.INFEASIBLE,
        patterns=(),
        bound=None,
        solve_seconds=result.solve_seconds,
        explanation=explanation(problem, sentence, [longer]),
        relaxations=(longer,),
    )
