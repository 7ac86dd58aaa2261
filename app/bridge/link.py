"""The bridge's link to the robot: opening, silence, loss, faults, and the stop's way through all of them.

It knows no runs; `RobotStateMachine` does, and says through the two methods at the end what it is busy with.
"""

from abc import ABC, abstractmethod

from app.bridge.delivery import Delivery
from app.bridge.handshake import START_LIMIT, Handshake
from app.bridge.messages import (
    CONNECTING,
    FLOODED,
    NOT_CONNECTED,
    NOT_SENT,
    OVERLONG,
    RESTARTED,
    restless_sentence,
    silent_sentence,
    stranger_sentence,
    unread_sentence,
    without_remedy,
)
from app.bridge.state_log import StateLog
from app.bridge.states import IN_RUN, LinkState, RobotState
from app.bridge.stop_procedure import StopProcedure
from app.bridge.telemetry import STALE_TIME, TelemetryMonitor
from app.bridge.write_gate import Clock, WriteGate
from core.errors import RobotError, StateError
from core.wire.lines import Line, LineReader, OverlongLine, SetupFinished, SetupMoving


class RobotLink(StateLog, ABC):
    """One link to one robot.

    Args:
        gate: the way out.
        clock: by which changes and runs are noted, s; the `now` of all methods counts time in which the
            program ran, for the deadlines.

    Attributes:
        device: what is or was connected.
        monitor: what the robot's lines tell.
    """

    def __init__(self, gate: WriteGate, clock: Clock) -> None:
        super().__init__(clock)
        self.device: str | None = None
        self.monitor = TelemetryMonitor(0.0)
        self._gate = gate
        self._stop = StopProcedure(self, gate)
        self._handshake = Handshake(0.0)
        self._reader = LineReader()
        self._delivery: Delivery | None = None
        self._hung_up = False
        self._clearing = False
        self._noted: set[str] = set()
        self._was_away = False
        self._away_cause = ""

    @property
    def in_run(self) -> bool:
        """Whether a run or a reset is under way."""
        return self.robot in IN_RUN

    @property
    def awaits_stop(self) -> bool:
        """Whether a stop is active that the connected robot has not confirmed yet."""
        return self._stop.pending and self.link in (LinkState.CONNECTING, LinkState.READY)

    def opened(self, device: str, now: float) -> None:
        """A line was opened."""
        self.device = device
        self._handshake = Handshake(now)
        self._stop.restart(now)
        self._hung_up = False
        self._noted.clear()
        self._reader = LineReader()
        self.monitor = TelemetryMonitor(now)
        self.become(f"{device} was opened.", CONNECTING, link=LinkState.CONNECTING)

    def refused(self, device: str, reason: str) -> None:
        """A line could not be opened."""
        self.device = device
        self.last_error = reason
        self.revision += 1

    def closed(self) -> None:
        """The line was closed on purpose."""
        self._drop_run()
        self.become(
            "Disconnected.",
            NOT_CONNECTED,
            link=LinkState.DISCONNECTED,
            robot=RobotState.UNKNOWN,
        )

    def hung_up(self, reason: str, now: float) -> None:
        """The line broke."""
        self._hung_up = True
        self._lose(reason, now)

    def received(self, data: bytes, now: float) -> None:
        """Bytes came from the robot."""
        self.monitor.heard(now)
        for line in self._reader.feed(data):
            self.monitor.see(line, now)
            self._see(line, now)

    def flooded(self, now: float) -> None:
        """Bytes of the robot were left out, for more came than can be read."""
        self._reader.cut()
        self._see_garbage(FLOODED, now)

    @property
    def was_away(self) -> bool:
        """Whether the bytes that came while the program did not run are still to be taken."""
        return self._was_away

    def stop(self, by: str, now: float, *, is_sent: bool = True) -> None:
        """Latches a stop whose bytes are already out, or which the line did not take.

        A fault that it comes after is still told of, and a time in which the program did not run.
        """
        if self.link is LinkState.DISCONNECTED:
            return
        stands = self.robot is RobotState.STOPPED and not self._stop.pending
        if (stands or self.robot is RobotState.STOPPING) and not self._clearing:
            return
        cause = self._stop.cause if self.robot is RobotState.FAULT else self._away_cause
        self._stop.begin(now, text=self._describe_stop(by), cause=cause)
        self._drop_run()
        sentence = self._stop.describe(RobotState.STOPPING) if is_sent else f"{cause} {NOT_SENT}".strip()
        self.become(f"Stop by {by}.", sentence, robot=RobotState.STOPPING)

    def tick(self, now: float) -> None:
        """Time has passed: silence, standing still, deadlines."""
        if self.link in (LinkState.READY, LinkState.CONNECTING):
            self._check_silence(now)
        if self.link is not LinkState.DISCONNECTED and not self._clearing:
            self._check_stop(now)

    def _note_away(self, seconds: float, now: float) -> None:
        """Called when the program did not run for `seconds`: a line keeps no more than `STALE_TIME` holds."""
        if seconds > STALE_TIME:
            self._was_away = True
            self.monitor.forget_age(now)

    def _begin_anew(self, now: float) -> None:
        """Called when the bytes that waited are taken: some may be missing, what comes is of the present."""
        self._was_away = False
        self._reader.cut()
        self.monitor.forget_age(now)

    def _see(self, line: Line, now: float) -> None:
        if isinstance(line, SetupMoving | SetupFinished):
            self._see_restart(now)
        elif isinstance(line, OverlongLine):
            self._see_garbage(OVERLONG, now)
        self._stop.see(line, now)
        if self.link is not LinkState.READY and not self._hung_up:
            self._open_up(line, now)

    def _see_garbage(self, sentence: str, now: float) -> None:
        """Ends what is under way; otherwise it is noted once in a connection."""
        if self._is_busy:
            self._fault(sentence, now)
        elif sentence not in self._noted:
            self._noted.add(sentence)
            self.become(sentence, self.sentence)

    @property
    def _is_busy(self) -> bool:
        return self.in_run or self._clearing

    def _see_restart(self, now: float) -> None:
        if self.link is LinkState.CONNECTING or self._hung_up:
            return
        self._fault(RESTARTED, now)
        self._handshake.restart(now)
        self.become("The board restarted.", self.sentence, link=LinkState.CONNECTING)

    def _open_up(self, line: Line, now: float) -> None:
        if self._handshake.is_ready(now, self.monitor):
            self._become_ready()
        elif self._handshake.flush_due(line, self.monitor):
            self._handshake.flushed(now, self.monitor)
            try:
                self._gate.flush()
            except RobotError as error:
                self.hung_up(error.sentence, now)

    def _become_ready(self) -> None:
        self._gate.trust()
        robot = self.robot
        if robot is RobotState.UNKNOWN and self._stop.stands:
            robot = RobotState.STOPPING if self._stop.pending else RobotState.STOPPED
        elif robot is RobotState.UNKNOWN:
            robot = RobotState.DISARMED
        sentence = self._stop.describe(robot)
        self.become("The robot answers.", sentence, link=LinkState.READY, robot=robot)

    def _check_silence(self, now: float) -> None:
        silence = now - self.monitor.last_byte
        limit = self.monitor.longest_silence
        if self.link is LinkState.READY and silence > limit:
            self._lose(silent_sentence(silence, limit, self._place), now)
        elif self.link is LinkState.READY and self._is_busy:
            self._check_strokes(now)
        elif self.link is LinkState.CONNECTING and self._handshake.overdue(now):
            if self._handshake.flushed_at is None:
                sentence = stranger_sentence(self.device, START_LIMIT, talks=self.monitor.talks)
            else:
                sentence = restless_sentence(self.device, START_LIMIT)
            self._lose(sentence, now)

    def _check_strokes(self, now: float) -> None:
        """Ends what is under way with a robot that talks but does not say where it stands."""
        unread, limit = self.monitor.unread_time(now), self.monitor.longest_unread
        if unread > limit and self.robot is not RobotState.PAUSED:
            self._fault(unread_sentence(unread, limit, self.monitor.unread_strokes, self._place), now)

    def _check_stop(self, now: float) -> None:
        try:
            self._stop.check(now, still=self.monitor.stands_still(now), may_send=not self._hung_up)
        except RobotError as error:
            self.hung_up(error.sentence, now)

    def _send_stop(self, now: float) -> None:
        try:
            self._stop.send(now)
        except RobotError as error:
            self.hung_up(error.sentence, now)

    def _stop_by_itself(self, now: float) -> None:
        is_sent = True
        try:
            self._gate.stop()
        except RobotError as error:
            is_sent = False
            self.hung_up(error.sentence, now)
        self.stop("the program", now, is_sent=is_sent)

    def _fault(self, sentence: str, now: float) -> None:
        self._drop_run()
        latched = self.robot in (RobotState.STOPPING, RobotState.STOPPED)
        self._stop.begin(now, text=self._stop.text if latched else None, cause=sentence)
        self.last_error = sentence
        robot = RobotState.STOPPING if latched else RobotState.FAULT
        self.become(sentence, self._stop.describe(robot), robot=robot)
        self._send_stop(now)

    def _lose(self, sentence: str, now: float) -> None:
        if self.link is LinkState.LOST:
            return
        robot = RobotState.FAULT if self._is_busy else self.robot
        if robot in (RobotState.ARMED, RobotState.DISARMED, RobotState.DONE):
            robot = RobotState.UNKNOWN
        begun = robot is RobotState.FAULT is not self.robot
        if begun:
            self._stop.begin(now, cause=without_remedy(sentence))
        self._drop_run()
        self.monitor.idle_lines = 0
        self.last_error = sentence
        self.become(sentence, sentence, link=LinkState.LOST, robot=robot)
        if begun and not self._hung_up:
            self._send_stop(now)

    def _require(self, what: str, *states: RobotState, remedy: str) -> None:
        """Refuses what needs a message of its own, unless link, robot and wire are ready for it.

        Raises:
            StateError: with what is in its way, and the remedy.
        """
        self.require_link(what)
        self.require_robot(*states, remedy=remedy)
        self._require_free()

    def _require_free(self) -> None:
        """Refuses a second message while one is in flight; only a stop may overtake it.

        Raises:
            StateError: the robot has not done with the message that was sent last.
        """
        if self._delivery is not None:
            raise StateError(
                "The robot is still busy with the message that was sent last. Wait until it is done, or stop "
                "the robot."
            )

    # What the robot is busy with

    @property
    @abstractmethod
    def _place(self) -> str:
        """Where the run under way is, for a person, or empty."""

    @abstractmethod
    def _describe_stop(self, by: str) -> str:
        """Says who stops the robot, in a run also at which time."""

    @abstractmethod
    def _drop_run(self) -> None:
        """Gives up what is under way."""
