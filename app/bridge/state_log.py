"""The states of link and robot, and a log of every change with its cause."""

import logging
from collections import deque

from app.bridge.messages import NOT_CONNECTED
from app.bridge.states import LinkState, RobotState, Transition
from app.bridge.write_gate import Clock
from core.errors import StateError

logger = logging.getLogger(__name__)

KEPT_TRANSITIONS = 1000


class StateLog:
    """The two states, the sentence that goes with them, and their history.

    Args:
        clock: by which changes are noted, s.

    Attributes:
        link: state of the cable.
        robot: state of the robot.
        sentence: what they mean and what can be done.
        last_error: sentence of the last fault or loss.
        transitions: the last thousand changes.
        revision: grows with everything that is worth showing.
    """

    def __init__(self, clock: Clock) -> None:
        self._clock = clock
        self.link = LinkState.DISCONNECTED
        self.robot = RobotState.UNKNOWN
        self.sentence = NOT_CONNECTED
        self.last_error: str | None = None
        self.transitions: deque[Transition] = deque(maxlen=KEPT_TRANSITIONS)
        self.revision = 0
        self._changes = 0

    def become(
        self,
        cause: str,
        sentence: str,
        *,
        link: LinkState | None = None,
        robot: RobotState | None = None,
    ) -> None:
        """Changes what is given, and keeps the rest."""
        self.link = link or self.link
        self.robot = robot or self.robot
        self.sentence = sentence
        self.revision += 1
        self._changes += 1
        self.transitions.append(Transition(self._clock(), self.link, self.robot, cause, self._changes))
        logger.info("link %s, robot %s: %s", self.link, self.robot, cause)

    def require_link(self, what: str) -> None:
        """Refuses unless the robot answers.

        Raises:
            StateError: with the link's state and what to do.
        """
        if self.link is not LinkState.READY:
            raise StateError(f"The robot cannot be {what}: its link is {self.link}. Connect it and wait.")

    def require_robot(self, *wanted: RobotState, remedy: str) -> None:
        """Refuses unless the robot is in one of the wanted states.

        Raises:
            StateError: with the robot's state and the remedy.
        """
        if self.robot not in wanted:
            raise StateError(f"The robot is {self.robot}. {remedy}")
