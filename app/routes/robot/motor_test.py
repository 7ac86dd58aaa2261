"""The guided motor test: all motors, one after the other, with a verdict on each."""

from typing import Annotated

from fastapi import APIRouter, Body
from pydantic import BaseModel
from starlette.concurrency import run_in_threadpool

from app.bridge.states import MotorTestState
from app.common.json import Json
from app.routes.robot.robot import SOMEBODY, ActorBody, named
from app.web.dependencies import TheAuthor, TheStudio
from core.jog.motor_test import MotorVerdict
from core.robot.model import load_robot

router = APIRouter(prefix="/api/robot/motor-test", tags=["robot"])


class MotorTestBody(ActorBody):
    """Which robot is meant: the test refuses one that no cable leads to."""

    robot: str = "deltawalker"


class MotorView(BaseModel):
    """The verdict on one motor."""

    motor: int
    """Of all motors, from 1."""
    foot: int
    """From 1."""
    motor_of_foot: int
    """Within the foot, from 1."""
    verdict: MotorVerdict
    sentence: str
    """What was seen."""
    remedy: str
    """What to do; empty for a good motor."""
    moved_mm: float | None
    """How far it went towards its target, mm; below 0 the wrong way."""
    off_mm: float | None
    """How far it stayed from its target, mm; of a motor that stays short or goes too far."""
    other: int | None
    """Motor that moved in its place, from 1."""


class MotorTestView(BaseModel):
    """The motor test that is on or was the last since the studio was started."""

    state: MotorTestState | None
    """None where none was made."""
    by: str
    at: float | None
    """When it last changed, s since 1970."""
    motor: int | None
    """Motor under test, from 1."""
    sentence: str
    findings: list[MotorView]


@router.get("", response_model=MotorTestView)
async def read_motor_test(studio: TheStudio) -> Json:
    """How far the motor test is, and the verdict on each motor so far."""
    return studio.motor_test.view()


@router.post("", response_model=MotorTestView)
async def start_motor_test(
    studio: TheStudio, author: TheAuthor, wish: Annotated[MotorTestBody | None, Body()] = None
) -> Json:
    """Moves all motors, one after the other, 4 mm out and back; takes about 45 s.

    Needs an armed robot that does not move, and the lease. Stop ends it at once, `cancel` after the motor
    that is being tested. Events of the type `motor_test` tell each verdict.
    """
    actor, model = named(author, wish), load_robot("deltawalker" if wish is None else wish.robot)

    def started() -> None:
        with studio.robot.lease.held_by(actor):
            studio.motor_test.start(model, actor.name or SOMEBODY)

    await run_in_threadpool(started)
    return studio.motor_test.view()


@router.post("/cancel", response_model=MotorTestView)
async def cancel_motor_test(studio: TheStudio) -> Json:
    """Ends the motor test once the motor that is being tested is back; the robot stays armed.

    Anybody may, as with Stop and the end of a jog.
    """
    await run_in_threadpool(studio.motor_test.cancel)
    return studio.motor_test.view()
