"""Presolve: proofs from the bounds alone that no motion exists, each with its sentence."""

from collections.abc import Iterator

import numpy as np

from core.arrays import Bools, Floats
from core.gait.held_feet import feet_words
from core.motion.contact_timeline import Swing
from core.motion.support_polygon import GRAVITY, stability_margins
from core.problem.initial_guess import problem_swings, rise_times
from core.problem.motion_problem import (
    CYLINDER,
    GROUNDED_HEIGHT,
    Boundary,
    MotionProblem,
    RestPose,
    Workspace,
    missing_support,
)
from core.problem.swing_height import is_held, rest_heights
from core.robot.kinematics import actuator_plane_pose, feet_in_modules
from core.robot.leg import strokes_from_foot
from core.robot.shoes import foot_distances, foot_pairs, least_distance
from solver_jobs.nlp.constraint import Box, Family, Situation
from solver_jobs.nlp.diagnosis import knot_ranges
from solver_jobs.nlp.messages import FAMILY_WORDS, REMEDIES
from solver_jobs.nlp.variables import MM

SLACK = 1e-9
"""Numbers may differ by this much, m, before something is called impossible."""

LEAST_NAMED = 5e-6
"""Shortfalls are given to 0.01 mm; a smaller one is left to the search."""


def presolve(situation: Situation, box: Box) -> tuple[str, ...]:
    """Sentences for everything that no motion can get round; empty where nothing is in the way."""
    if (falling := _falling(situation)) is not None:
        return (falling,)
    looks = (
        _no_area(situation),
        _contradictions(situation, box),
        _short_swings(situation),
        presolve_held_feet(situation.problem),
        _far_feet(situation),
        _far_body(situation),
        _near_shoes(situation.problem),
    )
    return tuple(sentence for look in looks for sentence in look)


def _falling(situation: Situation) -> str | None:
    """With no foot down the whole robot falls, Σ m a = −M g, faster than any speed limit allows."""
    problem = situation.problem
    floating = tuple(int(k) for k in np.nonzero(~situation.contact[:-1].any(axis=1))[0])
    fastest = max(problem.limits.body_speed, problem.limits.foot_speed)
    if not floating or GRAVITY * problem.intervals[list(floating)].max() <= 2 * fastest:
        return None
    return f"No foot stands at {knot_ranges(floating)}, so the robot falls. Keep at least three feet down."


def _no_area(situation: Situation) -> list[str]:
    """With fewer than three feet down the support has no area, and no margin can be kept inside it."""
    sentence = missing_support(situation.problem.timeline, situation.problem.limits.margin)
    return [] if sentence is None else [sentence]


def _contradictions(situation: Situation, box: Box) -> list[str]:
    sentences = []
    for conflict in box.conflicts:
        ends = {0: "the start", situation.problem.knot_count - 1: "the goal"}
        place = ends.get(conflict.knot, f"sample {conflict.knot + 1}")
        if conflict.family is Family.BODY_HEIGHT:
            lowest, highest = (height * MM for height in situation.problem.limits.plane_height)
            sentences.append(
                f"The actuator plane is {conflict.gap * MM:.2f} mm outside its bounds at {place}. Choose a "
                f"height from {lowest:g} to {highest:g} mm."
            )
            continue
        sentences.append(
            f"{FAMILY_WORDS[conflict.family].capitalize()} contradicts what is fixed at {place} by "
            f"{conflict.gap * MM:.2f} mm. {REMEDIES[conflict.family]}"
        )
    return sentences


def _short_swings(situation: Situation) -> list[str]:
    """A foot rests beside its swing, so it rises at most v·(time to the nearer end) from where it stood."""
    problem, sentences = situation.problem, []
    for swing, highest in low_swings(problem, situation.swings):
        sentences.append(
            f"Foot {swing.foot + 1} is in the air at {knot_ranges(tuple(swing.samples))}: too short to rise "
            f"{problem.limits.clearance * MM:.1f} mm (at most {highest * MM:.1f} mm at "
            f"{problem.limits.foot_speed * MM:.0f} mm/s). Lengthen the swing or lower the clearance."
        )
    return sentences


def low_swings(problem: MotionProblem, swings: tuple[Swing, ...]) -> list[tuple[Swing, float]]:
    """Swings that are too short for the clearance, and how high each can rise at most, m.

    None is asked of a foot that is held up before or after its swing.
    """
    found = []
    for swing in swings:
        if is_held(problem, swing):
            continue
        lone = max(swing.first, 1) >= swing.last
        acting = 0.0 if lone else float(rise_times(swing, problem.intervals).max())
        highest = acting * problem.limits.foot_speed + GROUNDED_HEIGHT
        if highest < problem.limits.clearance - SLACK:
            found.append((swing, highest))
    return found


def _far_feet(situation: Situation) -> list[str]:
    """A foot travels at most v in the time that acts on its knots in the air."""
    problem, sentences = situation.problem, []
    inner = ~situation.contact[1:-1]
    acting = _acting_times(problem)[1:-1]
    for foot in range(problem.model.leg_count):
        way = float(np.linalg.norm((problem.goal.feet_world - problem.start.feet_world)[foot, :2]))
        count = int(inner[:, foot].sum())
        seconds = float(inner[:, foot] @ acting)
        reach = seconds * problem.limits.foot_speed
        if way > SLACK and count == 0:
            sentences.append(
                f"Foot {foot + 1} has to travel {way * MM:.1f} mm but never swings. Give it a swing or "
                "leave it where it stands."
            )
        elif way > reach + SLACK:
            sentences.append(
                f"Foot {foot + 1} has to travel {way * MM:.1f} mm but its {seconds:.1f} s in the air allow "
                f"{reach * MM:.1f} mm at {problem.limits.foot_speed * MM:.0f} mm/s. Lengthen its swing or "
                "shorten the step."
            )
    return sentences


