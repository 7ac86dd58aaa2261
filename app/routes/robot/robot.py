"""The robot: its state, the actions that move it or stop it, and faults of the emulated one."""

import asyncio
from collections.abc import Callable
from dataclasses import replace
from enum import StrEnum
from typing import Annotated, Literal

import numpy as np
from fastapi import APIRouter, Body, Response
from pydantic import Field
from starlette.concurrency import run_in_threadpool

from app.bridge.run_range import RunRange
from app.common.json import Json
from app.emulator.faults import Fault, FaultRequest
from app.scene.poses import pose_frames
from app.studio.studio import Studio
from app.undo.history import Author
from app.web.dependencies import MOST_NAME, RequestBody, TheAuthor, TheStudio, on_planned
from core.names import is_visible

router = APIRouter(prefix="/api/robot", tags=["robot"])

SOMEBODY = "somebody on the page"


class ActorBody(RequestBody):
    """Who does it."""

    by: str = Field(default=SOMEBODY, max_length=MOST_NAME)


TheActor = Annotated[ActorBody | None, Body()]


class Connect(ActorBody):
    """Which robot to connect; the studio's own where none is named."""

    device: str | None = Field(default=None, max_length=200)


class Send(ActorBody):
    """Which gait to send, the hash that the person saw, and which of its waypoints."""

    gait: str
    waypoints_hash: str | None = None
    first: int = Field(default=0, alias="from")
    """Waypoint to begin with, 0-based; all feet must be down there."""
    iterations: int = 1


class FaultBody(RequestBody):
    """Which fault strikes; `none` ends those that last."""

    name: Fault | Literal["none"]
    motors: list[int] = Field(default=[], max_length=2)
    """Which motors, from 1; of a fault of motors, its usual ones where none are named."""


async def _moved(
    studio: Studio,
    author: Author,
    actor_body: ActorBody | None,
    action: Callable[[str], object],
) -> Json:
    """Does what needs the lease, in the name of who does it."""
    actor = named(author, actor_body)

    def done() -> None:
        with studio.robot.lease.held_by(actor):
            action(actor.name or SOMEBODY)

    await run_in_threadpool(done)
    return studio.robot.view()


def named(author: Author, actor_body: ActorBody | None) -> Author:
    """Who does it: the name in the body goes before that of the page."""
    named = actor_body is not None and "by" in actor_body.model_fields_set and is_visible(actor_body.by)
    return replace(author, name=actor_body.by) if actor_body is not None and named else author


@router.get("/poses", response_class=Response)
async def measured_poses(studio: TheStudio) -> Response:
    """The robot in a run by its measured strokes, as one pose of all nodes; binary, laid out as a plan's."""

    def blob() -> bytes:
        now = studio.robot.measured()
        alone = (np.zeros(1), now.com_world[None], np.array([now.heading]), now.feet_world[None])
        return pose_frames(now.model, *alone).to_bytes()

    return Response(await run_in_threadpool(blob), media_type="application/octet-stream")


@router.get("")
async def read_robot(studio: TheStudio) -> Json:
    """Link, robot, run, measured strokes, and who holds the robot."""
    return studio.robot.view()


@router.get("/ports")
async def read_ports(studio: TheStudio) -> Json:
    """Serial devices with description and serial number, the last one, and where a lost one is now."""
    return await run_in_threadpool(studio.robot.ports_view)


@router.get("/transitions")
async def read_transitions(studio: TheStudio) -> Json:
    """The last changes of link and robot with their causes, oldest first."""
    return {"transitions": studio.robot.transitions()}


@router.post("/connect")
async def connect(
    studio: TheStudio, author: TheAuthor, actor_body: Annotated[Connect | None, Body()] = None
) -> Json:
    """Opens the line. The board may reset, and its motors may move for about 8 s."""
    return await _moved(
        studio, author, actor_body, lambda _: studio.robot.connect(actor_body.device if actor_body else None)
    )


@router.post("/disconnect", responses={202: {"description": "The stop is not confirmed yet; it goes on."}})
async def disconnect(
    studio: TheStudio, author: TheAuthor, response: Response, actor_body: TheActor = None
) -> Json:
    """Stops a run and closes the line; nobody holds the robot then.

    The line stays open until the robot has confirmed the stop, 6 s at most. After 4 s the answer is 202 with
    `disconnecting` true; the rest goes on by itself, and the robot's state shows its end.
    """
    if not await run_in_threadpool(studio.robot.disconnect, named(author, actor_body)):
        response.status_code = 202
    return studio.robot.view()


