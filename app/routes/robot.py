"""The robot: its state, and the verbs that move it or stop it."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from typing import Annotated, Any

from fastapi import APIRouter, Body, Depends, Query
from pydantic import BaseModel, ConfigDict, Field
from starlette.concurrency import run_in_threadpool

from app.routes.edge import on_session, studio_of
from app.studio import Studio

router = APIRouter(prefix="/api/robot", tags=["robot"])
TheStudio = Annotated[Studio, Depends(studio_of)]

SOMEBODY = "somebody on the page"


class Deed(BaseModel):
    """Who does it."""

    model_config = ConfigDict(extra="forbid")
    by: str = Field(default=SOMEBODY, max_length=80)


class Connect(Deed):
    """Which robot to connect; the studio's own where none is named."""

    device: str | None = Field(default=None, max_length=200)


class Send(Deed):
    """Which gait to send, and the hash that the person saw."""

    gait: str
    waypoints_hash: str | None = None


async def _done(studio: Studio, action: Callable[[], object]) -> dict[str, Any]:
    await run_in_threadpool(action)
    return studio.robot.view()


@router.get("")
async def read_robot(studio: TheStudio) -> dict[str, Any]:
    """Link, robot, run and measured strokes."""
    return studio.robot.view()


@router.post("/connect")
async def connect(studio: TheStudio, deed: Annotated[Connect | None, Body()] = None) -> dict[str, Any]:
    """Opens the line. The board may reset, and its motors may move for about 8 s."""
    return await _done(studio, lambda: studio.robot.connect(deed.device if deed else None))


@router.post("/disconnect")
async def disconnect(studio: TheStudio, deed: Annotated[Deed | None, Body()] = None) -> dict[str, Any]:
    """Stops a run and closes the line."""
    del deed
    return await _done(studio, studio.robot.disconnect)


@router.post("/stop")
async def stop(studio: TheStudio, by: Annotated[str, Query(max_length=80)] = SOMEBODY) -> dict[str, Any]:
    """Stops the robot: at once on the wire, in effect after the move that is running. A body is not read."""
    # A lane of its own: it must not wait behind anything else that the server does.
    await asyncio.get_running_loop().run_in_executor(studio.stop_lane, studio.robot.bridge.stop, by)
    return studio.robot.view()


@router.post("/send")
async def send(studio: TheStudio, wish: Send) -> dict[str, Any]:
    """Sends a gait's approved waypoints, after the slow way to the start pose."""

    def sent() -> None:
        open_gait, plan = studio.gaits.open_gait(wish.gait), studio.gaits.plan(wish.gait)
        studio.robot.send(open_gait, plan, wish.waypoints_hash, wish.by)

    await on_session(studio, sent)
    return studio.robot.view()


@router.post("/arm")
async def arm(studio: TheStudio, deed: Annotated[Deed | None, Body()] = None) -> dict[str, Any]:
    """Lets the robot be moved."""
    return await _done(studio, lambda: studio.robot.bridge.arm(_by(deed)))


@router.post("/pause")
async def pause(studio: TheStudio, deed: Annotated[Deed | None, Body()] = None) -> dict[str, Any]:
    """Waits at the next pose with all feet down."""
    return await _done(studio, lambda: studio.robot.bridge.pause(_by(deed)))


@router.post("/resume")
async def resume(studio: TheStudio, deed: Annotated[Deed | None, Body()] = None) -> dict[str, Any]:
    """Goes on with a paused run."""
    return await _done(studio, lambda: studio.robot.bridge.resume(_by(deed)))


@router.post("/clear")
async def clear(studio: TheStudio, deed: Annotated[Deed | None, Body()] = None) -> dict[str, Any]:
    """Lets a stopped robot go after replacing its target by where it stands."""
    return await _done(studio, lambda: studio.robot.bridge.clear(_by(deed)))


@router.post("/reset")
async def reset(studio: TheStudio, deed: Annotated[Deed | None, Body()] = None) -> dict[str, Any]:
    """Sends every motor to 0.5 mm."""
    return await _done(studio, lambda: studio.robot.bridge.reset(_by(deed)))


def _by(deed: Deed | None) -> str:
    return SOMEBODY if deed is None else deed.by
