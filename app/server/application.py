"""The web application: page, API, events and the 3D preview behind one port."""

from pathlib import Path
from typing import Any

from fastapi import FastAPI
from fastapi.responses import HTMLResponse
from fastapi_offline import FastAPIOffline
from starlette.middleware import Middleware

from app.common.version import VERSION
from app.documents.gait_json import gait_schema
from app.routes import atlases, events, jobs, robots, scene, storage
from app.routes.gaits import (
    approvals,
    conversions,
    exports,
    fastest,
    gaits,
    live,
    sequences,
    simulations,
    versions,
)
from app.routes.gaits import segment_tables as tables
from app.routes.lab import camera_setups as setups
from app.routes.lab import cameras, learning, published, trial_comparisons, trial_photos, trials, videos
from app.routes.patterns import search as patterns
from app.routes.robot import jog, motor_test, robot, runs
from app.routes.viser_proxy import make_viser_router
from app.scene.registry import Scenes
from app.server.admission import Admission
from app.server.pace import Pace
from app.studio.studio import Studio
from app.web.access import Access, Guard
from app.web.api_page import add_api_page
from app.web.assets import REVALIDATED, Assets
from app.web.body_limit import BodyLimit
from app.web.dependencies import install_error_handlers
from app.web.head_requests import HeadRequests
from app.web.page import ModulePage
from app.web.socket_limit import SocketLimit
from core.data.tables import package_files

_ROUTERS = (
    exports.router,
    sequences.router,
    gaits.router,
    live.router,
    fastest.router,
    conversions.router,
    approvals.router,
    versions.router,
    jobs.router,
    storage.router,
    atlases.router,
    patterns.router,
    robot.router,
    jog.router,
    motor_test.router,
    runs.router,
    simulations.router,
    tables.router,
    trial_comparisons.router,
    trial_photos.router,
    trials.router,
    learning.router,
    published.router,
    setups.router,
    videos.router,
    cameras.router,
    robots.router,
    scene.router,
    events.router,
)
"""A router whose paths would also fit another one's stands before that."""


def make_app(studio: Studio, scenes: Scenes, access: Access) -> FastAPI:
    """Assembles the routes.

    Args:
        studio: everything with state.
        scenes: the 3D scenes.
        access: who may talk to it.
    """
    app = FastAPIOffline(
        title="Footfall Studio",
        version=VERSION,
        docs_url=None,
        redoc_url=None,
        middleware=[
            Middleware(Pace),
            Middleware(Guard, access=access),
            Middleware(Admission),
            Middleware(HeadRequests),
            Middleware(BodyLimit),
            Middleware(SocketLimit),
        ],
    )
    app.state.studio = studio
    add_api_page(app)
    install_error_handlers(app)
    for router in (*_ROUTERS, make_viser_router(scenes.of)):
        app.include_router(router)
    static = Path(str(package_files("app").joinpath("static"))).resolve()

    module_page = ModulePage(static)

    @app.get("/api/health", tags=["studio"])
    async def health() -> dict[str, Any]:
        """Whether the studio answers, and what is wrong with its database."""
        return {"status": "ok", "version": VERSION, "storage": studio.storage.view()}

    @app.get("/api/schema/gait", tags=["gaits"])
    async def schema() -> dict[str, Any]:
        """JSON Schema of the gait document."""
        return gait_schema()

    @app.get("/", include_in_schema=False)
    async def page() -> HTMLResponse:
        return HTMLResponse(module_page.now().text, headers=REVALIDATED)

    app.mount("/static", Assets(static, module_page), name="static")
    return app
