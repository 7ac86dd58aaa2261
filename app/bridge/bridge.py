"""The robot bridge: runs the robot state machine on a real line, with its threads.

Two threads live here while a line is open: the transport's reader, which only queues what arrives, and
the worker, which feeds the session, keeps its deadlines and tells the subscribers. Stop needs neither.
"""

import logging
import threading
import time
from collections.abc import Callable
from functools import partial

from app.bridge.inbox import MOST_BYTES, Bytes, HungUp, Inbox, Item, LeftOut
from app.bridge.jog import JogPlan
from app.bridge.state_machine import RobotStateMachine
from app.bridge.states import IN_RUN, Direction, LinkState, RobotSnapshot, RunPlan, Transition
from app.bridge.stop_confirmation import STOP_LIMIT
from app.bridge.transport import Transport
from app.bridge.write_gate import Clock, Log, WriteGate
from core.errors import RobotError, StateError
from core.robot.model import RobotModel
from core.running_time import Deadline, RunningClock

logger = logging.getLogger(__name__)

TICK = 0.05
"""Longest time between two looks at the deadlines, s."""

LATE = 0.25
"""A program that looks so much later than the tick was kept from running; the robot may have spoken, s."""

TELEMETRY_PERIOD = 0.05
"""Subscribers hear of strokes at most 20 times a second."""

Callback = Callable[[RobotSnapshot], None]
Opener = Callable[[str, Callable[[bytes], None], Callable[[str], None]], Transport]


