"""The robots that a gait may be for, and new gaits for them."""

from fastapi import APIRouter
from pydantic import Field

from app.common.json import Json
from app.web.dependencies import FiniteBody, TheStudio, changed
from core.gait.foot_orders import named_orders
from core.gait.gait import MOST_NAME, Gait, Orientation
from core.gait.options import LEAST_PHASE_KNOTS, MOST_CLOSING_KNOTS, MOST_PHASE_KNOTS, GaitOptions
from core.library.new_gait import DEFAULT_STEP, default_phase_knots, drawn_gait
from core.robot.model import ROBOT_NAMES, RobotModel, load_robot

router = APIRouter(prefix="/api", tags=["robots"])


class NewGait(FiniteBody):
    """What a new gait is drawn from; m, feet count from 1. Without an order the robot's first one holds."""

    name: str = Field(max_length=MOST_NAME)
    robot: str = "deltawalker"
    orientation: Orientation = Orientation.FB
    order: list[int] | None = Field(default=None, max_length=64)
    step: float = DEFAULT_STEP
    phase_knots: int | None = Field(default=None, ge=LEAST_PHASE_KNOTS, le=MOST_PHASE_KNOTS)
    closing_knots: int = Field(default=GaitOptions.closing_knots, ge=0, le=MOST_CLOSING_KNOTS)
    iterations: int = Field(default=1, ge=1, le=20)


@router.get("/robots")
async def list_robots() -> Json:
    """Every robot with its title, its legs and motors, and foot orders that work for it."""
    return {"robots": [robot_content(load_robot(name)) for name in ROBOT_NAMES]}


def robot_content(model: RobotModel) -> Json:
    """A robot as JSON content; feet count from 1, m."""
    return {
        "name": model.name,
        "title": model.title,
        "legs": model.leg_count,
        "strokes": model.motor_count,
        "motors": model.actuator_count,
        "coupled": model.is_coupled,
        "wired": model.wired,
        "phase_knots": default_phase_knots(model),
        "step": DEFAULT_STEP,
        "margin": model.margin,
        "orders": {
            orientation.value: [
                {"name": order.name, "feet": list(order.feet)} for order in named_orders(model, orientation)
            ]
            for orientation in Orientation
        },
    }


@router.post("/gaits/drawn", status_code=201, tags=["gaits"])
async def create_drawn_gait(asked: NewGait, studio: TheStudio) -> Json:
    """Saves a new gait whose feet step one after the other."""
    gait = _drawn(asked)
    return await changed(studio, lambda: studio.gaits.create(gait))


def _drawn(asked: NewGait) -> Gait:
    model = load_robot(asked.robot)
    return drawn_gait(
        model,
        asked.name,
        asked.orientation,
        named_orders(model, asked.orientation)[0].feet if asked.order is None else asked.order,
        asked.step,
        phase_knots=asked.phase_knots or default_phase_knots(model),
        closing_knots=asked.closing_knots,
        iterations=asked.iterations,
    )
