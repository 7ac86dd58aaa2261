"""Runs on the emulated robot that are sent, paused and stopped, with a ledger of what was acknowledged."""

from __future__ import annotations

import random
import threading
from dataclasses import dataclass, field

from app.emulator.emulated_robot import EmulatedRobot
from tests.support.storm.actor import Actor
from tests.support.studio_process import StudioProcess, wait_for

CONNECT, ARM, SEND, PAUSE, STOP, CLEAR = "connect", "arm", "send", "pause or resume", "stop", "clear"
RUN = "run under way"
"""Counted with the kinds of action in flight: the robot was in a run when the studio was killed."""
GAIT = "amble-manual-1"
BY = "Ada"
LOOK_SECONDS = 0.02
MOVING = ("moving", "pausing", "paused", "stopping")


@dataclass
class Runs:
    """What is known of runs.

    Args:
        known: ids of the runs that were acknowledged.
        on: the run that was under way when it was looked at last; None for none.
        moving: set as long as a run is under way.
    """

    known: list[str] = field(default_factory=list)
    on: str | None = None
    moving: threading.Event = field(default_factory=threading.Event)

    def compare(self, studio: StudioProcess) -> str | None:
        """Looks after a kill: every run is there, none is on, and nothing is connected.

        Returns:
            How the run ended that was under way.
        """
        view = studio.robot()
        assert (view["link"], view["run"]) == ("disconnected", None), view
        states = {
            line["id"]: line["state"] for line in studio.ask("GET", "/api/runs?most=200").content["runs"]
        }
        assert "running" not in states.values(), states
        lost = [run for run in self.known if run not in states]
        assert lost == [], lost
        ended = None if self.on is None else states[self.on]
        self.known, self.on = [], None
        self.moving.clear()
        return ended


def waypoints_heard(robot: EmulatedRobot) -> int:
    """How many waypoints the robot has taken, once it has read all that is on the line."""
    until = robot.firmware.now + 1.0
    wait_for(lambda: robot.firmware.now > until, "the robot's time passes")
    return sum(message.strokes_mm is not None for message in tuple(robot.firmware.messages))


class Operator(Actor):
    """Connects the robot, arms it, sends runs, and pauses, stops and clears them.

    Args:
        studio: which one.
        runs: the ledger.
        dice: what is done next.
    """

    def __init__(self, studio: StudioProcess, runs: Runs, dice: random.Random) -> None:
        super().__init__(studio)
        self._runs, self._dice = runs, dice
        self._is_connected = False

    def act(self) -> None:
        """What the robot's state allows."""
        if not self._is_connected:
            self._do(CONNECT)
            self._is_connected = True
        view = self.look("/api/robot")
        robot = view["robot"] if view["link"] == "ready" else "unknown"
        self._note(view)
        actions = {
            "disarmed": (ARM,),
            "armed": (SEND,),
            "done": (ARM,),
            "moving": (PAUSE, STOP, "", "", "", ""),
            "paused": (PAUSE, PAUSE, STOP),
            "stopped": (CLEAR,),
            "fault": (STOP,),
        }
        action = self._dice.choice(actions.get(robot, ("",)))
        if action == PAUSE:
            self._do(PAUSE, "resume" if robot == "paused" else "pause")
        elif action:
            self._do(action)
        else:
            threading.Event().wait(LOOK_SECONDS)

    def _note(self, view: dict[str, object]) -> None:
        run = view["run"]
        self._runs.on = run["id"] if isinstance(run, dict) and view["robot"] in MOVING else None
        if self._runs.on is None:
            self._runs.moving.clear()
        else:
            self._runs.moving.set()

    def _do(self, kind: str, verb: str = "") -> None:
        content = {"by": BY, "gait": GAIT} if kind == SEND else {"by": BY}
        answer = self.change(kind, "POST", f"/api/robot/{verb or kind}", content)
        # Between a look and an action the run may have ended, or come to its pause.
        assert answer.status in (200, 409), answer
        if answer.status == 200 and kind == SEND:
            self._runs.known.append(answer.content["run"]["id"])
            self._note(answer.content)
