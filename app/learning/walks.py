"""From trials to the gaits that physics is fitted to: what the robot did, and exactly what it was sent."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from app.common.names import free_name
from app.trials.planned import sent_problem
from app.trials.record import TrialRecord
from core.arrays import Floats
from core.errors import InputError
from core.identification.learning import Walk
from core.physics.problem import SimulationProblem
from core.trials.displacement import Displacement, track_displacement, walk_of_trials

LEAST_WAY = 0.003
"""A plan whose feet go no further has no direction, m."""


@dataclass(frozen=True, eq=False)
class SentTrial:
    """A trial with what the robot was sent.

    Args:
        record: the trial.
        sent: as kept with it (`app.runs.plan_json.sent_content`); None where it is not known.
    """

    record: TrialRecord
    sent: Mapping[str, Any] | None


def walks_of(trials: Sequence[SentTrial]) -> tuple[Walk, ...]:
    """The gaits of some trials; trials of the same waypoints, as often, are of one gait.

    Raises:
        InputError: a trial is an example made by simulation, it is not known what was sent, its gait goes
            nowhere, or they are of several robots.
    """
    groups: dict[tuple[str, int, float], list[SentTrial]] = {}
    problems: dict[tuple[str, int, float], SimulationProblem] = {}
    for trial in trials:
        problem, laps = _sent(trial)
        key = (problem.waypoints.content_hash, laps, trial.record.expected)
        problems.setdefault(key, problem)
        groups.setdefault(key, []).append(trial)
    if len({problem.model.name for problem in problems.values()}) > 1:
        raise InputError("The trials are of different robots; choose those of one.", "trials")
    walks: list[Walk] = []
    for key, group in groups.items():
        walks.append(_walk(group, problems[key], key[1], {walk.measured.name for walk in walks}))
    return tuple(walks)


def heading_of(feet: Floats, name: str) -> float:
    """Direction of a motion's feet from first to last, rad.

    Args:
        feet: (n, feet, 2) m.
        name: of the trial or file, for messages.

    Raises:
        InputError: they go nowhere.
    """
    x, y = (feet[-1] - feet[0]).mean(axis=0)
    if math.hypot(x, y) < LEAST_WAY:
        raise InputError(
            f"What was planned of {name} goes {math.hypot(x, y) * 1000:.1f} mm, so it has no direction. "
            "Leave it out.",
            "trials",
        )
    return math.atan2(y, x)


def _sent(trial: SentTrial) -> tuple[SimulationProblem, int]:
    record = trial.record
    if record.content.get("is_example", False):
        raise InputError(
            f"“{record.content['name']}” is an example made by simulation: no robot did it, so nothing "
            "can be learned from it. Leave it out.",
            "trials",
        )
    if trial.sent is None or record.planned is None:
        raise InputError(
            f"The waypoints sent in the trial “{record.content['name']}” are not known. Leave the trial out, "
            "or add it again with its run or gait.",
            "trials",
        )
    return sent_problem(dict(trial.sent)), record.planned.laps


def _walk(group: Sequence[SentTrial], problem: SimulationProblem, laps: int, taken: set[str]) -> Walk:
    content = group[0].record.content
    step_cm = content["expected_cm"] / content["iterations"]
    kind = content["gait_name"] or content["name"]
    heading = heading_of(problem.plan.feet_world[..., :2], content["name"])
    measured = walk_of_trials(
        free_name(f"{kind}, {step_cm:.2g} cm", taken),
        kind,
        group[0].record.expected,
        [_displacement(trial.record, heading) for trial in group],
    )
    return Walk(measured, problem, laps, heading)


def _displacement(record: TrialRecord, heading: float) -> Displacement:
    """The track's, whose frame the plan lies in as its first frame says."""
    return track_displacement(record.track, heading + record.alignment.turn, record.expected)
