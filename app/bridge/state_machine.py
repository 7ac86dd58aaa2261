"""The bridge's state machine, without threads, clocks or ports: lines, ticks and requests in, messages out.

Whoever drives it serialises the calls and says what time it is. Link and robot have a state each,
and each change has its cause.
"""

import itertools
import uuid

from app.bridge.delivery import (
    MOVE,
    PATIENCE,
    RESTART,
    START_PATIENCE,
    STORE,
    Delivery,
    Stage,
    arrival_deadline,
)
from app.bridge.jog import Jog, JogPlan
from app.bridge.link import RobotLink
from app.bridge.messages import SENTENCES, away_sentence, clearing_sentence, words_of
from app.bridge.motor_test import MotorTest
from app.bridge.run import Move, Run
from app.bridge.states import RobotSnapshot, RobotState, RunPhase, RunPlan
from app.bridge.telemetry import SILENCE_LIMIT, STALE_TIME
from app.bridge.write_gate import Clock, MessageKind, WriteGate
from core.errors import RobotError, StateError
from core.robot.model import RobotModel
from core.wire.lines import Line
from core.wire.messages import (
    HIGHEST_MM,
    LOWEST_MM,
    MOTORS,
    RESET_MM,
    encode_release,
    encode_reset,
    encode_waypoint,
)

LOOK_TIME = 1.0
"""So long after a long time away a paused run is not resumed: who asked for that did so before, s."""


