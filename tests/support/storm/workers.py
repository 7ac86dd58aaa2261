"""Jobs that are started and cancelled, with a ledger of what was acknowledged."""

from __future__ import annotations

import random
from dataclasses import dataclass, field

from tests.support.storm.actor import Actor
from tests.support.studio_process import StudioProcess

START, CANCEL = "job start", "job cancel"
OPTIMISED, SIMULATED = "s-gait", "s-gait-manual-0"
ENDED = {"done", "infeasible", "failed", "cancelled", "interrupted"}
MOST_OPEN = 3
"""Jobs that are on or wait at one time."""


@dataclass
class Jobs:
    """The jobs that were acknowledged, with the state that each was seen in last."""

    states: dict[str, str] = field(default_factory=dict)

    def open(self) -> list[str]:
        """Jobs that were not seen to have ended."""
        return [job for job, state in self.states.items() if state not in ENDED]

    def compare(self, studio: StudioProcess) -> int:
        """Looks after a kill: every job is there, and none is on.

        Returns:
            How many the kill interrupted.
        """
        listed = studio.ask("GET", "/api/jobs").content["jobs"]
        assert [job for job in listed if job["state"] not in ENDED] == []
        interrupted = 0
        for job, state in self.states.items():
            content = studio.ask("GET", f"/api/jobs/{job}").content
            assert content["state"] in ({state} if state in ENDED else ENDED), (job, state, content)
            # What was cancelled, or is infeasible, may have a result that says so.
            has_result = content["result"] is not None
            assert has_result or content["state"] != "done", content
            assert not has_result or content["state"] != "interrupted", content
            interrupted += content["state"] == "interrupted"
        # Each is looked at after one kill; what it is then, it stays.
        self.states.clear()
        return interrupted


class Worker(Actor):
    """Starts jobs, looks at them, and cancels some.

    Args:
        studio: which one.
        jobs: the ledger.
        dice: what is done next.
    """

    def __init__(self, studio: StudioProcess, jobs: Jobs, dice: random.Random) -> None:
        super().__init__(studio)
        self._jobs, self._dice = jobs, dice

    def act(self) -> None:
        """Starts or cancels a job, then looks at all that are open."""
        open_jobs = self._jobs.open()
        if len(open_jobs) >= MOST_OPEN or (open_jobs and self._dice.random() < 0.3):
            job = self._dice.choice(open_jobs)
            assert self.change(CANCEL, "DELETE", f"/api/jobs/{job}").status == 200
        else:
            kind, gait = self._dice.choice((("optimise", OPTIMISED), ("simulate", SIMULATED)))
            answer = self.change(START, "POST", "/api/jobs", {"kind": kind, "gait": gait})
            # One simulation of a gait at a time.
            assert answer.status in ((202, 409) if kind == "simulate" else (202,)), answer
            if answer.status == 202:
                self._jobs.states[answer.content["id"]] = "queued"
        for job in self._jobs.open():
            self._jobs.states[job] = self.look(f"/api/jobs/{job}")["state"]
