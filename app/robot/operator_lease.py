"""The operator lease at work: signs of life of the holder's page, and what happens when they end."""

import itertools
import logging
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from app.bridge.bridge import RobotBridge
from app.bridge.lease import GONE_SECONDS, Holding, Lease, Person, policy, refusal
from app.bridge.states import IN_RUN, LinkState, RobotState
from app.common.json import Json
from app.undo.history import SCRIPT, Author
from core.errors import StateError
from core.running_time import RunningClock

logger = logging.getLogger(__name__)

BEAT_SECONDS = 2.0
"""The holder's page is asked for a sign of life this often, s."""

LOOK_SECONDS = 0.5
"""An armed robot without a holder is looked for at least this often, s."""

TellPage = Callable[[str, Json], None]


class OperatorLease:
    """Who holds the robot, for the rest of the program; every method may be called from any thread.

    Args:
        bridge: the robot.
        changed: called when there is something new to show.
        tell_page: sends an event to one page.
        clock: seconds that only grow.
        beat: time between two questions for a sign of life, s.
        most: the most that counts between two looks, s; a page cannot give a sign of life to a studio that
            does not run.
    """

    def __init__(
        self,
        bridge: RobotBridge,
        changed: Callable[[], None],
        tell_page: TellPage,
        clock: Callable[[], float] = time.monotonic,
        beat: float = BEAT_SECONDS,
        most: float = 2 * LOOK_SECONDS,
    ) -> None:
        self._bridge = bridge
        self._changed = changed
        self._tell_page = tell_page
        self._running = RunningClock(clock, most)
        self._lease = Lease(self._running)
        self._beat_seconds = beat
        self._lock = threading.Lock()
        self._last_action = object()
        self._awaited = 0
        self._closing = threading.Event()
        self._thread = threading.Thread(target=self._beat_on, name="robot lease", daemon=True)
        self._thread.start()

    def close(self) -> None:
        """Ends the signs of life."""
        self._closing.set()
        self._thread.join(timeout=5)

    @contextmanager
    def held_by(self, author: Author, *, ends: bool = False) -> Iterator[None]:
        """Runs an action under the lease; a lease that was taken for it is released if the action fails.

        Args:
            author: who does it.
            ends: nobody holds the robot after it, unless somebody did more with it meanwhile.

        Raises:
            StateError: somebody else holds the robot.
        """
        who = person(author)
        with self._lock:
            taken = self._lease.admit(who, is_idle=self._is_idle, is_away=self._is_away)
            action = self._last_action = object()
        try:
            yield
        except Exception:
            if taken:
                self._let_go(who, action)
            raise
        if ends:
            self._let_go(who, action, to_asker=False)
        else:
            self._changed()

    @contextmanager
    def awaiting(self) -> Iterator[None]:
        """While somebody's request is prepared, such as by a plan, an armed robot has not been left alone."""
        with self._lock:
            self._awaited += 1
        try:
            yield
        finally:
            with self._lock:
                self._awaited -= 1

    def heard(self, page: str) -> None:
        """A page gave a sign of life."""
        with self._lock:
            is_back = self._lease.heard(page)
        if is_back:
            self._changed()

    def page_left(self, page: str) -> None:
        """A page lost its events, so its keys drive no further: a jog of the holder ends early."""
        with self._lock:
            holder = self._lease.now.holder
        if holder is not None and holder.page == page and self._bridge.snapshot.jog is not None:
            self._bridge.end_early()

    def ask(self, author: Author) -> None:
        """Asks for the robot; see `Lease.ask`."""
        self._do(lambda: self._lease.ask(person(author)))

    def give(self, author: Author) -> None:
        """Gives the robot to whoever asked; see `Lease.give`."""
        self._hand_over(author, self._lease.give)

    def keep(self, author: Author) -> None:
        """Says no to whoever asked; see `Lease.keep`."""
        self._do(lambda: self._lease.keep(person(author)))

    def take(self, author: Author) -> None:
        """Takes the robot over; see `Lease.take`."""
        self._hand_over(author, self._lease.take)

    def release(self, author: Author) -> None:
        """Lets the robot go; see `Lease.release`.

        Raises:
            StateError: they do not hold it, or a run is on and nobody asks for it.
        """

        def let_go(who: Person) -> None:
            if self._lease.now.asker is None and self._bridge.snapshot.robot in IN_RUN:
                raise StateError("A run is on. Stop it, or let it end, before you release control.", "lease")
            self._lease.release(who)

        self._hand_over(author, let_go)

    def view(self) -> Json:
        """The lease as JSON content."""
        with self._lock:
            now = self._lease.now
        if now.is_free(is_idle=self._is_idle, is_away=self._is_away):
            now = Holding()
        holder, asker = now.holder, now.asker
        return {
            "page": None if holder is None else holder.page,
            "name": None if holder is None else holder.title,
            "is_script": holder is not None and holder.is_script,
            "is_gone": now.is_gone,
            "can_be_taken": now.can_be_taken,
            "asker": None if asker is None else {"page": asker.page, "name": asker.title},
            "refusal": None if holder is None else refusal(now),
            "policy": None if holder is None else policy(holder),
        }

    @property
    def _is_idle(self) -> bool:
        now = self._bridge.snapshot
        busy = {*IN_RUN, RobotState.ARMED, RobotState.STOPPING}
        return now.link is not LinkState.READY or now.robot not in busy

    @property
    def _is_away(self) -> bool:
        return self._bridge.snapshot.link in (LinkState.LOST, LinkState.DISCONNECTED)

    def _hand_over(self, author: Author, act: Callable[[Person], None]) -> None:
        """Changes the holder; who holds the robot then arms it themselves."""
        who = person(author)
        with self._lock:
            before = self._lease.now.holder
            act(who)
            after = self._lease.now.holder
            if before is not None and (after is None or after.page != before.page):
                self._bridge.disarm(f"{who.title}, for the robot changed hands")
        self._changed()

    def _do(self, wish: Callable[[], None]) -> None:
        with self._lock:
            wish()
        self._changed()

    def _let_go(self, who: Person, action: object, *, to_asker: bool = True) -> None:
        """Releases the lease after an action, unless somebody acted on the robot since."""
        with self._lock:
            holder = self._lease.now.holder
            if holder is not None and holder.page == who.page and action is self._last_action:
                (self._lease.release if to_asker else self._lease.drop)(who)
        self._changed()

    def _beat_on(self) -> None:
        looks = max(1, round(self._beat_seconds / LOOK_SECONDS))
        for number in itertools.count(1):
            if self._closing.wait(self._beat_seconds / looks):
                return
            self._running.look()
            try:
                self._disarm_abandoned()
                if number % looks == 0:
                    self._beat()
            except Exception:
                logger.exception("The robot's holder was not asked for a sign of life.")

    def _disarm_abandoned(self) -> None:
        """An armed robot whose holder is not there any more is disarmed, and says so."""
        robot = self._bridge.snapshot.robot
        with self._lock:
            if robot in IN_RUN:
                self._lease.at_work()
            if robot is not RobotState.ARMED or self._awaited or not self._lease.is_abandoned:
                return
            absence = f"{_absence(self._lease.now.holder)} for {GONE_SECONDS:.0f} s"
            self._bridge.disarm(f"the studio, as {absence}", f"The robot was disarmed, as {absence}.")
        logger.warning("The robot was disarmed, as %s.", absence)
        self._changed()

    def _beat(self) -> None:
        with self._lock:
            holder = self._lease.now.holder
            is_gone = self._lease.note_gone()
        if holder is None or holder.is_script:
            return
        self._tell_page(holder.page, {"type": "beat"})
        if is_gone:
            self._hold_on(holder)

    def _hold_on(self, holder: Person) -> None:
        """The stated policy: on to the next pose with all feet down, and wait there; all else ends early."""
        now = self._bridge.snapshot
        try:
            if now.run is None:
                self._bridge.end_early()
            elif now.robot is RobotState.MOVING:
                self._bridge.pause(f"the studio, as {holder.title} is gone")
        except StateError as refused:  # the run ended meanwhile, or it is a reset, which ends by itself
            logger.info("Not paused although %s is gone: %s", holder.title, refused.sentence)
        self._changed()


def _absence(holder: Person | None) -> str:
    """Who has not been there."""
    if holder is None:
        return "nobody was in control"
    if holder.is_script:
        return f"{holder.title[0].lower()}{holder.title[1:]} sent no request"
    return f"{holder.name}’s page was gone" if holder.name else "the page of the person in control was gone"


def person(author: Author) -> Person:
    """Who asks, for the lease."""
    return Person(author.page, author.name, is_script=author.page == SCRIPT)
