"""The fastest gait for the robot's clock: prices of options, the search, and a gait made of an answer."""

import math
from functools import partial
from typing import Annotated

from fastapi import APIRouter
from fastapi.responses import StreamingResponse
from pydantic import Field
from starlette.concurrency import run_in_threadpool

from app.common.json import Json
from app.fastest.request import Course, FastestRequest
from app.web.dependencies import RequestBody, TheStudio, changed, on_command_thread
from app.web.state_lines import state_lines
from core.gait.gait import MOST_NAME
from core.pose_gaits.pose_problem import MOST_CYCLES
from core.robot.arms import ARM_GAP

router = APIRouter(prefix="/api/fastest", tags=["fastest"])

MOST_FEET = 12
Finite = Annotated[float, Field(allow_inf_nan=False)]


class FastestBody(RequestBody):
    """A request for the fastest gait, SI; limits are those of `footfall fastest`."""

    robot: str = Field(default="deltawalker", max_length=80)
    order: list[Annotated[int, Field(ge=1, le=MOST_FEET)]] = Field(
        default=[1, 2, 3, 4], min_length=1, max_length=MOST_FEET
    )
    heading: Finite = Field(default=0.0, ge=-2.0 * math.pi, le=2.0 * math.pi, description="rad from x")
    overlap: bool = False
    course: Course = Field(
        default=Course.WALK,
        description="a walk, or on the spot a turn by `turn` or the fastest one to the left or right",
    )
    turn: Finite = Field(default=0.0, description="of a walk or a turn, rad a cycle, to the left above 0")
    step: Finite | None = Field(
        default=None, description="of a walk, m a cycle; null for the fastest", gt=0.0
    )
    margin: Finite = 0.006
    clearance: Finite = 0.003
    stop_bound: Finite = 1.5
    slip: Finite = 0.0005
    shoe_distance: Finite = 0.028
    arm_distance: Finite = ARM_GAP
    sway: Finite = 0.0
    cycles: int = Field(default=3, ge=1, le=MOST_CYCLES)

    def request(self) -> FastestRequest:
        """The request.

        Raises:
            InputError: it asks for what such a gait cannot have.
        """
        words = {name: getattr(self, name) for name in FastestBody.model_fields}
        request = FastestRequest(**{**words, "order": tuple(self.order)})
        request.problem()
        return request


class SearchBody(FastestBody):
    """A search over all foot orders; with a front, also over margins and stop bounds."""

    front: bool = False


class NewFastest(FastestBody):
    """A gait that asks this, under a name."""

    name: str = Field(min_length=1, max_length=MOST_NAME)


@router.post("/prices", response_model=Json)
async def prices(asked: FastestBody, studio: TheStudio) -> StreamingResponse:
    """How fast the fastest gait is with each value of each option, one JSON object a line (NDJSON).

    The first line has `options`: each with its `group`, `value` and `price` in mid-walk, null where it is not
    known yet. Each other line has `prices`, which are options with their `number` in that list. A `price`
    whose `pace` (m/s, on the spot rad/s) is null says that there is no such gait. It ends with the request.
    """
    request = await run_in_threadpool(asked.request)
    return await state_lines(partial(studio.fastest.prices, request))


@router.post("/searches", status_code=202)
async def search(asked: SearchBody, studio: TheStudio) -> Json:
    """Starts a search as a job; its result has `tried`, and with a front the gaits that none other beats."""
    request = await run_in_threadpool(asked.request)
    return await on_command_thread(studio, lambda: studio.job_commands.submit_fastest(request, asked.front))


@router.post("/gaits", status_code=201)
async def create(asked: NewFastest, studio: TheStudio) -> Json:
    """Saves a new gait that asks this, and gives its view; its poses are looked for by themselves."""
    request = await run_in_threadpool(asked.request)
    document = request.document(asked.name)
    return await changed(studio, lambda: studio.gaits.create(document))
