"""Makes plans on other threads, so that the command queue's thread goes on while a solver is at work."""

from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass
from functools import partial
from typing import Generic, TypeVar

from app.gaits.open_gaits import OpenGaits
from app.gaits.plan_cache import PlanRequest
from app.plans.plan import Plan
from app.session.command_queue import CommandQueue

Result = TypeVar("Result")

THREADS = 2
"""Plans that are made at one time; the live tier solves one after the other."""


@dataclass(frozen=True, eq=False)
class _Waiting(Generic[Result]):
    """An action that waits for a gait's plan, and where its result goes."""

    gait: str
    action: Callable[[], Result]
    future: Future[Result]


class Planner:
    """Makes the plan that a command needs, and then lets the command queue run it.

    Args:
        commands: the queue whose thread owns the open gaits.
        open_gaits: the gaits.
    """

    def __init__(self, commands: CommandQueue, open_gaits: OpenGaits) -> None:
        self._commands = commands
        self._open_gaits = open_gaits
        self._makers = ThreadPoolExecutor(max_workers=THREADS, thread_name_prefix="plans")

    def close(self) -> None:
        """Ends the threads; what waits for a plan stays undone."""
        self._makers.shutdown(cancel_futures=True)

    def after(
        self, gait_id: str, action: Callable[[], Result], future: Future[Result] | None = None
    ) -> Future[Result]:
        """Runs an action on the command queue's thread once the gait's present revision has a plan.

        Args:
            gait_id: which gait.
            action: finds the plan made.
            future: where its result goes; a new one for None.

        Returns:
            The future with what the action returns, or with what it or the gait's opening raises.
        """
        waiting = _Waiting(gait_id, action, Future() if future is None else future)
        self._commands.tell(partial(self._go_on, waiting, retry=True))
        return waiting.future

    def _go_on(self, waiting: _Waiting[Result], *, retry: bool) -> None:
        """On the command queue's thread: the action, or its plan first."""
        try:
            asked = self._open_gaits.unplanned(waiting.gait, retry=retry)
            if asked is None:
                waiting.future.set_result(waiting.action())
            else:
                self._makers.submit(self._make, asked, waiting)
        except BaseException as error:  # it belongs to whoever waits for the result
            waiting.future.set_exception(error)

    def _make(self, asked: PlanRequest, waiting: _Waiting[Result]) -> None:
        """On a thread of its own: the plan, which the command queue then takes over."""
        try:
            plan = self._open_gaits.planned(asked.open_gait.gait)
        except BaseException as error:  # it belongs to whoever waits for the result
            waiting.future.set_exception(error)
            return
        self._commands.tell(partial(self._take, asked, plan, waiting))

    def _take(self, asked: PlanRequest, plan: Plan, waiting: _Waiting[Result]) -> None:
        self._open_gaits.on_plan(asked, plan)
        self._go_on(waiting, retry=False)
