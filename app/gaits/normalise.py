"""Applies the consequences of an edit: locks, timeline and segment table, held feet, recorded motion."""

from dataclasses import replace

import numpy as np

from app.documents.gait_json import asked_hash
from app.gaits.sequence_documents import normalise_sequence
from core.arrays import Bools
from core.errors import StateError
from core.gait.gait import Gait, with_iterations
from core.gait.held_feet import HeldFeet, feet_words
from core.gait.held_rules import require_swinging, standing_of
from core.gait.poses import Poses
from core.motion.contact_timeline import ContactTimeline
from core.pose_gaits.conversion import conversion_notice
from core.pose_gaits.gait_poses import found_gait, pose_problem, with_pose_timeline
from core.robot.model import load_robot
from core.segments.from_timeline_edit import carried

SAME_STEP = 1e-9
"""Steps that differ by less are the same, m."""
SAME_TURN = 1e-7
"""Turns that differ by less are the same, rad."""
LET_GO = (
    "The pinned poses were removed, because foot order, cycles, direction of travel, turn, sway, stop bound "
    "or robot changed. Undo brings them back."
)
SET_ASIDE = "The recorded motion of {file} was set aside; the motion is computed now. Undo brings it back."


def normalise(before: Gait, after: Gait) -> tuple[Gait, str | None]:
    """Normalises an edited gait: locks hold, timeline and segment table agree.

    Args:
        before: the document as it was.
        after: the document as it was changed.

    Returns:
        The gait, and a sentence where its segment table or its recorded motion was set aside, where pinned
        poses were removed, or where a conversion leaves something behind.

    Raises:
        StateError: a locked cell would change.
        InputError: the edit says that a foot is held up which stands.
    """
    if before.sequence or after.sequence:
        return normalise_sequence(before, after), None
    if after.poses is not None:
        return normalise_poses(before, after, after.poses)
    require_locks(before, after)
    tabled = normalise_table(before, normalise_drawing(before, after))
    changed, notice = normalise_held_feet(*tabled, is_said=before.held != after.held)
    changed, notice = normalise_results(before, changed, notice)
    return changed, " ".join(filter(None, (notice, conversion_notice(before, changed)))) or None


def normalise_poses(before: Gait, after: Gait, poses: Poses) -> tuple[Gait, str | None]:
    """Normalises a gait for the robot's clock: the timeline follows, and a step that was set is kept.

    Poses that are pinned are let go where the gait has others now.

    Args:
        before: the document as it was.
        after: the document as it was changed.
        poses: of the changed document.

    Returns:
        The gait, and a sentence where pinned poses were let go, or where a drawn gait lost something.

    Raises:
        InputError: it asks for what such a gait cannot have.
        StateError: the timeline was drawn on.
    """
    model, known, notice = load_robot(after.robot), before.poses, conversion_notice(before, after)
    if known is not None:
        if known.pinned and known.pinned == poses.pinned and _poses_of(before) != _poses_of(after):
            poses, notice = replace(poses, pinned=()), LET_GO
        is_free = poses.free_step and not (known.free_step and _is_step_set(before, after, poses))
        poses = replace(poses, free_step=is_free)
        # A page that has not seen new poses yet must not bring the old ones back.
        if found_gait(replace(after, poses=poses), model) is None:
            poses = replace(poses, found=known.found or poses.found)
    followed = with_pose_timeline(replace(after, poses=poses), model)
    is_drawn_on = known is not None and after.timeline not in (before.timeline, followed.timeline)
    if is_drawn_on and asked_hash(before) == asked_hash(after):
        raise StateError(
            "The timeline of a gait for the robot's clock follows from foot order and number of cycles; "
            "change those.",
            "timeline",
        )
    return followed, notice


def _poses_of(gait: Gait) -> object:
    """Key that changes when pose numbers or positions lose their meaning."""
    bare = None if gait.poses is None else replace(gait.poses, pinned=())
    problem = pose_problem(replace(gait, poses=bare), load_robot(gait.robot))
    turn = problem.heading - gait.quarter_turns * np.pi / 2
    return (
        gait.robot,
        gait.order,
        gait.iterations,
        problem.parts_to_try,
        problem.move_count,
        round(turn, 6),
        problem.sway,
    )