class RobotStateMachine(RobotLink):
    """One robot on one link.

    Args:
        gate: the way out.
        clock: by which changes and runs are noted, s; `now` is that of the deadlines (see `RobotLink`).
    """

    def __init__(self, gate: WriteGate, clock: Clock) -> None:
        super().__init__(gate, clock)
        self._run: Run | None = None
        self._jog: Jog | None = None
        self._test: MotorTest | None = None
        self._last_test: MotorTest | None = None
        self._permit = -1
        self._away_until = 0.0
        self._numbers = itertools.count(1)

    def snapshot(self) -> RobotSnapshot:
        """Everything there is to show."""
        strokes = self.monitor.strokes_mm
        return RobotSnapshot(
            link=self.link,
            robot=self.robot,
            sentence=self.sentence,
            strokes=None if strokes is None else tuple(s / 1000.0 for s in strokes),
            run=None if self._run is None else self._run.progress(),
            stop_text=self._stop.text,
            unknown_lines=self.monitor.unknown_lines,
            device=self.device,
            last_error=self.last_error,
            measured_scan=self.monitor.longest_scan,
            number=next(self._numbers),
            jog=None if self._jog is None else self._jog.progress(),
            motor_test=None if self._last_test is None else self._last_test.progress(),
        )

    def tick(self, now: float) -> None:
        """Time has passed: silence, standing still, deadlines."""
        super().tick(now)
        if self._delivery is not None and self.monitor.strokes_mm is not None:
            self._delivery.check(now, self.monitor.strokes_mm)
            self._finish_delivery(now)

    def away(self, seconds: float, now: float) -> None:
        """The program did not run for so long, s: a run goes on by itself after a short time only."""
        self._note_away(seconds, now)
        if self.was_away:
            if self._delivery is not None:
                self._delivery.miss_lines()
            if self._jog is not None:
                self._jog.end_early()
        cause = away_sentence(seconds)
        # A motor test judges by when the robot stops; what it saw late says nothing of a motor.
        if seconds > (SILENCE_LIMIT if self._test is None else STALE_TIME):
            self._come_back(cause, seconds, now)
        elif self.in_run:
            self.become(cause, self.sentence)

    def _come_back(self, cause: str, seconds: float, now: float) -> None:
        """After a long time away nothing goes on but to the next pose for a pause."""
        run = self._run
        if self.robot is RobotState.ARMED:
            self.disarm("the program", cause)
        elif self._test is not None or self._clearing:
            self._away_cause = cause
            self._stop_by_itself(now)
        elif self.robot is RobotState.PAUSED:
            self._away_until = now + LOOK_TIME
            self.become(cause, f"{cause} {SENTENCES[RobotState.PAUSED]}")
        elif self.in_run and run is not None:
            self._away_cause = cause
            if run.may_pause_after(seconds):
                self.become(cause, f"{cause} {SENTENCES[RobotState.PAUSING]}", robot=RobotState.PAUSING)
            else:
                self._stop_by_itself(now)
        elif self.in_run:  # a jog or a reset, of which nothing more is sent
            self.become(cause, self.sentence)

    def listen_anew(self, now: float) -> None:
        """The bytes that waited are taken, and what they decided is done."""
        self._begin_anew(now)
        self._finish_delivery(now)
        if self._delivery is not None:
            self._delivery.miss_lines()

    # Wishes

    def arm(self, by: str) -> None:
        """Lets the robot be moved."""
        self._require(
            "armed", RobotState.DISARMED, RobotState.DONE, remedy="Only a disarmed robot can be armed."
        )
        self._permit = self._gate.permit()
        self.become(f"Armed by {by}.", SENTENCES[RobotState.ARMED], robot=RobotState.ARMED)

    def disarm(self, by: str, why: str = "") -> None:
        """Takes back the permission to move an armed robot; does nothing in any other state.

        Args:
            by: who does it.
            why: a sentence for whoever looks at the robot then.
        """
        if self.robot is RobotState.ARMED:
            self._permit = -1
            sentence = f"{why} {SENTENCES[RobotState.DISARMED]}".strip()
            self.become(f"Disarmed by {by}.", sentence, robot=RobotState.DISARMED)

    def send(self, plan: RunPlan, by: str, now: float, run_id: str | None = None) -> str:
        """Begins a run and returns its name, which is made up unless given."""
        self._require("sent a plan", RobotState.ARMED, remedy="Arm the robot, then send the plan.")
        run = Run(plan, self._measured_now(now), run_id or uuid.uuid4().hex[:12], by, self._clock)
        self._run = run
        self._away_cause = ""
        cause = f"Run {run.run_id} sent by {by}."
        self.become(cause, SENTENCES[RobotState.MOVING], robot=RobotState.MOVING)
        self._send_next(now)
        return run.run_id

    def reset(self, by: str, now: float) -> None:
        """Sends every motor to 0.5 mm."""
        self._require("reset", RobotState.ARMED, remedy="Arm the robot, then reset it.")
        self._measured_now(now)
        self._run = None
        sentence = f"Every motor goes to {RESET_MM} mm."
        self.become(f"Reset by {by}.", sentence, robot=RobotState.MOVING)
        self._deliver(encode_reset(), (RESET_MM,) * MOTORS, RESTART, now, kind=MessageKind.RESET)

    def jog(self, plan: JogPlan, by: str, now: float) -> None:
        """Moves motors by steps that a person chose, from where an armed robot stands still."""
        self._require("jogged", RobotState.ARMED, remedy="Arm the robot, then jog it.")
        if not self.monitor.stands_still(now):
            raise StateError("The robot does not stand still yet. Wait until it does, then jog it.")
        self._jog = Jog(plan, self._measured(), by)
        self._run = None
        self.become(f"Jog by {by}: {plan.text}.", f"Jog: {plan.text}.", robot=RobotState.MOVING)
        self._send_jog(now)

    def test_motors(self, model: RobotModel, by: str, now: float) -> None:
        """Moves one motor after the other out and back, and tells what is wrong with each."""
        self._require("tested", RobotState.ARMED, remedy="Arm the robot, then test its motors.")
        self._measured_now(now)
        self._test = self._last_test = MotorTest(model, by)
        self._run = None
        sentence = "Motor test: one motor after the other moves out and back."
        self.become(f"Motor test by {by}.", sentence, robot=RobotState.MOVING)
        self._go_on_testing(self._test, None, now)

    def end_early(self) -> None:
        """Ends a jog after the move that is on, a motor test after the motor that is being tested."""
        if self._test is not None:
            self._test.end_early()
        if self._jog is not None:
            self._jog.end_early()
        self.revision += 1

    def pause(self, by: str) -> None:
        """Ends the movement at the next pose with all feet down."""
        self.require_robot(RobotState.MOVING, remedy="Only a run that moves can be paused.")
        if self._run is None:
            what = "jog" if self._jog is not None else "motor test" if self._test is not None else "reset"
            raise StateError(f"A {what} cannot be paused. Stop it instead.")
        self.become(f"Pause by {by}.", SENTENCES[RobotState.PAUSING], robot=RobotState.PAUSING)

    def resume(self, by: str, now: float) -> None:
        """Goes on with a paused run."""
        states = (RobotState.PAUSED, RobotState.PAUSING)
        self.require_robot(*states, remedy="Only a paused run can be resumed.")
        waiting = self.robot is RobotState.PAUSED
        if waiting and self._run is not None:
            self._require("resumed", *states, remedy="")
            if now < self._away_until:
                raise StateError("The program has just come back. Look at the robot, then resume once more.")
            self._run.require_in_place(self._measured_now(now))
        self._away_cause = ""
        self.become(f"Resumed by {by}.", SENTENCES[RobotState.MOVING], robot=RobotState.MOVING)
        if waiting:
            self._send_next(now)

    def clear(self, by: str, now: float) -> None:
        """Replaces what the stopped robot would go on with by where it stands, then lets it go."""
        states = (RobotState.STOPPED, RobotState.FAULT, RobotState.STOPPING)
        self._require("cleared", *states, remedy="There is nothing to clear.")
        self._stop.require_confirmed(now)
        if not self.monitor.stands_still(now):
            raise StateError("The robot does not stand still yet. Wait until it does, then clear.")
        measured = self._measured()
        target = tuple(round(min(max(s, LOWEST_MM), HIGHEST_MM), 4) for s in measured)
        self._permit = self._gate.permit()
        self._clearing = True
        sentence = clearing_sentence(measured, target, confirmed=not self._stop.pending)
        self.become(f"Clear by {by}.", sentence)
        message = encode_waypoint([s / 1000.0 for s in target], 1.0)
        self._deliver(message, target, STORE, now, kind=MessageKind.CLEAR)

    # Messages on their way

    def _see(self, line: Line, now: float) -> None:
        super()._see(line, now)
        if self._delivery is not None:
            self._delivery.see(line)
            self._finish_delivery(now)
        elif self._test is not None:
            self._go_on_testing(self._test, line, now)

    def _send_next(self, now: float) -> None:
        run = self._run
        if run is None:
            return
        if run.finished:
            run.end()
            self._permit = -1
            self._away_cause = ""
            self.become("The last waypoint was reached.", SENTENCES[RobotState.DONE], robot=RobotState.DONE)
            return
        move: Move = run.next_move()
        patience = START_PATIENCE if move.phase is RunPhase.START_POSE else PATIENCE
        self._deliver(move.message, move.target_mm, MOVE, now, patience=patience)

    def _send_jog(self, now: float) -> None:
        if self._jog is None:
            return
        move = self._jog.next_move()
        self._deliver(move.message, move.target_mm, MOVE, now, patience=START_PATIENCE, kind=MessageKind.JOG)

    def _deliver(
        self,
        message: bytes,
        target_mm: tuple[float, ...],
        stages: tuple[Stage, ...],
        now: float,
        *,
        patience: float = PATIENCE,
        early_end: bool = False,
        kind: MessageKind = MessageKind.WAYPOINT,
    ) -> None:
        self._require_free()
        measured = self._measured()
        distance = max(abs(t - m) for t, m in zip(target_mm, measured, strict=True))
        self.monitor.expect(distance)
        deadline = arrival_deadline(distance, patience)
        self._delivery = Delivery(message, target_mm, measured, stages, now, deadline, early_end=early_end)
        self.revision += 1
        try:
            self._gate.write(message, self._permit, kind)
        except RobotError as error:
            self.hung_up(error.sentence, now)

    def _finish_delivery(self, now: float) -> None:
        delivery = self._delivery
        if delivery is None or self.was_away:
            return
        if delivery.failure is not None:
            self._fail(delivery.failure, now)
        elif delivery.arrived:
            self._delivery = None
            if self._clearing:
                self._go_on_clearing(delivery, now)
            elif self._test is not None:
                self._go_on_testing(self._test, None, now)
            elif self._jog is not None:
                self._go_on_jogging(self._jog, now)
            else:
                self._go_on_running(now)

    def _fail(self, failure: str, now: float) -> None:
        place = f" {self._place[0].upper()}{self._place[1:]}." if self._place else ""
        self._fault(f"{failure}{place} The robot said last: {words_of(self.monitor.last_line)}.", now)

    def _go_on_running(self, now: float) -> None:
        run = self._run
        if run is None:
            self.become("Reset done.", SENTENCES[RobotState.ARMED], robot=RobotState.ARMED)
            return
        run.arrive()
        self.revision += 1
        is_over = run.finished and not self._away_cause
        if self.robot is RobotState.PAUSING and run.may_hold and not is_over:
            sentence = f"{self._away_cause} {SENTENCES[RobotState.PAUSED]}".strip()
            self.become("All feet are down.", sentence, robot=RobotState.PAUSED)
        else:
            self._send_next(now)

    def _go_on_jogging(self, jog: Jog, now: float) -> None:
        jog.arrive()
        self.revision += 1
        if jog.finished:
            self._jog = None
            self.become(jog.end_words, SENTENCES[RobotState.ARMED], robot=RobotState.ARMED)
        else:
            self._send_jog(now)

    def _go_on_testing(self, test: MotorTest, line: Line | None, now: float) -> None:
        before = test.progress()
        try:
            order = test.advance(line)
        except RobotError as error:
            return self._fail(error.sentence, now)
        if order is not None:
            target = order.target_mm or self._measured()
            self._deliver(order.message, target, order.stages, now, kind=MessageKind.TEST)
        elif test.finished:
            self._test = None
            self.become(test.end_words, SENTENCES[RobotState.ARMED], robot=RobotState.ARMED)
        self.revision += test.progress() != before

    def _go_on_clearing(self, delivery: Delivery, now: float) -> None:
        if delivery.payload.startswith("p"):
            self._deliver(
                encode_release(), delivery.target_mm, RESTART, now, early_end=True, kind=MessageKind.CLEAR
            )
            return
        self._clearing = False
        self._stop.lift()
        self._permit = -1
        self.become("Cleared.", SENTENCES[RobotState.DISARMED], robot=RobotState.DISARMED)

    # Ends

    @property
    def _place(self) -> str:
        work = self._test or self._jog or self._run
        return work.place if work is not None and self.in_run else ""

    def _drop_run(self) -> None:
        self._away_cause = ""
        self._delivery = None
        self._jog = None
        if self._test is not None:
            self._test.end()
            self._test = None
        self._clearing = False
        self._permit = -1
        if self._run is not None:
            self._run.end()

    def _describe_stop(self, by: str) -> str:
        if self._run is not None and self.in_run:
            return f"stopped at {self._run.elapsed:.1f} s by {by}"
        return f"stopped by {by}"

    def _measured(self) -> tuple[float, ...]:
        if self.monitor.strokes_mm is None:
            raise StateError("The robot has not reported its strokes yet. Wait for its telemetry.")
        return self.monitor.strokes_mm

    def _measured_now(self, now: float) -> tuple[float, ...]:
        if now - self.monitor.last_reading > STALE_TIME:
            raise StateError(
                f"The robot has not reported its strokes for more than {STALE_TIME} s. Wait for its "
                "telemetry; if none comes, stop the robot and look at its cable."
            )
        return self._measured()
