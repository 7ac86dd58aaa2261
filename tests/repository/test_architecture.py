"""Who may import whom: the table of the architecture, held against every import in the code."""

from __future__ import annotations

import ast
import subprocess
import sys
from collections.abc import Iterator

import pytest

from tests.support.studio_process import PROJECT

PARTS = ("core", "solver_jobs", "app", "robot_description")
SOLVERS = {"casadi", "ortools", "mujoco"}
SHAPES = {"viser", "trimesh", "yourdfpy"}
MODULES_OF = {
    "cv2": {"app/vision/opencv.py"},
    "mcap": {"app/runs/mcap_file.py"},
}
"""Packages that few modules alone may import."""
SEEING = {"app/vision/video_io.py", "app/vision/blobs.py", "app/vision/checkerboard.py"}
"""Modules that use OpenCV, in processes of their own."""
WEB = {"fastapi", "fastapi_offline", "starlette", "uvicorn"}


def modules() -> list[str]:
    return sorted(str(p.relative_to(PROJECT)) for part in PARTS for p in (PROJECT / part).rglob("*.py"))


def imports(path: str) -> Iterator[str]:
    tree = ast.parse((PROJECT / path).read_text())
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            yield str(node.module) if node.level == 0 else f"relative:{node.module}"


def forbidden(path: str, name: str) -> bool:
    top = name.split(".")[0]
    if name.startswith("relative:"):
        return True
    if name == "app.vision.opencv":
        return path not in SEEING
    if top in MODULES_OF:
        return path not in MODULES_OF[top]
    if path.startswith("core/"):
        return top in SOLVERS | SHAPES | WEB | {
            "pydantic",
            "serial",
            "app",
            "solver_jobs",
            "robot_description",
        }
    if path.startswith("solver_jobs/"):
        return top in SHAPES | WEB | {"pydantic", "serial", "app", "robot_description"}
    if path.startswith("robot_description/"):
        return top in SOLVERS | WEB | {"pydantic", "serial", "app", "solver_jobs", "viser", "yourdfpy"}
    return forbidden_in_app(path, name, top)


def forbidden_in_app(path: str, name: str, top: str) -> bool:
    if top in SOLVERS or top == "robot_description" or name.startswith("solver_jobs."):
        return True
    if path.startswith(("app/bridge/", "app/emulator/")):
        allowed_serial = path == "app/bridge/transport.py"
        leaf = top == "app" and not name.startswith(("app.bridge", "app.emulator"))
        return (
            leaf
            or top in SHAPES | WEB | {"pydantic", "solver_jobs"}
            or (top == "serial" and not allowed_serial)
        )
    if top in SHAPES:
        return not path.startswith("app/scene/")
    if top in WEB:
        edge = ("app/server/", "app/web/", "app/routes/")
        return not path.startswith(edge)
    if top == "pydantic":
        files = {"app/documents/gait_json.py", "app/documents/gait_schema.py", "app/cameras/setup_schema.py"}
        return path not in files and not path.startswith(("app/routes/", "app/web/"))
    return top == "serial"


@pytest.mark.parametrize("path", modules())
def test_a_module_imports_only_what_its_room_may(path: str) -> None:
    assert [name for name in imports(path) if forbidden(path, name)] == []


@pytest.mark.parametrize(
    ("path", "name"),
    [
        ("core/robot/leg.py", "casadi"),
        ("core/robot/leg.py", "app.session.command_queue"),
        ("solver_jobs/workers/nlp_worker.py", "fastapi"),
        ("app/studio/studio.py", "solver_jobs.workers.job_queue"),
        ("app/studio/studio.py", "serial"),
        ("app/studio/studio.py", "viser"),
        ("app/bridge/bridge.py", "app.session.command_queue"),
        ("app/bridge/bridge.py", "serial"),
        ("app/gaits/service.py", "pydantic"),
        ("app/vision/video_io.py", "cv2"),
        ("app/trials/service.py", "app.vision.opencv"),
        ("app/runs/service.py", "mcap.writer"),
    ],
)
def test_the_table_refuses(path: str, name: str) -> None:
    assert forbidden(path, name)


def test_core_touches_no_clock_thread_socket_or_file() -> None:
    loaders = {"core/robot/model.py", "core/data/tables.py"}
    banned = {"time", "threading", "socket", "os", "pathlib", "subprocess", "asyncio", "queue"}
    for path in modules():
        if path.startswith("core/"):
            used = {name.split(".")[0] for name in imports(path)}
            assert not used & banned, path
            assert path in loaders or "importlib" not in used, path


def test_nothing_waits_for_files_from_elsewhere() -> None:
    pages = [p for p in (PROJECT / "app" / "static").rglob("*") if p.suffix in (".html", ".js", ".css")]
    assert pages
    for page in pages:
        text = page.read_text()
        assert "https://" not in text.replace("https://www.w3.org", ""), page


def test_the_server_leaves_opencv_to_its_processes() -> None:
    words = "import sys, app.server.application; sys.exit('cv2' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", words], check=False).returncode == 0
