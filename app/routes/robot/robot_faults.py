"""Faults of the emulated robot, on request, so that a person can learn what each one looks like."""

from typing import Annotated, Any, Literal

from fastapi import APIRouter, Depends
from starlette.concurrency import run_in_threadpool

from app.emulator.faults import Fault
from app.studio.studio import Studio
from app.web.dependencies import RequestBody, studio_of

router = APIRouter(prefix="/api/robot", tags=["robot"])


class FaultWish(RequestBody):
    """Which fault strikes; `none` ends those that last."""

    name: Fault | Literal["none"]


@router.post("/fault")
async def strike(studio: Annotated[Studio, Depends(studio_of)], wish: FaultWish) -> dict[str, Any]:
    """Has something go wrong with the emulated robot at once; a real one is never touched."""
    fault = None if wish.name == "none" else wish.name
    await run_in_threadpool(studio.robot.strike, fault)
    return studio.robot.view()
