"""The operator lease: one person at a time may move the robot; everybody may watch and stop it.

Values and rules only; whoever drives them serialises the calls and gives the clock.
"""

from collections.abc import Callable
from dataclasses import dataclass

from core.errors import StateError

GONE_SECONDS = 15.0
"""A holder whose page gave no sign of life for this long is gone, s."""

ASK_SECONDS = 60.0
"""A question for the robot that nobody answered is forgotten after this, s."""


@dataclass(frozen=True)
class Person:
    """Who is at a page.

    Args:
        page: id of the page, one tab of a browser.
        name: the person's, empty where it is not known.
        is_script: whether it is no page but a program, which gives no signs of life.
    """

    page: str
    name: str = ""
    is_script: bool = False

    @property
    def title(self) -> str:
        """The name for a sentence's beginning."""
        if self.is_script:
            return f"A script of {self.name}" if self.name else "A script"
        return self.name or "An unnamed operator"


@dataclass(frozen=True)
class Holding:
    """Who holds the robot at one moment.

    Args:
        holder: None where nobody does.
        away: time since the holder's last sign of life, s; 0 for a script.
        asker: who asks for the robot.
    """

    holder: Person | None = None
    away: float = 0.0
    asker: Person | None = None

    @property
    def is_gone(self) -> bool:
        """Whether the holder is gone."""
        return self.holder is not None and self.away > GONE_SECONDS

    def is_free(self, *, is_idle: bool, is_away: bool) -> bool:
        """Whether the next person who acts on the robot becomes its holder (see `Lease.admit`)."""
        if self.holder is None:
            return True
        return (self.holder.is_script and is_idle) or (self.is_gone and is_away)

    @property
    def can_be_taken(self) -> bool:
        """Whether another may take the robot without being given it."""
        return self.holder is None or self.holder.is_script or self.is_gone