def _is_step_set(before: Gait, after: Gait, poses: Poses) -> bool:
    """Whether somebody set the step, which is not the one of the poses that the page knows."""
    found, length = poses.found, float(np.hypot(*after.step[:2]))
    if after.step == before.step or found is None:
        return after.step != before.step
    if (length == 0.0) != (found.step == 0.0):
        return True
    if length == 0.0:  # on the spot it is the turn that may be free
        turns = float(found.turns[-1] - found.turns[0]) / np.array([before.iterations, after.iterations])
        return bool(np.abs(after.step[2] - turns).min() >= SAME_TURN)
    return abs(length - found.step) >= SAME_STEP


def require_locks(before: Gait, after: Gait) -> None:
    """Locked cells stay as they are until they are unlocked.

    Raises:
        StateError: naming the first locked cell that would change.
    """
    locked = before.timeline.locked
    if not locked.any():
        return
    if after.timeline.stance.shape != locked.shape:
        raise StateError("The timeline has locked cells; unlock them before you draw it anew.", "timeline")
    _require_held(locked & after.timeline.locked & (before.timeline.stance != after.timeline.stance))


def _require_held(changed: Bools) -> None:
    if changed.any():
        foot, sample = (int(i) + 1 for i in np.argwhere(changed)[0])
        raise StateError(
            f"Foot {foot}, sample {sample} is locked; unlock it before you change it.", "timeline"
        )


def normalise_drawing(before: Gait, after: Gait) -> Gait:
    """Repeats a drawn gait's timeline for other iterations, and turns it for another direction.

    A timeline that was drawn differently in the same edit says itself what is meant and stays.

    Raises:
        InputError: the timeline cannot be repeated.
        StateError: its locked cells would be lost.
    """
    same_drawing = np.array_equal(before.timeline.stance, after.timeline.stance)
    if after.segment_table is not None or not same_drawing:
        return after
    if after.iterations != before.iterations:
        as_drawn = replace(after, iterations=before.iterations, direction=before.direction)
        repeated = with_iterations(as_drawn, after.iterations).timeline
        if before.timeline.locked.any() and not repeated.locked.any():
            raise StateError("The timeline has locked cells; unlock them before you repeat it.", "iterations")
        after = replace(after, timeline=repeated)
    turned = replace(after, timeline=_turned(after.timeline, before, after))
    # Where the same edit says which feet are held, it means those of its own direction.
    return replace(turned, held=_held(before, after)) if after.held == before.held else turned


def normalise_imported(gait: Gait) -> tuple[Gait, str | None]:
    """Makes an imported gait's timeline agree with its segment table, which is what moves the robot.

    Returns:
        The gait, and a sentence where its timeline said something else.

    Raises:
        InputError: its iterations cannot follow one another, or a foot is held up that stands.
    """
    if gait.poses is not None:
        return with_pose_timeline(gait, load_robot(gait.robot)), None
    if gait.segment_table is None:
        require_swinging(gait.timeline, gait.held)
        return gait, None
    repeated = gait.segment_table.repeated(gait.iterations).turned(gait.quarter_turns)
    implied = repeated.timeline(gait.timeline.sample_time)
    if np.array_equal(implied.stance, gait.timeline.stance):
        return gait, None
    notice = "The document's timeline did not agree with its segment table; it now follows the table."
    return replace(gait, timeline=implied), notice


def _turned(timeline: ContactTimeline, before: Gait, after: Gait) -> ContactTimeline:
    """The timeline of one gait's direction for the feet that step in another's."""
    legs = timeline.leg_count
    shift = _shift(before, after, legs)
    stance, locked = (np.roll(cells, shift, axis=0) for cells in (timeline.stance, timeline.locked))
    return replace(timeline, stance=stance, locked=locked)


def _shift(before: Gait, after: Gait, legs: int) -> int:
    """By how many places feet are handed on from one gait's direction to another's."""
    return after.quarter_turns * legs // 4 - before.quarter_turns * legs // 4


def _held(before: Gait, after: Gait) -> HeldFeet:
    """The held feet of one gait's direction for those of another's."""
    legs = after.timeline.leg_count
    return after.held.turned(_shift(before, after, legs), legs)


