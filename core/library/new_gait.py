"""New gaits: a timeline drawn from foot order and phase lengths, for any robot."""

from collections.abc import Sequence
from dataclasses import replace

from core.errors import InputError
from core.gait.foot_orders import named_orders
from core.gait.gait import Gait, Orientation, heading_step
from core.gait.held_feet import HeldFeet
from core.gait.options import GaitOptions
from core.library.sequence import derived
from core.motion.contact_timeline import MAX_SAMPLES, timeline_from_order
from core.problem.motion_problem import Cost
from core.robot.model import RobotModel

SAMPLE_TIME = 0.4
"""Between the knots of a drawn gait, s (docs/sources.md, Published gaits)."""

DEFAULT_STEP = 0.010
"""The body's travel an iteration, m; every robot and every order below can do it."""

MANY_LEGS = 8
"""From so many legs on phases are shorter, or an iteration would last most of a minute."""


def default_phase_knots(model: RobotModel) -> int:
    """Knots of each stance phase and of each swing: as published, fewer where many feet take turns."""
    return GaitOptions.phase_knots if model.leg_count < MANY_LEGS else 3


def drawn_gait(
    model: RobotModel,
    name: str,
    orientation: Orientation,
    order: Sequence[int],
    step: float,
    *,
    phase_knots: int = GaitOptions.phase_knots,
    closing_knots: int = GaitOptions.closing_knots,
    iterations: int = 1,
) -> Gait:
    """A gait whose feet step one after the other, at direction 1.

    Args:
        model: the robot.
        name: what a person calls it.
        orientation: which way it goes.
        order: feet in the order of their steps, counted from 1.
        step: the body's travel an iteration along its heading, m.
        phase_knots: samples of each stance phase and of each swing.
        closing_knots: knots after the last swing.
        iterations: how often every foot steps.

    Raises:
        InputError: naming the argument that cannot be.
    """
    if step < 0:
        raise InputError(f"The step is {step * 1000:g} mm; it must be at least 0 mm.", "step")
    samples = iterations * model.leg_count * 2 * phase_knots + closing_knots
    if samples > MAX_SAMPLES:
        raise InputError(
            f"The timeline would have {samples} samples; at most {MAX_SAMPLES} are kept. Shorten the phases.",
            "phase_knots",
        )
    return Gait(
        name=name,
        robot=model.name,
        orientation=orientation,
        direction=1,
        order=tuple(order),
        step=heading_step(orientation, step),
        iterations=iterations,
        timeline=timeline_from_order(
            model.leg_count,
            order,
            phase_knots=phase_knots,
            closing_knots=closing_knots,
            iterations=iterations,
            sample_time=SAMPLE_TIME,
        ),
        options=GaitOptions(
            margin=model.margin, cost=Cost.GENTLE, phase_knots=phase_knots, closing_knots=closing_knots
        ),
    )


def with_robot(gait: Gait, model: RobotModel, order: Sequence[int] | None = None) -> Gait:
    """The gait for another robot; with another number of legs it is drawn anew in one of that robot's orders.

    Of a sequence every part is carried over. No foot of a gait that is drawn anew is held up.

    Args:
        gait: to be carried over.
        model: the robot.
        order: feet in the order of their steps; None for the gait's own, or the robot's first one.

    Raises:
        InputError: the gait is made by hand for another number of legs, the order does not fit, or the parts
            of a sequence do not.
    """
    if gait.sequence:
        parts = (replace(part, gait=with_robot(part.gait, model)) for part in gait.sequence)
        return derived(replace(gait, sequence=tuple(parts)))
    if model.leg_count == gait.timeline.leg_count:
        return replace(gait, robot=model.name)
    if gait.segment_table is not None:
        raise InputError(
            f"“{gait.name}” is made by hand for {gait.timeline.leg_count} legs; {model.title} has "
            f"{model.leg_count}. Choose a robot with {gait.timeline.leg_count} legs.",
            "robot",
        )
    feet = tuple(order) if order is not None else named_orders(model, gait.orientation)[0].feet
    timeline = timeline_from_order(
        model.leg_count,
        feet,
        phase_knots=gait.options.phase_knots,
        closing_knots=gait.options.closing_knots,
        iterations=gait.iterations,
        sample_time=gait.timeline.sample_time,
    )
    turned = timeline.turned(gait.quarter_turns)
    return replace(gait, robot=model.name, order=feet, timeline=turned, held=HeldFeet())
