"""The stop procedure: latch, send, repeat, confirm, and the sentences meanwhile."""

from app.bridge.messages import NOT_STOPPED, SENTENCES
from app.bridge.state_log import StateLog
from app.bridge.states import RobotState
from app.bridge.stop_confirmation import STOP_LIMIT, StopConfirmation
from app.bridge.write_gate import WriteGate
from core.errors import StateError
from core.wire.lines import Line


class StopProcedure:
    """Carries out a stop, requested by a person or caused by a fault, until the robot has confirmed it.

    Args:
        state_log: where its states and sentences go.
        gate: the way out.
    """

    def __init__(self, state_log: StateLog, gate: WriteGate) -> None:
        self._state_log = state_log
        self._gate = gate
        self._stop: StopConfirmation | None = None

    @property
    def stands(self) -> bool:
        """Whether a stop stands, confirmed or not."""
        return self._stop is not None

    @property
    def pending(self) -> bool:
        """Whether a stop stands that is not confirmed."""
        return self._stop is not None and not self._stop.confirmed

    @property
    def text(self) -> str | None:
        """“stopped at 12.4 s by NAME” as long as a person's stop stands."""
        return None if self._stop is None else self._stop.text

    @property
    def cause(self) -> str:
        """Sentence of the fault that asked for the stop, or empty."""
        return "" if self._stop is None else self._stop.cause

    def begin(self, now: float, *, text: str | None = None, cause: str = "") -> None:
        """A stop was asked for by a person (`text`) or a fault (`cause`)."""
        self._stop = StopConfirmation(now, text, cause)

    def restart(self, now: float) -> None:
        """Has a stop that is not confirmed begin anew on a new line."""
        if self._stop is not None and self.pending:
            self._stop.restart(now)

    def send(self, now: float) -> None:
        """Sends it (once more).

        Raises:
            RobotError: the line did not take it.
        """
        if self._stop is not None:
            self._stop.sent(now)
        self._gate.stop()

    def see(self, line: Line, now: float) -> None:
        """Takes the next line from the robot; one that echoes the stop reads right."""
        if self._stop is not None and self._stop.see(line, now):
            self._gate.trust()

    def check(self, now: float, *, still: bool, may_send: bool) -> None:
        """Confirms the stop, says that it is overdue, or repeats it.

        Args:
            now: time, s.
            still: whether every motor stands, by readings that are still coming in.
            may_send: whether the line is good for a repetition.

        Raises:
            RobotError: the line did not take it.
        """
        stop = self._stop
        if stop is None or stop.confirmed:
            return
        if stop.echoed and still:
            stop.confirmed = True
            fault = self._state_log.robot is RobotState.FAULT
            robot = RobotState.FAULT if fault else RobotState.STOPPED
            self._state_log.become("The robot stands still.", self.describe(robot), robot=robot)
            return
        sentence = f"{stop.cause} {NOT_STOPPED}".strip()
        if stop.overdue(now) and self._state_log.sentence != sentence:
            self._state_log.become("The stop was not confirmed in time.", sentence)
        if may_send and stop.repeat_due(now):
            self.send(now)

    def describe(self, robot: RobotState) -> str:
        """What to say of a robot in this state while the stop stands."""
        shown = RobotState.STOPPING if self.pending else robot
        return f"{self.cause} {SENTENCES[shown]}".strip()

    def require_confirmed(self, now: float) -> None:
        """Refuses as long as a stop may still be confirmed in time.

        Raises:
            StateError: with the limit and what to do.
        """
        if self._stop is not None and self.pending and not self._stop.overdue(now):
            raise StateError(
                f"The robot has not confirmed the stop yet. Wait until it does, at most {STOP_LIMIT} s, "
                "then clear."
            )

    def lift(self) -> None:
        """The stop stands no longer."""
        self._stop = None
