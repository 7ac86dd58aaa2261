"""The web application: page, API, events and the 3D preview behind one port."""

from __future__ import annotations

from importlib import resources
from typing import Any

from fastapi import FastAPI
from fastapi.responses import FileResponse
from fastapi.staticfiles import StaticFiles
from fastapi_offline import FastAPIOffline
from starlette.middleware import Middleware
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from app.documents import gait_schema
from app.routes import events, gaits, jobs, robot
from app.routes.edge import install_error_handlers
from app.routes.viser import make_viser_router
from app.scene.server import SceneServer
from app.security import Access, Guard
from app.studio import Studio
from app.version import VERSION

MOST_MESSAGE_BYTES = 64 * 1024 * 1024
"""Largest web-socket message; the scene's meshes travel in one."""


class Revalidated:
    """ASGI wrapper that makes browsers ask whether a file changed before they use their copy."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Adds the header to a response."""

        async def sending(message: Message) -> None:
            if message["type"] == "http.response.start":
                message = {**message, "headers": [*message["headers"], (b"cache-control", b"no-cache")]}
            await send(message)

        await self._app(scope, receive, sending)


def make_app(studio: Studio, scene: SceneServer, access: Access) -> FastAPI:
    """Assembles the routes.

    Args:
        studio: everything with state.
        scene: the running 3D scene.
        access: who may talk to it.
    """
    app = FastAPIOffline(
        title="Footfall Studio",
        version=VERSION,
        redoc_url=None,
        middleware=[Middleware(Guard, access=access)],
    )
    app.state.studio = studio
    app.state.scene = scene
    install_error_handlers(app)
    for router in (gaits.router, jobs.router, robot.router, events.router, make_viser_router(scene)):
        app.include_router(router)
    static = str(resources.files("app").joinpath("static"))

    @app.get("/api/health", tags=["studio"])
    async def health() -> dict[str, str]:
        """Whether the studio answers."""
        return {"status": "ok", "version": VERSION}

    @app.get("/api/schema/gait", tags=["gaits"])
    async def schema() -> dict[str, Any]:
        """JSON Schema of the gait document."""
        return gait_schema()

    @app.get("/", include_in_schema=False)
    async def page() -> FileResponse:
        return FileResponse(f"{static}/index.html", headers={"cache-control": "no-cache"})

    app.mount("/static", Revalidated(StaticFiles(directory=static)), name="static")
    return app