class RobotBridge:
    """The robot for the rest of the program; every method may be called from any thread.

    Args:
        log: told of all bytes both ways, with the time of `clock`; must return at once.
        clock: seconds that only grow, for the record, and for the deadlines as far as the program ran. One
            that goes on while the machine is suspended shows that time too.
        tick: longest time between two looks at the deadlines, s of real time.
        opener: opens a line.
    """

    def __init__(
        self,
        log: Log = lambda direction, data, when: None,
        *,
        clock: Clock = time.monotonic,
        tick: float = TICK,
        opener: Opener = Transport,
    ) -> None:
        self._log = log
        self._clock = clock
        self._tick = tick
        self._opener = opener
        self._gate = WriteGate(log, clock)
        self._running = RunningClock(clock, tick + LATE)
        self._machine = RobotStateMachine(self._gate, clock)
        self._lock = threading.Lock()
        self._handshake = threading.Lock()
        self._leaving = threading.Lock()
        self._inbox = Inbox()
        self._subscribers: tuple[Callback, ...] = ()
        self._transport: Transport | None = None
        self._lines_opened = 0
        self._told_revision, self._told_readings, self._told_at = -1, -1, 0.0
        self._closing = False
        self._worker = threading.Thread(target=self._work, name="robot bridge", daemon=True)
        self._worker.start()

    @property
    def snapshot(self) -> RobotSnapshot:
        """Everything there is to show, now."""
        with self._lock:
            return self._machine.snapshot()

    @property
    def transitions(self) -> tuple[Transition, ...]:
        """The last thousand changes of state with their causes."""
        with self._lock:
            return tuple(self._machine.transitions)

    def subscribe(self, callback: Callback) -> Callable[[], None]:
        """Calls `callback` from the worker's thread, soon and on each change, on telemetry at most at 20 Hz.

        The callback must return at once; it may use every verb but `disconnect` and `close`.

        Returns:
            A function that ends the subscription.
        """
        self._subscribers = (*self._subscribers, callback)
        self._told_revision = -1
        self._inbox.wake()

        def unsubscribe() -> None:
            self._subscribers = tuple(c for c in self._subscribers if c is not callback)

        return unsubscribe

    def connect(self, device: str) -> None:
        """Opens the line; the link is ready when the robot answers, which the snapshot tells.

        Args:
            device: path of a serial device, or `socket://HOST:PORT`.

        Raises:
            StateError: a robot is connected.
            RobotError: the device is absent or busy.
        """
        with self._handshake:
            self._require_free()
            self._lines_opened += 1
            transport = self._open(device, self._lines_opened)
            with self._lock:
                self._transport = transport
                self._gate.attach(transport)
                self._machine.opened(device, self._now())
        self._inbox.wake()

    def disconnect(self) -> None:
        """Closes the line; a run under way is stopped first, and waited for as long as a ramp may last.

        A second caller waits for the first and leaves any newly opened line alone.
        """
        line = self._lines_opened
        with self._leaving:
            if line == self._lines_opened:
                self._leave()

    def close(self) -> None:
        """Disconnects and ends the bridge; doing it twice, or twice at once, does no harm."""
        self.disconnect()
        with self._leaving:
            self._closing = True
        self._inbox.wake()
        self._worker.join()

    def arm(self, by: str) -> None:
        """Lets the robot be moved by `send` and `reset`.

        Raises:
            StateError: the robot is not disarmed or done.
        """
        self._do(lambda now: self._machine.arm(by))

    def disarm(self, by: str, why: str = "") -> None:
        """Takes back the permission to move an armed robot; does nothing in any other state.

        Args:
            by: who does it.
            why: a sentence for whoever looks at the robot then.
        """
        self._do(lambda now: self._machine.disarm(by, why))

    def send(self, plan: RunPlan, by: str, run_id: str | None = None) -> str:
        """Moves to the start pose slowly, then through the approved waypoints.

        Args:
            plan: what a person approved.
            by: who sends it.
            run_id: name for the run, so that its record can begin before the first byte; made up if None.

        Returns:
            The run's name.

        Raises:
            StateError: the robot is not armed, or the plan was edited after its approval.
            InputError: a stroke cannot be sent.
        """
        with self._lock:
            name = self._machine.send(plan, by, self._now(), run_id)
        self._inbox.wake()
        return name

    def pause(self, by: str) -> None:
        """Lets the run go on to the next pose with all feet down and wait there.

        Raises:
            StateError: no run is moving.
        """
        self._do(lambda now: self._machine.pause(by))

    def resume(self, by: str) -> None:
        """Goes on with a paused run.

        Raises:
            StateError: no run is paused, or a motor was moved meanwhile.
        """
        self._do(lambda now: self._machine.resume(by, now))

    def stop(self, by: str) -> None:
        """Sends the stop at once and latches it; never refuses, and may be repeated."""
        reason = None
        try:
            self._gate.stop()
        except RobotError as error:
            reason = error.sentence
        with self._lock:
            self._latch_stop(by, reason)

    def try_stop(self, by: str) -> Callable[[], None] | None:
        """Does what `stop` does as far as that needs no waiting, for a thread that must not wait.

        Unless a message is just going out, the stop is on the wire when this returns.

        Returns:
            What is left to do, by a thread that may wait; None if nothing is.
        """
        reason = None
        try:
            if not self._gate.try_stop():
                return partial(self.stop, by)
        except RobotError as error:
            reason = error.sentence
        if not self._lock.acquire(blocking=False):
            return partial(self._latch_sent_stop, by, reason)
        try:
            self._latch_stop(by, reason)
        finally:
            self._lock.release()
        return None

    def clear(self, by: str) -> None:
        """Lets a stopped robot go, after replacing its target by where it stands.

        No motor moves, unless one stands outside 0.5 to 19.5 mm by nearly 1 mm: the sentence names it.

        Raises:
            StateError: nothing is stopped, the robot still moves, or may yet confirm the stop in time.
        """
        self._do(lambda now: self._machine.clear(by, now))

    def reset(self, by: str) -> None:
        """Sends every motor to 0.5 mm.

        Raises:
            StateError: the robot is not armed.
        """
        self._do(lambda now: self._machine.reset(by, now))

    def jog(self, plan: JogPlan, by: str) -> None:
        """Moves motors by steps that a person chose.

        Raises:
            StateError: the robot is not armed, does not stand still, or stands elsewhere than thought.
            InputError: a stroke cannot be sent.
        """
        self._do(lambda now: self._machine.jog(plan, by, now))

    def test_motors(self, model: RobotModel, by: str) -> None:
        """Tests one motor after the other by a small move out and back; the snapshot has the verdicts.

        Raises:
            StateError: the robot is not armed, or has not told its strokes.
        """
        self._do(lambda now: self._machine.test_motors(model, by, now))

    def end_early(self) -> None:
        """Ends a jog after the move that is on, a motor test after its motor; the robot stays armed."""
        self._do(lambda now: self._machine.end_early())

    # Inside

    def _latch_sent_stop(self, by: str, reason: str | None) -> None:
        with self._lock:
            self._latch_stop(by, reason)

    def _latch_stop(self, by: str, reason: str | None) -> None:
        now = self._running()
        if reason is not None:
            self._machine.hung_up(reason, now)
        self._machine.stop(by, now, is_sent=reason is None)
        self._now()
        self._inbox.wake()

    def _do(self, wish: Callable[[float], None]) -> None:
        with self._lock:
            wish(self._now())
        self._inbox.wake()

    def _now(self) -> float:
        """The time in which the program ran; tells the machine of time in which it did not."""
        away = self._running.look()
        now = self._running()
        if away:
            self._machine.away(away, now)
        return now

    def _hear(self, data: bytes) -> None:
        self._log(Direction.FROM_ROBOT, data, self._clock())
        self._inbox.put(Bytes(data, self._running()))

    def _require_free(self) -> None:
        with self._lock:
            if self._machine.link not in (LinkState.DISCONNECTED, LinkState.LOST):
                raise StateError(f"{self._machine.device} is connected. Disconnect it first.")
            self._close_line()

    def _open(self, device: str, line: int) -> Transport:
        def report(reason: str) -> None:
            self._inbox.put(HungUp(line, reason))

        try:
            return self._opener(device, self._hear, report)
        except RobotError as error:
            with self._lock:
                self._machine.refused(device, error.sentence)
            self._inbox.wake()
            raise

    def _leave(self) -> None:
        if self.snapshot.robot in IN_RUN:
            self.stop("disconnect")
        self._await_stop()
        with self._lock:
            self._close_line()
            if self._machine.link is not LinkState.DISCONNECTED:
                self._machine.closed()
        self._inbox.wake()

    def _close_line(self) -> None:
        transport, self._transport = self._transport, None
        self._gate.attach(None)
        if transport is not None:
            transport.close()

    def _await_stop(self) -> None:
        deadline = Deadline(STOP_LIMIT, self._clock)
        stop_confirmed = threading.Event()

        def look(_: RobotSnapshot | None = None) -> None:
            with self._lock:
                if not self._machine.awaits_stop:
                    stop_confirmed.set()

        unsubscribe = self.subscribe(look)
        look()
        while not stop_confirmed.is_set() and not deadline.is_over:
            stop_confirmed.wait(self._tick)
        unsubscribe()

    def _work(self) -> None:
        while not self._closing:
            items = self._inbox.take(self._tick)
            with self._lock:
                self._now()
                was_away, transport = self._machine.was_away, self._transport
            if was_away and transport is not None:
                # What waited while the program did not run is read before anything is judged.
                transport.wait_read()
                items += self._inbox.take(0.0, MOST_BYTES)
            with self._lock:
                self._now()
                for item in items:
                    self._feed(item)
                if was_away:
                    self._machine.listen_anew(self._running())
                self._machine.tick(self._inbox.judged_until(self._running()))
            self._tell()

    def _feed(self, item: Item) -> None:
        if self._machine.link is LinkState.DISCONNECTED:
            return
        if isinstance(item, Bytes):
            self._machine.received(item.data, item.time)
        elif isinstance(item, LeftOut):
            self._machine.flooded(self._running())
        elif item.line == self._lines_opened:
            self._machine.hung_up(item.reason, self._running())

    def _tell(self) -> None:
        now = self._clock()
        with self._lock:
            revision, readings = self._machine.revision, self._machine.monitor.readings
            fresh = readings != self._told_readings and now - self._told_at >= TELEMETRY_PERIOD
            if revision == self._told_revision and not fresh:
                return
            self._told_revision, self._told_readings, self._told_at = revision, readings, now
            snapshot = self._machine.snapshot()
        for callback in self._subscribers:
            try:
                callback(snapshot)
            except Exception:
                logger.exception("A subscriber of the robot bridge failed.")
