"""Simulations that are kept: figures with the motion, and the simulated robot for 3D."""

from fastapi import APIRouter
from fastapi.responses import Response
from starlette.concurrency import run_in_threadpool

from app.common.json import Json
from app.scene.simulated_ghost import simulated_blob
from app.store.tables.table import reading
from app.web.dependencies import TheStudio
from core.robot.model import load_robot

router = APIRouter(prefix="/api/simulations", tags=["simulations"])


@router.get("/sets")
async def read_sets(robot: str, studio: TheStudio) -> Json:
    """The sets of physics parameters that fit a robot: its usual one, the program's others, learned ones."""
    found = await run_in_threadpool(studio.learning.sets.fitting, load_robot(robot))
    return {"sets": [{"name": one.name, "title": one.title} for one in found]}


@router.get("/{key}")
async def read_simulation(key: str, studio: TheStudio) -> Json:
    """A simulation: parameters, report, findings, variations and the motion on the plan's time axis; SI."""
    return await run_in_threadpool(studio.simulations.content, key)


@router.get("/{key}/ghost", response_class=Response)
async def read_ghost(key: str, studio: TheStudio) -> Response:
    """The simulated robot as poses of lines with contacts and slip marks, on the plan's time axis; binary."""

    def blob() -> bytes:
        content = studio.simulations.content(key)
        with reading("This simulation cannot be read: "):
            return simulated_blob(load_robot(content["robot"]), content["motion"]).to_bytes()

    return Response(await run_in_threadpool(blob), media_type="application/octet-stream")
