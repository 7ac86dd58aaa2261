"""Steps by hand: one motor, one foot or the body, looked at first and then made."""

from typing import Annotated, Any

from fastapi import APIRouter, Response
from pydantic import Field
from starlette.concurrency import run_in_threadpool

from app.robot.jog_service import JogLook, JogRequest
from app.routes.robot.robot import SOMEBODY, ActorBody, named
from app.scene.ghost import ghost_blob
from app.web.dependencies import MOST_MOTORS, MOST_PLACE, RequestBody, TheAuthor, TheStudio, strokes_from_mm
from core.errors import InputError
from core.jog.steps import MOST_STEPS, Axis, JogPart, JogStep
from core.robot.model import RobotModel, load_robot

router = APIRouter(prefix="/api/robot", tags=["robot"])

Place = Annotated[float, Field(ge=-MOST_PLACE, le=MOST_PLACE, allow_inf_nan=False)]
Millimetres = Annotated[float, Field(allow_inf_nan=False)]


class JogStepBody(RequestBody):
    """One step: of a `motor` of a `foot`, of a foot along an axis, or of the body along an axis."""

    part: JogPart
    by_mm: Millimetres
    """How far, mm; of a motor the change of its stroke, which grows downwards."""
    foot: int | None = None
    """Counted from 1."""
    motor: int | None = None
    """Within the foot, counted from 1."""
    axis: Axis | None = None
    """Of the robot: x forwards, y to the left, z up."""


class JogRangesBody(RequestBody):
    """Whose ranges are to be told."""

    part: JogPart
    foot: int = 1


class Target(RequestBody):
    """Where steps begin and what they are."""

    steps: list[JogStepBody] = Field(max_length=MOST_STEPS)
    robot: str = "deltawalker"
    from_mm: list[Millimetres] | None = Field(default=None, max_length=MOST_MOTORS)
    """Strokes to begin with, of previews only; the measured ones where none are given."""

    def wish(self, look: JogRangesBody | None = None) -> JogRequest:
        """The steps as values.

        Raises:
            InputError: there is no such robot, or the strokes are not its.
        """
        model = load_robot(self.robot)
        given = None if self.from_mm is None else strokes_from_mm(model, self.from_mm, "from_mm")
        return JogRequest(model, tuple(_step(one) for one in self.steps), given, _look(model, look))


class JogBody(Target, ActorBody):
    """Steps to look at (`preview`) or to make."""

    preview: bool = False
    """Tells target and findings, and moves nothing."""
    look: JogRangesBody | None = None
    seen_mm: list[Millimetres] | None = Field(default=None, max_length=MOST_MOTORS)
    """Target that the person saw; refused where the robot would go elsewhere."""


class Ghost(Target):
    """Steps whose target is to be drawn, and where the body stands in the scene."""

    x: Place = 0.0
    y: Place = 0.0
    heading: Place = 0.0


@router.post("/jog")
async def jog(studio: TheStudio, author: TheAuthor, wish: JogBody) -> dict[str, Any]:
    """Moves one motor, one foot or the body by small steps; with `preview` only tells where they would lead.

    Needs an armed robot that stands still with no run on, and the lease. Findings are judged anew from where
    it stands then. The answer is the preview's content, or the robot's view.
    """
    steps = wish.wish(wish.look)
    if wish.preview:
        return await run_in_threadpool(studio.jog.preview, steps)
    actor = named(author, wish)

    def moved() -> None:
        with studio.robot.lease.held_by(actor):
            studio.jog.move(steps, actor.name or SOMEBODY, wish.seen_mm)

    await run_in_threadpool(moved)
    return studio.robot.view()


@router.post("/jog/end")
async def end_jog(studio: TheStudio) -> dict[str, Any]:
    """Ends a jog early: the move that is on goes to its end, no further one is sent, the robot stays armed.

    Anybody may do it, as with Stop. Without a jog it does nothing.
    """
    if studio.robot.bridge.snapshot.jog is not None:
        await run_in_threadpool(studio.robot.bridge.end_early)
    return studio.robot.view()


@router.post("/jog/ghost", response_class=Response)
async def ghost(studio: TheStudio, target: Ghost) -> Response:
    """The robot at the target as poses of lines; binary, laid out as those of a plan."""
    steps = target.wish()

    def blob() -> bytes:
        motion = studio.jog.ghost(steps, (target.x, target.y, target.heading))
        return ghost_blob(steps.model, motion).to_bytes()

    return Response(await run_in_threadpool(blob), media_type="application/octet-stream")


def _step(step: JogStepBody) -> JogStep:
    foot, motor = (None if number is None else number - 1 for number in (step.foot, step.motor))
    return JogStep(step.part, step.by_mm / 1000.0, foot, motor, step.axis)


def _look(model: RobotModel, look: JogRangesBody | None) -> JogLook | None:
    if look is None:
        return None
    if not 1 <= look.foot <= model.leg_count:
        raise InputError(f"There is no foot {look.foot}; it must lie in 1 to {model.leg_count}.", "look.foot")
    return JogLook(look.part, look.foot - 1)