async def send_stop(studio: Studio, by: str) -> None:
    """Stops the robot; a name that is too long or none is no reason to refuse it.

    Args:
        studio: whose robot.
        by: who stops it.
    """
    name = by.replace("\0", "").strip()[:MOST_NAME] if is_visible(by) else SOMEBODY
    # On this very thread: on a busy computer each further one takes its time to wake up.
    left = studio.robot.bridge.try_stop(name)
    if left is not None:
        # A lane of its own: it must not wait behind anything else that the server does.
        await asyncio.get_running_loop().run_in_executor(studio.stop_executor, left)


@router.post("/stop")
async def stop(studio: TheStudio, by: str = SOMEBODY) -> Json:
    """Stops the robot: at once on the wire, in effect after the move that is running.

    A body is not read, and the lease is not asked for. Of a long name 80 characters are kept.
    """
    await send_stop(studio, by)
    return studio.robot.view()


@router.post("/send")
async def send(studio: TheStudio, author: TheAuthor, wish: Send) -> Json:
    """Sends a gait's approved waypoints, after the slow way to the start pose."""
    actor, run_range = named(author, wish), RunRange(wish.first, wish.iterations)

    def sent() -> None:
        with studio.robot.lease.held_by(actor):
            open_gait, plan = studio.gaits.confirmed(wish.gait), studio.gaits.plan(wish.gait)
            studio.robot.send(open_gait, plan, wish.waypoints_hash, actor.name or SOMEBODY, run_range)

    with studio.robot.lease.awaiting():
        await on_planned(studio, wish.gait, sent)
    return studio.robot.view()


@router.post("/arm")
async def arm(studio: TheStudio, author: TheAuthor, actor_body: TheActor = None) -> Json:
    """Lets the robot be moved."""
    return await _moved(studio, author, actor_body, studio.robot.bridge.arm)


@router.post("/pause")
async def pause(studio: TheStudio, author: TheAuthor, actor_body: TheActor = None) -> Json:
    """Waits at the next pose with all feet down."""
    return await _moved(studio, author, actor_body, studio.robot.bridge.pause)


@router.post("/resume")
async def resume(studio: TheStudio, author: TheAuthor, actor_body: TheActor = None) -> Json:
    """Goes on with a paused run."""
    return await _moved(studio, author, actor_body, studio.robot.bridge.resume)


@router.post("/clear")
async def clear(studio: TheStudio, author: TheAuthor, actor_body: TheActor = None) -> Json:
    """Lets a stopped robot go after replacing its target by where it stands."""
    return await _moved(studio, author, actor_body, studio.robot.bridge.clear)


@router.post("/reset")
async def reset(studio: TheStudio, author: TheAuthor, actor_body: TheActor = None) -> Json:
    """Sends every motor to 0.5 mm."""
    return await _moved(studio, author, actor_body, studio.robot.bridge.reset)


class HandOver(StrEnum):
    """What can be done about who holds the robot."""

    ASK = "ask"
    """Asks the holder for it; where nobody holds it, it is theirs at once."""
    GIVE = "give"
    """The holder gives it to whoever asked."""
    KEEP = "keep"
    """The holder says no."""
    TAKE = "take"
    """Takes it from a holder who is gone, or from a script."""
    RELEASE = "release"
    """The holder lets it go."""


@router.post("/lease/{act}")
async def hand_over(studio: TheStudio, author: TheAuthor, act: HandOver, actor_body: TheActor = None) -> Json:
    """Asks for the robot, gives it, keeps it, takes it over or lets it go."""
    lease, actor = studio.robot.lease, named(author, actor_body)
    verbs: dict[HandOver, Callable[[Author], None]] = {
        HandOver.ASK: lease.ask,
        HandOver.GIVE: lease.give,
        HandOver.KEEP: lease.keep,
        HandOver.TAKE: lease.take,
        HandOver.RELEASE: lease.release,
    }
    await run_in_threadpool(verbs[act], actor)
    return studio.robot.view()


@router.post("/fault")
async def strike(studio: TheStudio, wish: FaultBody) -> Json:
    """Has something go wrong with the emulated robot at once; a real one is never touched."""
    motors = tuple(motor - 1 for motor in wish.motors)
    fault = None if wish.name == "none" else FaultRequest(wish.name, motors)
    await run_in_threadpool(studio.robot.strike, fault)
    return studio.robot.view()
