"""A page with nothing but the preview, and the application that serves it, for browser tests."""

from __future__ import annotations

from importlib import resources

from fastapi import FastAPI, Response
from fastapi.responses import HTMLResponse
from fastapi.staticfiles import StaticFiles

from app.routes.viser_proxy import make_viser_router
from app.scene import Scenes, plan_poses
from core.gait.gait import motion_problem
from core.library.library import optimised_entry
from core.motion.trajectory import Trajectory
from core.problem.initial_guess import initial_guess
from core.robot.model import load_robot

PAGE = """<!doctype html><title>Preview</title>
<link rel="icon" href="data:,">
<style>body { margin: 0 } iframe { border: 0; width: 100vw; height: 100vh; display: block }</style>
<iframe title="3D preview"></iframe>
<script type="module">
  import { Preview } from "/static/preview/preview.js";
  import { Playback } from "/static/preview/playback.js";
  const frame = document.querySelector("iframe");
  const preview = new Preview(frame);
  await preview.ready();
  const info = await preview.loadPoses("/poses");
  const playback = new Playback({ duration: info.duration, step: 0.4 });
  playback.addEventListener("time", (event) => preview.setTime(event.detail.time));
  Object.assign(window, { preview, playback, loaded: true });
</script>
"""


def walk() -> Trajectory:
    """The drawn (not optimised) walk of the gait library."""
    return initial_guess(motion_problem(optimised_entry("walk").gait, load_robot("deltawalker")))


def preview_application(scenes: Scenes) -> FastAPI:
    """Serves the page at /, the walk's poses at /poses, the modules and the Viser client."""
    app = FastAPI()
    app.include_router(make_viser_router(scenes.of))
    app.mount("/static", StaticFiles(directory=str(resources.files("app").joinpath("static"))))
    blob = plan_poses(load_robot("deltawalker"), walk()).to_bytes()

    @app.get("/")
    def page() -> HTMLResponse:
        return HTMLResponse(PAGE)

    @app.get("/poses")
    def poses() -> Response:
        return Response(blob, media_type="application/octet-stream")

    return app
