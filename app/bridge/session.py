"""The bridge's state machine, without threads, clocks or ports: lines, ticks and wishes in, messages out.

Whoever drives it serialises the calls and says what time it is. Link and robot have a state each,
and each change has its cause.
"""

from __future__ import annotations

import uuid

from app.bridge.delivery import (
    ARRIVAL_MM,
    MOVE,
    PATIENCE,
    RESTART,
    START_PATIENCE,
    STORE,
    Delivery,
    Stage,
    arrival_deadline,
)
from app.bridge.gate import Gate
from app.bridge.ledger import Ledger
from app.bridge.run import Move, Run
from app.bridge.states import IN_RUN, LinkState, RobotSnapshot, RobotState, RunPhase, RunPlan
from app.bridge.stopping import StopOutcome, Stopping
from app.bridge.watch import Watch
from app.bridge.words import (
    CLEARING,
    CONNECTING,
    NOT_CONNECTED,
    NOT_STOPPED,
    RESTARTED,
    SENTENCES,
    displaced_sentence,
    silent_sentence,
    stranger_sentence,
)
from core.errors import RobotError, StateError
from core.wire import (
    HIGHEST_MM,
    LOWEST_MM,
    MOTORS,
    RESET_MM,
    encode_release,
    encode_reset,
    encode_waypoint,
)
from core.wire_lines import Line, LineReader, SetupFinished, SetupMoving

SILENCE_LIMIT = 4.0
"""An answering robot is never silent longer than 2.5 s (PROTOCOL 5.4), s."""

START_LIMIT = 15.0
"""A board that restarts when its port is opened is up after 8 s, s."""