def _far_body(situation: Situation) -> list[str]:
    """The body travels at most v in the time between its ends, where it rests or, in a cycle, goes on."""
    problem = situation.problem
    way = float(np.linalg.norm(problem.goal.body_world - problem.start.body_world))
    acting = _acting_times(problem)
    span = acting.sum() if problem.boundary is Boundary.PERIODIC else acting[1:-1].sum()
    reach = float(span) * problem.limits.body_speed
    if way <= reach + SLACK:
        return []
    return [
        f"The body has to travel {way * MM:.1f} mm but {problem.knot_count} samples allow "
        f"{reach * MM:.1f} mm at {problem.limits.body_speed * MM:.0f} mm/s. "
        "Lengthen the gait or shorten the step."
    ]


def _near_shoes(problem: MotionProblem) -> Iterator[str]:
    """Feet that are given nearer to each other at the start or the goal than their shoes need."""
    least = least_distance(problem.model)
    if least is None or problem.boundary is Boundary.PERIODIC:
        return
    for place, pose in (("start", problem.start), ("goal", problem.goal)):
        distances = foot_distances(pose.feet_world)
        for pair in np.nonzero(distances < least - LEAST_NAMED)[0]:
            first, second = foot_pairs(problem.model.leg_count)[pair] + 1
            yield (
                f"Feet {first} and {second} are given {distances[pair] * MM:.1f} mm apart at the {place}, "
                f"and their shoes need {least * MM:.1f} mm. Move their footholds apart."
            )


def _acting_times(problem: MotionProblem) -> Floats:
    """(n,) how long each knot's velocity acts: half of the intervals beside it, s."""
    return np.asarray((np.append(problem.intervals, 0.0) + np.append(0.0, problem.intervals)) / 2)


def presolve_held_feet(problem: MotionProblem) -> list[str]:
    """Sentences on feet held out of reach, on ends without balance, and on lifts that are too short."""
    ends = (
        ("first", problem.start, problem.held_start, problem.heading[0]),
        ("last", problem.goal, problem.held_end, problem.heading[-1]),
    )
    if not any(held.any() for _, _, held, _ in ends):
        return []
    found: list[str] = []
    for sample, pose, held, heading in ends:
        if held.any():
            found += _out_of_reach(problem, pose, held, sample, float(heading))
            found += _out_of_balance(problem, pose, held, sample)
    return [*found, *_short_lifts(problem)]


def _out_of_reach(
    problem: MotionProblem, pose: RestPose, held: Bools, sample: str, heading: float
) -> Iterator[str]:
    """Where a foot is held it must be within its workspace, whatever happens between the ends."""
    model = problem.model
    plane = actuator_plane_pose(model, pose.body_world, np.asarray(heading))
    feet_module = feet_in_modules(model, pose.feet_world, plane)
    for foot in np.nonzero(held)[0]:
        miss = _miss(problem, feet_module[foot])
        if not miss <= LEAST_NAMED:
            height = (pose.body_world[2] - model.com_height) * MM
            yield (
                f"Foot {foot + 1} is held {pose.feet_world[foot, 2] * MM:.1f} mm up at the {sample} sample, "
                f"which is {miss * MM:.1f} mm more than its leg can draw in with the actuator plane at "
                f"{height:.1f} mm. Raise the body there, or lower the clearance."
            )


def _miss(problem: MotionProblem, foot_module: Floats) -> float:
    """By how much a foot held under its module is too high, m."""
    model = problem.model
    if problem.limits.workspace is Workspace.CYLINDER:
        return float(foot_module[2] + CYLINDER.depth - CYLINDER.above)
    return float((model.stroke.lower - strokes_from_foot(model.leg, foot_module)).max())


def _out_of_balance(problem: MotionProblem, pose: RestPose, held: Bools, sample: str) -> Iterator[str]:
    """A resting body's centre of mass is inside the polygon of the standing feet by the margin."""
    if problem.boundary is Boundary.PERIODIC:
        return
    standing = ~held
    point, feet = pose.body_world[None, :2], pose.feet_world[None]
    margin = float(stability_margins(point, feet, standing[None])[0])
    if margin >= problem.limits.margin - LEAST_NAMED:
        return
    up, down = (
        feet_words(tuple(int(f) + 1 for f in np.nonzero(flags)[0])) if flags.any() else "no foot"
        for flags in (held, standing)
    )
    where = f"{abs(margin) * MM:.1f} mm {'inside' if margin >= 0 else 'outside'}"
    yield (
        f"With {up} held up at the {sample} sample the robot rests on {down}: its centre of mass is {where} "
        f"the edge of the support polygon, and {problem.limits.margin * MM:.1f} mm is asked. Hold fewer feet "
        "up there, or lower the margin."
    )


def _short_lifts(problem: MotionProblem) -> Iterator[str]:
    """A foot rests on both sides of its swing, so it rises or sinks at most v·(time in the air)."""
    for swing in problem_swings(problem):
        before, after = rest_heights(problem, swing)
        first = max(swing.first, 1)
        around = problem.intervals[first - 1 : swing.last + 1]
        highest = float(((around[1:] + around[:-1]) / 2).sum()) * problem.limits.foot_speed
        if abs(after - before) > highest + GROUNDED_HEIGHT + SLACK:
            yield (
                f"Foot {swing.foot + 1} is in the air at {knot_ranges(tuple(swing.samples))}: too short to "
                f"go {abs(after - before) * MM:.1f} mm {'up' if after > before else 'down'} to where it is "
                f"held or stands (at most {highest * MM:.1f} mm at "
                f"{problem.limits.foot_speed * MM:.0f} mm/s). "
                "Lengthen the swing or lower the clearance."
            )
