"""Gaits brought to another sample time."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core.errors import InputError
from core.gait.gait import Gait, SequencePart, is_drawn, motion_problem, with_iterations
from core.gait.recording import Recording, RecordingForm
from core.library.library import library
from core.library.resampling import common_sample_time, resampled_gait, resampled_parts
from core.library.sequence import part_refusal, sequence_gait
from core.motion.contact_timeline import ContactTimeline
from core.motion.trajectory import Trajectory
from core.problem.motion_problem import Boundary
from core.recorded.recorded_gait import gait_of_motion
from core.recorded.recorded_motion import gait_trajectory
from core.robot.model import load_robot
from core.wire.trajectory_csv import format_companion, format_trajectory_csv
from solver_jobs import SolveStatus, solve_live


def gait(name: str) -> Gait:
    return library()[name].gait


def at(name: str, sample_time: float) -> Gait:
    own = gait(name)
    return replace(own, timeline=replace(own.timeline, sample_time=sample_time))


def recorded(name: str = "walk") -> Gait:
    own = gait(name)
    motion = solve_live(motion_problem(own, load_robot(own.robot))).trajectory
    text = format_trajectory_csv(motion)
    file = Recording("w.csv", RecordingForm.TRAJECTORY, text, format_companion(motion, text))
    return replace(gait_of_motion(motion, "Recorded").gait, recorded=file)


def swing_seconds(one: Gait) -> list[tuple[int, float]]:
    step = one.timeline.sample_time
    return [(swing.foot, len(swing.samples) * step) for swing in one.timeline.swings()]


@settings(max_examples=40, deadline=None)
@given(
    st.sampled_from(["walk", "amble", "s-gait", "rotate", "textbook-trot", "walk-manual-0"]),
    st.floats(0.1, 1.0),
    st.floats(0.1, 1.0),
    st.integers(1, 3),
)
def test_no_swing_gets_shorter_and_the_gait_can_still_be_repeated(
    name: str, own: float, wanted: float, iterations: int
) -> None:
    before = with_iterations(at(name, own), iterations)
    if before.segment_table is not None:
        table = before.segment_table.repeated(iterations).turned(before.quarter_turns)
        before = replace(before, timeline=table.timeline(own))
    after = resampled_gait(before, wanted)
    assert after.timeline.sample_time == pytest.approx(wanted, rel=2e-6)
    old, new = swing_seconds(before), swing_seconds(after)
    assert [foot for foot, _ in new] == [foot for foot, _ in old]
    if before.segment_table is None:
        assert all(b >= a - 1e-5 for (_, a), (_, b) in zip(old, new, strict=True))
    again = with_iterations(after, iterations + 1)
    assert again.iterations == iterations + 1


def test_a_gait_with_that_sample_time_is_left_as_it_is() -> None:
    walk = gait("walk")
    assert resampled_gait(walk, 0.4 * (1 + 1e-9)) is walk


def test_a_drawn_gait_is_drawn_anew_with_longer_phases() -> None:
    finer = resampled_gait(gait("walk"), 0.2)
    assert (finer.options.phase_knots, finer.options.closing_knots) == (10, 10)
    assert is_drawn(finer)
    coarser = resampled_gait(at("walk", 0.3), 0.4)
    assert (coarser.options.phase_knots, coarser.timeline.sample_count) == (4, 36)


def test_a_drawing_by_hand_keeps_its_phases() -> None:
    walk = at("walk", 0.3)
    stance = walk.timeline.stance.copy()
    stance[1, 2:4] = False
    drawn = replace(walk, timeline=ContactTimeline(stance, np.zeros_like(stance), 0.3))
    after = resampled_gait(drawn, 0.4)
    assert not is_drawn(after)
    assert len(after.timeline.swings()) == len(drawn.timeline.swings())
    assert after.timeline.stance[:, -1].all()


def test_a_resampled_drawing_still_walks() -> None:
    after = resampled_gait(at("walk", 0.3), 0.4)
    assert solve_live(motion_problem(after, load_robot(after.robot))).status is SolveStatus.SOLVED


@pytest.mark.parametrize("wanted", [0.1, 0.3, 0.7])
def test_a_recorded_motion_is_interpolated_and_reads_back(wanted: float) -> None:
    before = recorded()
    after = resampled_gait(before, wanted)
    assert before.recorded is not None
    assert after.recorded is not None
    model = load_robot(after.robot)
    old = gait_trajectory(before, before.recorded, model)
    new: Trajectory = gait_trajectory(after, after.recorded, model)
    assert np.diff(new.times) == pytest.approx(wanted)
    assert 0 <= new.times[-1] - old.times[-1] < wanted
    for end in (0, -1):
        assert new.feet_world[end] == pytest.approx(old.feet_world[end])
        assert new.body_world[end] == pytest.approx(old.body_world[end])
    standing = new.contact[:-1] & new.contact[1:]
    assert np.abs(np.diff(new.feet_world, axis=0)[standing]).max() < 1e-6
    assert after.recorded.assumed[-1].startswith("Interpolated from a sample every 0.4 s")


def test_a_recorded_swing_is_not_lost_between_two_samples() -> None:
    with pytest.raises(InputError, match=r"would be lost between two samples 6 s apart") as refused:
        resampled_gait(recorded(), 6.0)
    assert refused.value.where == "sample_time"


@pytest.mark.parametrize("wanted", [0.0, -1.0, float("nan"), 1e-5])
def test_a_sample_time_that_no_timeline_has_is_refused(wanted: float) -> None:
    with pytest.raises(InputError, match="sample"):
        resampled_gait(gait("walk"), wanted)


def test_parts_are_brought_to_the_sample_time_of_the_most() -> None:
    odd = replace(at("s-gait", 0.3), name="Odd")
    parts = [SequencePart(odd), SequencePart(gait("walk"), 2), SequencePart(gait("rotate"))]
    with pytest.raises(InputError, match="sequence has one sample time") as refused:
        sequence_gait("Tour", parts)
    assert refused.value.where == "sample_time"
    brought = resampled_parts(parts)
    assert (brought.sample_time, common_sample_time(brought.parts)) == (0.4, 0.4)
    assert brought.parts[1:] == tuple(parts[1:])
    assert brought.changes == (
        "Part 1, “Odd”: a sample every 0.4 s instead of 0.3 s; it has 36 samples instead of 45 and lasts "
        "14.0 s instead of 13.2 s. Its phases are rounded up to whole samples, and its motion is computed "
        "anew.",
    )
    assert sequence_gait("Tour", brought.parts).timeline.sample_time == 0.4


def test_of_as_many_the_first_part_counts_and_another_time_can_be_asked() -> None:
    parts = [SequencePart(at("walk", 0.3)), SequencePart(gait("s-gait"))]
    assert resampled_parts(parts).sample_time == 0.3
    assert {p.gait.timeline.sample_time for p in resampled_parts(parts, 0.2).parts} == {0.2}
    with pytest.raises(InputError, match="no part"):
        resampled_parts([])


def test_a_gait_says_why_it_cannot_be_a_part() -> None:
    walk = gait("walk")
    clock = next(entry.gait for entry in library().values() if entry.gait.poses is not None)
    assert part_refusal(clock) == "made for the robot's clock"
    assert part_refusal(walk.with_options(boundary=Boundary.PERIODIC)) == "a cycle, which never rests"
    stance = walk.timeline.stance.copy()
    stance[0, -1] = False
    lifted = replace(walk, timeline=replace(walk.timeline, stance=stance))
    assert part_refusal(lifted) == "does not begin and end at rest"
    assert part_refusal(walk) is None
    assert part_refusal(sequence_gait("x", [SequencePart(walk)])) is None