class Lease:
    """Decides who may move the robot: holder, hand-over, and whether the holder is still there.

    Args:
        clock: seconds that only grow.
    """

    def __init__(self, clock: Callable[[], float]) -> None:
        self._clock = clock
        self._holder: Person | None = None
        self._seen = clock()
        self._asker: Person | None = None
        self._asked = 0.0
        self._noted_gone = False

    @property
    def now(self) -> Holding:
        """Who holds the robot."""
        time = self._clock()
        if self._holder is None:
            return Holding()
        asker = self._asker if time - self._asked <= ASK_SECONDS else None
        return Holding(self._holder, 0.0 if self._holder.is_script else time - self._seen, asker)

    @property
    def is_abandoned(self) -> bool:
        """Whether nobody who may move the robot was there for long; a script is there when it acts."""
        return self._clock() - self._seen > GONE_SECONDS

    def admit(self, who: Person, *, is_idle: bool, is_away: bool = False) -> bool:
        """Admits the holder and refuses anybody else; if nobody holds the robot, `who` becomes the holder.

        Args:
            who: asks to do it.
            is_idle: the robot is not armed and does not move; a script holds nothing then.
            is_away: no robot is connected, or its line was lost; who is gone holds nothing then.

        Returns:
            Whether this made them the holder.

        Raises:
            StateError: somebody else holds the robot; the sentence says what to do.
        """
        holder = self._holder
        is_free = self.now.is_free(is_idle=is_idle, is_away=is_away)
        if holder is not None and holder.page != who.page and not is_free:
            raise StateError(refusal(self.now), "lease")
        taken = holder is None or holder.page != who.page
        self._become(who)
        return taken

    def take(self, who: Person) -> None:
        """Takes the robot from a holder who is gone, or from a script.

        Raises:
            StateError: the holder is there and must be asked.
        """
        now = self.now
        if now.holder is not None and now.holder.page != who.page and not now.can_be_taken:
            raise StateError(refusal(now), "lease")
        self._become(who)

    def ask(self, who: Person) -> None:
        """Asks the holder for the robot; where nobody holds it, it is theirs at once.

        Raises:
            StateError: they hold it, somebody asked before, or it can be taken over.
        """
        now = self.now
        if now.holder is None:
            return self._become(who)
        if now.holder.page == who.page:
            raise StateError("You are in control already.", "lease")
        if now.can_be_taken:
            raise StateError(refusal(now), "lease")
        if now.asker is not None and now.asker.page != who.page:
            raise StateError(
                f"{now.asker.title} has asked for control before you. Wait until "
                f"{now.holder.title} has answered.",
                "lease",
            )
        self._asker, self._asked = who, self._clock()
        return None

    def give(self, who: Person) -> None:
        """The holder gives the robot to whoever asked.

        Raises:
            StateError: they do not hold it, or nobody asks.
        """
        self._require_holder(who)
        asker = self.now.asker
        if asker is None:
            raise StateError("Nobody asks for control.", "lease")
        self._become(asker)

    def keep(self, who: Person) -> None:
        """The holder says no to whoever asked.

        Raises:
            StateError: they do not hold it.
        """
        self._require_holder(who)
        self._asker = None

    def release(self, who: Person) -> None:
        """The holder lets the robot go; whoever asked gets it.

        Raises:
            StateError: they do not hold it.
        """
        asker = self.now.asker
        self.drop(who)
        if asker is not None:
            self._become(asker)

    def drop(self, who: Person) -> None:
        """The holder lets the robot go for everybody, as after disconnecting it.

        Raises:
            StateError: they do not hold it.
        """
        self._require_holder(who)
        self._holder = self._asker = None
        self._seen = self._clock()

    def heard(self, page: str) -> bool:
        """A page gave a sign of life.

        Returns:
            Whether it is the holder's, who was gone and is back.
        """
        if self._holder is None or self._holder.page != page:
            return False
        was_gone, self._noted_gone = self._noted_gone, False
        self._seen = self._clock()
        return was_gone

    def at_work(self) -> None:
        """The robot does what it was told; a script is there as long as that lasts."""
        if self._holder is not None and self._holder.is_script:
            self._seen = self._clock()

    def note_gone(self) -> bool:
        """Returns true once each time the holder turns out to be gone."""
        if self._noted_gone or not self.now.is_gone:
            return False
        self._noted_gone = True
        return True

    def _become(self, who: Person) -> None:
        if self._holder is None or self._holder.page != who.page:
            self._asker = None
        elif not who.name:
            who = self._holder
        self._holder = who
        self._seen = self._clock()
        self._noted_gone = False

    def _require_holder(self, who: Person) -> None:
        now = self.now
        if now.holder is None:
            raise StateError("No one is in control. Connect or arm the robot to take control.", "lease")
        if now.holder.page != who.page:
            raise StateError(f"{now.holder.title} is in control, and decides who gets control.", "lease")


def refusal(now: Holding) -> str:
    """Why somebody else may not move the robot, and what they can do.

    Args:
        now: somebody holds the robot.
    """
    if now.holder is None:
        return "No one is in control."
    title = now.holder.title
    if now.holder.is_script:
        return f"{title} is in control. Take over, or wait until the script is done."
    if now.is_gone:
        return f"{title} is in control and has been gone for {now.away:.0f} s. Take control first."
    return f"{title} is in control. Ask {now.holder.name or 'them'} for control; everybody can stop."


def policy(holder: Person) -> str:
    """What happens when the holder is gone.

    Args:
        holder: who holds the robot.
    """
    if holder.is_script:
        return (
            "A run of a script goes on to its end whether or not the script is there. An armed robot is "
            f"disarmed {GONE_SECONDS:.0f} s after the script’s last request."
        )
    whose = f"{holder.name}’s page" if holder.name else "the holder’s page"
    return (
        f"If {whose} is gone for {GONE_SECONDS:.0f} s, a run pauses at the next pose with all feet down, and "
        "an armed robot is disarmed."
    )
