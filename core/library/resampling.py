"""Brings gaits to another sample time, so that they can follow each other in a sequence."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from core.arrays import Bools, Floats
from core.errors import InputError
from core.gait.gait import Gait, SequencePart, drawn_timeline, is_drawn
from core.gait.options import LEAST_PHASE_KNOTS, MOST_CLOSING_KNOTS, MOST_PHASE_KNOTS
from core.gait.recording import Recording, RecordingFit, RecordingForm
from core.library.sequence import part_name
from core.motion.contact_timeline import SAME_INTERVAL, ContactTimeline
from core.motion.trajectory import Trajectory
from core.recorded.recorded_motion import gait_trajectory
from core.robot.model import load_robot
from core.wire.trajectory_csv import format_companion, format_trajectory_csv

_WHOLE = 1e-6
"""A phase that is longer than whole samples by less than this part of a sample is not rounded up."""


@dataclass(frozen=True)
class ResampledParts:
    """Parts of a sequence with one sample time.

    Args:
        parts: all of them, in their order.
        sample_time: that they share, s.
        changes: a sentence on each part that was resampled.
    """

    parts: tuple[SequencePart, ...]
    sample_time: float
    changes: tuple[str, ...]


def resampled_parts(parts: Sequence[SequencePart], sample_time: float | None = None) -> ResampledParts:
    """Brings the parts of a sequence to one sample time (see `resampled_gait`).

    Args:
        parts: at least one.
        sample_time: s; None for that of the most parts, and of the first of these where several are as many.

    Raises:
        InputError: there is no part, or one of them cannot have that sample time.
    """
    if not parts:
        raise InputError("The sequence has no part; add at least one gait.", "sequence")
    wanted = common_sample_time(parts) if sample_time is None else sample_time
    changed, changes = [], []
    for index, part in enumerate(parts):
        gait = resampled_gait(part.gait, wanted)
        changed.append(part if gait is part.gait else replace(part, gait=gait))
        if gait is not part.gait:
            changes.append(f"{part_name(index, part)}: {_change(part.gait, gait)}")
    return ResampledParts(tuple(changed), wanted, tuple(changes))


def common_sample_time(parts: Sequence[SequencePart]) -> float:
    """The sample time that the most parts have, s; of several the one that comes first."""
    times = [part.gait.timeline.sample_time for part in parts]
    return Counter(times).most_common(1)[0][0]


def resampled_gait(gait: Gait, sample_time: float) -> Gait:
    """The gait with another sample time; nothing in it gets faster.

    Each phase of its timeline, and each segment of its table, is rounded up to whole samples. A recorded
    motion is interpolated between its samples. Locks of single cells are lost.

    Args:
        gait: a drawn gait, one made by hand, or a recorded motion.
        sample_time: s.

    Returns:
        The gait; itself where it has that sample time already.

    Raises:
        InputError: it would have too many samples, or a swing would fall between two of them.
    """
    own = gait.timeline.sample_time
    if abs(own - sample_time) <= SAME_INTERVAL * own:
        return gait
    if not (np.isfinite(sample_time) and sample_time > 0):
        raise InputError(f"The sample time is {sample_time} s; it must be above 0.", "sample_time")
    ratio = own / sample_time
    if gait.recorded is not None:
        return _recorded(gait, gait.recorded, sample_time)
    if gait.segment_table is not None:
        samples = max(_whole(gait.segment_table.samples_per_segment * ratio), 2)
        table = replace(gait.segment_table, samples_per_segment=samples)
        repeated = table.repeated(gait.iterations).turned(gait.quarter_turns)
        return replace(gait, segment_table=table, timeline=repeated.timeline(sample_time))
    phase, closing = _whole(gait.options.phase_knots * ratio), _whole(gait.options.closing_knots * ratio)
    # How long phases are drawn from now on: a wish, which the timeline itself may exceed.
    wish = min(max(phase, LEAST_PHASE_KNOTS), MOST_PHASE_KNOTS), min(closing, MOST_CLOSING_KNOTS)
    options = replace(gait.options, phase_knots=wish[0], closing_knots=wish[1])
    again = replace(gait, options=options, timeline=replace(gait.timeline, sample_time=sample_time))
    if is_drawn(gait) and wish == (phase, closing):
        return replace(again, timeline=drawn_timeline(again))
    stance = gait.timeline.stance[:, _samples(gait, ratio)]
    return replace(again, timeline=ContactTimeline(stance, np.zeros_like(stance), sample_time))


def _whole(samples: float) -> int:
    return int(np.ceil(samples - _WHOLE * max(samples, 1.0)))


def _samples(gait: Gait, ratio: float) -> list[int]:
    """Which old sample each new one repeats: every phase as often as it needs to last as long as before."""
    stance = gait.timeline.stance
    count = stance.shape[1]
    borders = {0, count, *(np.nonzero((np.diff(stance.astype(np.int8), axis=1) != 0).any(axis=0))[0] + 1)}
    # Iterations stay equally long, so that the gait can still be repeated.
    resting = _resting(stance, gait.options.closing_knots)
    length, rest = divmod(count - resting, gait.iterations)
    if not rest:
        borders |= {length * iteration for iteration in range(gait.iterations + 1)}
    samples: list[int] = []
    for first, end in pairwise(sorted(int(border) for border in borders)):
        samples += [first] * _whole((end - first) * ratio)
    return samples


def _resting(stance: Bools, most: int) -> int:
    """Samples of the closing stance, after every foot has come down."""
    moving = np.nonzero(~stance[stance.any(axis=1)].all(axis=0))[0]
    return min(int(stance.shape[1]) - 1 - int(moving.max(initial=-1)), most)


def _recorded(gait: Gait, recording: Recording, sample_time: float) -> Gait:
    """The gait of the same recorded motion at other samples; it takes up to one sample longer."""
    motion = _interpolated(gait_trajectory(gait, recording, load_robot(gait.robot)), sample_time)
    sentence = (
        f"Interpolated from a sample every {gait.timeline.sample_time:g} s to one every {sample_time:g} s."
    )
    text = format_trajectory_csv(motion)
    recorded = Recording(
        recording.file,
        RecordingForm.TRAJECTORY,
        text,
        format_companion(motion, text, gait.robot),
        (*recording.assumed, sentence),
        RecordingFit(within_stroke=recording.fit.within_stroke),
    )
    stance = np.array(motion.contact.T)
    return replace(
        gait, recorded=recorded, timeline=ContactTimeline(stance, np.zeros_like(stance), sample_time)
    )


def _interpolated(motion: Trajectory, sample_time: float) -> Trajectory:
    """The motion at other samples, the last of which is its end.

    Raises:
        InputError: a swing would fall between two samples.
    """
    duration = float(motion.times[-1] - motion.times[0])
    count = max(_whole(duration / sample_time), 1) + 1
    times = np.asarray(np.arange(count) * sample_time, dtype=np.float64)
    slower = duration / float(times[-1])
    place = np.linspace(0.0, motion.knot_count - 1, count)
    before = np.minimum(place.astype(np.intp), motion.knot_count - 2)

    def between(values: Floats) -> Floats:
        share = (place - before).reshape(-1, *[1] * (values.ndim - 1))
        return np.asarray((1 - share) * values[before] + share * values[before + 1])

    # A foot stands at a sample where it stands at all old samples between which that one lies.
    after = np.ceil(place - _WHOLE).astype(np.intp)
    contact = motion.contact[np.floor(place + _WHOLE).astype(np.intp)] & motion.contact[after]
    old, new = (ContactTimeline(c.T, np.zeros_like(c.T), 1.0).swings() for c in (motion.contact, contact))
    if len(old) != len(new):
        raise InputError(
            f"A swing of the recorded motion would be lost between two samples {sample_time:g} s apart. Take "
            "a shorter sample time.",
            "sample_time",
        )
    speeds = (
        None if values is None else between(values) * slower
        for values in (motion.body_velocity, motion.feet_velocity)
    )
    return Trajectory(
        times,
        between(motion.body_world),
        between(motion.heading),
        between(motion.feet_world),
        contact,
        *speeds,
    )


def _change(before: Gait, after: Gait) -> str:
    """What resampling changed, in a sentence."""
    old, new = before.timeline, after.timeline
    how = (
        "The recorded motion is interpolated between its samples."
        if after.recorded is not None
        else "Its segments are rounded up to whole samples."
        if after.segment_table is not None
        else "Its phases are rounded up to whole samples, and its motion is computed anew."
    )
    return (
        f"a sample every {new.sample_time:g} s instead of {old.sample_time:g} s; it has {new.sample_count} "
        f"samples instead of {old.sample_count} and lasts {new.times[-1]:.1f} s instead of "
        f"{old.times[-1]:.1f} s. {how}"
    )