class Session(Ledger):
    """One robot on one link.

    Args:
        gate: the way out.
    """

    def __init__(self, gate: Gate) -> None:
        super().__init__()
        self._gate = gate
        self.device: str | None = None
        self._stopping: Stopping | None = None
        self._held = False
        self._hung_up = False
        self._run: Run | None = None
        self._delivery: Delivery | None = None
        self._clearing = False
        self._permit = -1
        self._opened_at = 0.0
        self._reader = LineReader()
        self.watch = Watch(0.0)

    @property
    def in_run(self) -> bool:
        """Whether a run or a reset is under way."""
        return self.robot in IN_RUN

    def snapshot(self, now: float) -> RobotSnapshot:
        """Everything there is to show."""
        strokes = self.watch.strokes_mm
        return RobotSnapshot(
            link=self.link,
            robot=self.robot,
            sentence=self.sentence,
            strokes=None if strokes is None else tuple(s / 1000.0 for s in strokes),
            run=None if self._run is None else self._run.progress(now),
            stop_text=None if self._stopping is None else self._stopping.text,
            unknown_lines=self.watch.unknown_lines,
            device=self.device,
            last_error=self.last_error,
            measured_scan=self.watch.longest_scan,
        )

    # The link

    def opened(self, device: str, now: float) -> None:
        """A line was opened."""
        self.device = device
        self._opened_at = now
        self._hung_up = False
        self._reader = LineReader()
        self.watch = Watch(now)
        self.become(now, f"{device} was opened.", CONNECTING, link=LinkState.CONNECTING)

    def refused(self, device: str, reason: str) -> None:
        """A line could not be opened."""
        self.device = device
        self.last_error = reason
        self.revision += 1

    def closed(self, now: float) -> None:
        """The line was closed on purpose."""
        self._drop_run(now)
        self.become(
            now,
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
        self.watch.heard(now)
        for line in self._reader.feed(data):
            self.watch.see(line, now)
            self._see(line, now)

    def tick(self, now: float) -> None:
        """Time has passed: deadlines, silence, standing still."""
        if self.link in (LinkState.READY, LinkState.CONNECTING):
            self._check_silence(now)
        if self._delivery is not None and self.watch.strokes_mm is not None:
            self._delivery.check(now, self.watch.strokes_mm)
            self._settle_delivery(now)
        if self.robot is RobotState.STOPPING:
            self._check_stop(now)

    # Wishes

    def arm(self, by: str, now: float) -> None:
        """Lets the robot be moved."""
        self.require_link("armed")
        self.require_robot(RobotState.DISARMED, RobotState.DONE, remedy="Only a disarmed robot can be armed.")
        self._permit = self._gate.permit()
        self.become(now, f"Armed by {by}.", SENTENCES[RobotState.ARMED], robot=RobotState.ARMED)

    def send(self, plan: RunPlan, by: str, now: float, run_id: str | None = None) -> str:
        """Begins a run and returns its name, which is made up unless given."""
        self.require_link("sent a plan")
        self.require_robot(RobotState.ARMED, remedy="Arm the robot, then send the plan.")
        run = Run(plan, self._measured(), run_id or uuid.uuid4().hex[:12], by, now)
        self._run = run
        cause = f"Run {run.run_id} sent by {by}."
        self.become(now, cause, SENTENCES[RobotState.MOVING], robot=RobotState.MOVING)
        self._send_next(now)
        return run.run_id

    def reset(self, by: str, now: float) -> None:
        """Sends every motor to 0.5 mm."""
        self.require_link("reset")
        self.require_robot(RobotState.ARMED, remedy="Arm the robot, then reset it.")
        self._run = None
        sentence = f"Every motor goes to {RESET_MM} mm."
        self.become(now, f"Reset by {by}.", sentence, robot=RobotState.MOVING)
        self._deliver(encode_reset(), (RESET_MM,) * MOTORS, RESTART, now)

    def pause(self, by: str, now: float) -> None:
        """Ends the movement at the next pose with all feet down."""
        self.require_robot(RobotState.MOVING, remedy="Only a run that moves can be paused.")
        if self._run is None:
            raise StateError("A reset cannot be paused. Stop it instead.")
        self.become(now, f"Pause by {by}.", SENTENCES[RobotState.PAUSING], robot=RobotState.PAUSING)

    def resume(self, by: str, now: float) -> None:
        """Goes on with a paused run."""
        remedy = "Only a paused run can be resumed."
        self.require_robot(RobotState.PAUSED, RobotState.PAUSING, remedy=remedy)
        waiting = self.robot is RobotState.PAUSED
        if waiting and self._run is not None:
            self._require_in_place(self._run)
        self.become(now, f"Resumed by {by}.", SENTENCES[RobotState.MOVING], robot=RobotState.MOVING)
        if waiting:
            self._send_next(now)

    def stop(self, by: str, now: float) -> None:
        """Latches a stop whose bytes are already out."""
        if self.link is LinkState.DISCONNECTED or self.robot is RobotState.STOPPING:
            return
        if self.robot is RobotState.STOPPED and not self._clearing:
            return
        self._stopping = Stopping(self._describe_stop(by, now), now)
        self._held = True
        self._drop_run(now)
        self.become(now, f"Stop by {by}.", SENTENCES[RobotState.STOPPING], robot=RobotState.STOPPING)

    def clear(self, by: str, now: float) -> None:
        """Replaces what the stopped robot would go on with by where it stands, then lets it go."""
        self.require_link("cleared")
        self.require_robot(RobotState.STOPPED, RobotState.FAULT, remedy="There is nothing to clear.")
        if not self.watch.stands_still(now):
            raise StateError("The robot does not stand still yet. Wait until it does, then clear.")
        held = [min(max(s, LOWEST_MM), HIGHEST_MM) for s in self._measured()]
        self._permit = self._gate.permit()
        self._clearing = True
        self.become(now, f"Clear by {by}.", CLEARING)
        target = tuple(round(s, 4) for s in held)
        self._deliver(encode_waypoint([s / 1000.0 for s in target], 1.0), target, STORE, now)

    # What the robot says

    def _see(self, line: Line, now: float) -> None:
        if isinstance(line, SetupMoving | SetupFinished):
            self._see_restart(now)
        if self._stopping is not None:
            self._stopping.see(line)
        if self.link is not LinkState.READY and self.watch.idle_lines >= 2 and not self._hung_up:
            self._become_ready(now)
        if self._delivery is not None:
            self._delivery.see(line)
            self._settle_delivery(now)

    def _see_restart(self, now: float) -> None:
        if self.link is LinkState.CONNECTING:
            return
        self._fault(RESTARTED, now)
        self._opened_at = now
        self.become(now, "The board restarted.", self.sentence, link=LinkState.CONNECTING)

    def _become_ready(self, now: float) -> None:
        robot, sentence = self.robot, self.sentence
        if self.robot is RobotState.UNKNOWN:
            robot = RobotState.STOPPED if self._held else RobotState.DISARMED
        if robot is not RobotState.STOPPING:
            sentence = SENTENCES[robot]
        self.become(now, "The robot answers.", sentence, link=LinkState.READY, robot=robot)

    def _check_silence(self, now: float) -> None:
        silence = now - self.watch.last_byte
        if self.link is LinkState.READY and silence > SILENCE_LIMIT:
            place = self._run.place if self._run is not None and self.in_run else ""
            self._lose(silent_sentence(silence, SILENCE_LIMIT, place), now)
        elif self.link is LinkState.CONNECTING and now - self._opened_at > START_LIMIT:
            self._lose(stranger_sentence(self.device, START_LIMIT), now)

    def _check_stop(self, now: float) -> None:
        if self._stopping is None:
            return
        match self._stopping.judge(now, still=self.watch.stands_still(now)):
            case StopOutcome.CONFIRMED:
                sentence = SENTENCES[RobotState.STOPPED]
                self.become(now, "The robot stands still.", sentence, robot=RobotState.STOPPED)
            case StopOutcome.REPEAT:
                self._repeat_stop(now)
            case StopOutcome.OVERDUE if self.sentence != NOT_STOPPED:
                self.become(now, "The stop was not confirmed in time.", NOT_STOPPED)
            case _:
                pass

    def _repeat_stop(self, now: float) -> None:
        if self._stopping is not None:
            self._stopping.sent(now)
        try:
            self._gate.stop()
        except RobotError as error:
            self.hung_up(error.sentence, now)

    # Messages on their way

    def _send_next(self, now: float) -> None:
        if self._run is None:
            return
        move: Move = self._run.next_move()
        patience = START_PATIENCE if move.phase is RunPhase.START_POSE else PATIENCE
        self._deliver(move.message, move.target_mm, MOVE, now, patience=patience)

    def _deliver(
        self,
        message: bytes,
        target_mm: tuple[float, ...],
        stages: tuple[Stage, ...],
        now: float,
        *,
        patience: float = PATIENCE,
        early_end: bool = False,
    ) -> None:
        distance = max(abs(t - m) for t, m in zip(target_mm, self._measured(), strict=True))
        deadline = arrival_deadline(distance, patience)
        self._delivery = Delivery(message, target_mm, stages, now, deadline, early_end=early_end)
        self.revision += 1
        try:
            self._gate.write(message, self._permit)
        except RobotError as error:
            self.hung_up(error.sentence, now)

    def _settle_delivery(self, now: float) -> None:
        delivery = self._delivery
        if delivery is None:
            return
        if delivery.failure is not None:
            self._fail(delivery.failure, now)
        elif delivery.arrived:
            self._delivery = None
            if self._clearing:
                self._go_on_clearing(delivery, now)
            else:
                self._go_on_running(now)

    def _fail(self, failure: str, now: float) -> None:
        place = f" {self._run.place[0].upper()}{self._run.place[1:]}." if self._run and self.in_run else ""
        self._fault(f"{failure}{place} Last line: {self.watch.last_line!r:.120}.", now)

    def _go_on_running(self, now: float) -> None:
        run = self._run
        if run is None:
            self.become(now, "Reset done.", SENTENCES[RobotState.ARMED], robot=RobotState.ARMED)
            return
        run.arrive()
        self.revision += 1
        if run.finished:
            run.end(now)
            self._permit = -1
            self.become(
                now, "The last waypoint was reached.", SENTENCES[RobotState.DONE], robot=RobotState.DONE
            )
        elif self.robot is RobotState.PAUSING and run.may_hold:
            self.become(now, "All feet are down.", SENTENCES[RobotState.PAUSED], robot=RobotState.PAUSED)
        else:
            self._send_next(now)

    def _go_on_clearing(self, delivery: Delivery, now: float) -> None:
        if delivery.payload.startswith("p"):
            self._deliver(encode_release(), delivery.target_mm, RESTART, now, early_end=True)
            return
        self._clearing = False
        self._held = False
        self._stopping = None
        self._permit = -1
        self.become(now, "Cleared.", SENTENCES[RobotState.DISARMED], robot=RobotState.DISARMED)

    # Ends

    def _fault(self, sentence: str, now: float) -> None:
        self._drop_run(now)
        self._held = True
        self.last_error = sentence
        robot = self.robot if self.robot in (RobotState.STOPPING, RobotState.STOPPED) else RobotState.FAULT
        self.become(now, sentence, f"{sentence} {SENTENCES[RobotState.FAULT]}", robot=robot)
        self._repeat_stop(now)

    def _lose(self, sentence: str, now: float) -> None:
        if self.link is LinkState.LOST:
            return
        robot = RobotState.FAULT if self.in_run or self._clearing else self.robot
        if robot in (RobotState.ARMED, RobotState.DISARMED, RobotState.DONE):
            robot = RobotState.UNKNOWN
        self._held = self._held or robot is RobotState.FAULT
        self._drop_run(now)
        self.watch.idle_lines = 0
        self.last_error = sentence
        self.become(now, sentence, sentence, link=LinkState.LOST, robot=robot)
        if not self._hung_up and robot is RobotState.FAULT:
            self._repeat_stop(now)

    def _drop_run(self, now: float) -> None:
        self._delivery = None
        self._clearing = False
        self._permit = -1
        if self._run is not None:
            self._run.end(now)

    def _describe_stop(self, by: str, now: float) -> str:
        if self._run is not None and self.in_run:
            return f"stopped at {self._run.elapsed(now):.1f} s by {by}"
        return f"stopped by {by}"

    def _require_in_place(self, run: Run) -> None:
        self.require_link("resumed")
        pairs = zip(run.last_reached_mm, self._measured(), strict=True)
        farthest = max(abs(t - m) for t, m in pairs)
        if farthest > ARRIVAL_MM:
            raise StateError(displaced_sentence(farthest, ARRIVAL_MM))

    def _measured(self) -> tuple[float, ...]:
        if self.watch.strokes_mm is None:
            raise StateError("The robot has not told its strokes yet. Wait for its telemetry.")
        return self.watch.strokes_mm