def normalise_table(before: Gait, after: Gait) -> tuple[Gait, str | None]:
    """Brings segment table and timeline of an edited gait into agreement.

    Where only the table, direction or iterations changed, the timeline follows. Where the timeline was
    drawn by hand, the table follows where it can, and is set aside where it cannot.

    Returns:
        The gait, and a sentence where the table was set aside or says something unusual.

    Raises:
        StateError: a locked cell would change.
    """
    table = after.segment_table
    if table is None:
        return after, None
    repeated = table.repeated(after.iterations).turned(after.quarter_turns)
    implied = repeated.timeline(after.timeline.sample_time)
    if np.array_equal(after.timeline.stance, implied.stance):
        return after, None
    if before.segment_table is not None and np.array_equal(after.timeline.stance, before.timeline.stance):
        return replace(after, timeline=_with_locks(before, after, implied)), None
    found = carried(table, after.timeline, after.iterations, after.quarter_turns)
    if found.table is not None:
        return replace(after, segment_table=found.table), found.sentence
    notice = (
        f"The segment table cannot express what you drew: {found.sentence} It was set aside and the "
        "gait is now "
        "a drawn one. Undo brings the table back."
    )
    return replace(after, segment_table=None), notice


def _with_locks(before: Gait, after: Gait, implied: ContactTimeline) -> ContactTimeline:
    """What a table implies, with the cells locked that were."""
    drawn = _turned(after.timeline, before, after)
    if not drawn.locked.any():
        return implied
    if drawn.stance.shape != implied.stance.shape:
        raise StateError(
            "The timeline has locked cells; unlock them before you change how many samples the table has.",
            "segment_table",
        )
    _require_held(drawn.locked & (drawn.stance != implied.stance))
    return replace(implied, locked=drawn.locked)


def normalise_held_feet(gait: Gait, notice: str | None, *, is_said: bool) -> tuple[Gait, str | None]:
    """Removes feet from the held feet if an edit of the timeline lets them stand there.

    Args:
        gait: the changed document, normalised in all other respects.
        notice: what the edit had to set aside so far.
        is_said: whether the edit itself says which feet are held.

    Returns:
        The gait, and a sentence where something was set aside.

    Raises:
        InputError: the edit itself says that a foot is held up which stands there.
    """
    if gait.segment_table is not None:
        return gait, notice
    if is_said:
        require_swinging(gait.timeline, gait.held)
    down = standing_of(gait.timeline, gait.held)
    if not down.any:
        return gait, notice
    start, end = (
        tuple(foot for foot in held if foot not in stands)
        for held, stands in ((gait.held.start, down.start), (gait.held.end, down.end))
    )
    sentences = [notice]
    for feet, sample in ((down.start, "first"), (down.end, "last")):
        if feet:
            several = len(feet) > 1
            sentences.append(
                f"{feet_words(feet).capitalize()} {'stand' if several else 'stands'} at the {sample} sample "
                f"now, so {'they are' if several else 'it is'} no longer held up there."
            )
    return replace(gait, held=HeldFeet(start, end)), " ".join(filter(None, sentences))


def normalise_results(before: Gait, after: Gait, notice: str | None) -> tuple[Gait, str | None]:
    """Sets a recorded motion aside where the edit asks for another one, and keeps the right provenance.

    Args:
        before: the document as it was.
        after: the changed document, normalised in all other respects.
        notice: what the edit had to set aside so far.

    Returns:
        The gait, and a sentence where something was set aside.
    """
    recording = before.recorded
    if recording is not None and after.recorded in (None, recording) and asks_anew(before, after):
        sentences = (notice, SET_ASIDE.format(file=recording.file))
        after, notice = replace(after, recorded=None), " ".join(filter(None, sentences))
    return _with_provenance(before, after), notice


def asks_anew(before: Gait, after: Gait) -> bool:
    """Whether an edit asks for another motion: more than words, orientation and locks were changed."""
    timeline = replace(after.timeline, locked=before.timeline.locked) if _same_size(before, after) else None
    same = replace(
        after,
        name=before.name,
        notes=before.notes,
        orientation=before.orientation,
        provenance=before.provenance,
        timeline=timeline or after.timeline,
    )
    return same != before


def _same_size(before: Gait, after: Gait) -> bool:
    return before.timeline.stance.shape == after.timeline.stance.shape


def _with_provenance(before: Gait, after: Gait) -> Gait:
    """Keeps the server's provenance: a page that has not seen a result yet must not erase it."""
    own = after.provenance
    if own == before.provenance or (own is not None and own.motion == asked_hash(after)):
        return after
    return replace(after, provenance=before.provenance)
