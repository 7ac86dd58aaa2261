"""Who may import which package: the table of the architecture, held against every import in the code.

The order of the folders is in `test_rooms.py`.
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
from collections.abc import Iterable
from pathlib import Path

import pytest

from app.cli import main
from tests.repository.source_tree import PAGE_CODE, STATIC, files, imports, listed
from tests.support.studio_process import PROJECT

SOLVERS = {"casadi", "ortools", "mujoco"}
SHAPES = {"viser", "trimesh", "yourdfpy"}
WEB = {"fastapi", "fastapi_offline", "starlette", "uvicorn"}
WEB_EDGE = ("app/server/", "app/web/", "app/routes/")
CABLE = ("app.bridge", "app.emulator")

ONE_MODULE = {
    "cv2": "app/vision/opencv.py",
    "mcap": "app/runs/export.py",
    "serial": "app/bridge/transport.py",
}
"""Packages that one module alone imports."""
HEAVY = SOLVERS | SHAPES | WEB | {"PIL", "app.bench", "cv2", "pydantic", "scipy", "solver_jobs"}
"""What a command that needs no solver, gait document or server does without."""
OPENCV_USERS = {f"app/vision/{name}.py" for name in ("video_io", "video_file", "blobs", "checkerboard")}
"""Modules that use OpenCV, in processes of their own."""
SCHEMAS = {"app/documents/gait_json.py", "app/documents/gait_schema.py", "app/cameras/setup_schema.py"}
"""Modules beside the web edge that use pydantic, for files."""
LOADERS = {"core/robot/model.py", "core/data/tables.py"}
"""Modules of core that read files which come with the program."""
SURROUNDINGS = {"time", "threading", "socket", "os", "pathlib", "subprocess", "asyncio", "queue"}

REFUSED = {
    "core": SOLVERS | SHAPES | WEB | {"pydantic", "app", "solver_jobs", "robot_description"},
    "solver_jobs": SHAPES | WEB | {"pydantic", "app", "robot_description"},
    "robot_description": SOLVERS | WEB | {"pydantic", "app", "solver_jobs", "viser", "yourdfpy"},
}
"""Packages that no module of a part may import."""


def why_refused(path: str, name: str) -> str | None:
    """Why a module may not import a name, and what to do; None where it may."""
    part, top = path.split("/")[0], name.split(".")[0]
    if name.startswith("relative:"):
        return "write the full name"
    if top in ONE_MODULE:
        return None if path == ONE_MODULE[top] else f"only {ONE_MODULE[top]} may; use that module"
    if part in REFUSED:
        return f"{part} may not; move the code to a part that may" if top in REFUSED[part] else None
    return _why_refused_in_app(path, name, top)


def _why_refused_in_app(path: str, name: str, top: str) -> str | None:
    if name == "app.vision.opencv" and path not in OPENCV_USERS:
        return "OpenCV runs in processes of its own; ask app/vision for the result"
    if top in SOLVERS or name.startswith("solver_jobs."):
        return "app uses the public face alone; import from solver_jobs"
    if top == "robot_description":
        return "robots are loaded by core/robot"
    if path.startswith(("app/bridge/", "app/emulator/")):
        return _why_refused_at_the_cable(name, top)
    if top in SHAPES and not path.startswith("app/scene/"):
        return "only app/scene draws in 3D"
    if top in WEB and not path.startswith(WEB_EDGE):
        return f"only the web edge may ({', '.join(WEB_EDGE)})"
    if top == "pydantic" and path not in SCHEMAS and not path.startswith(WEB_EDGE):
        return "pydantic is for the web edge and for files; use a frozen dataclass"
    return None


def _why_refused_at_the_cable(name: str, top: str) -> str | None:
    if top == "app" and not name.startswith(CABLE):
        return "bridge and emulator use nothing else of app; pass in what they need"
    if top in SHAPES | WEB | {"pydantic", "solver_jobs"}:
        return "bridge and emulator use core and the standard library alone"
    return None


def why_impure(path: str, names: Iterable[str]) -> list[str]:
    """What a module of core imports that reaches outside of it."""
    banned = SURROUNDINGS if path in LOADERS else SURROUNDINGS | {"importlib"}
    used = sorted({name.split(".")[0] for name in names} & banned)
    return [
        f"{path} imports {name}: core is pure; pass the value in, or move the code to app" for name in used
    ]


def foreign_addresses(text: str) -> bool:
    """Whether a file of the page names an address of another server."""
    return "https://" in text.replace("https://www.w3.org", "")


def test_modules_import_only_what_their_part_may() -> None:
    pairs = [(path, name) for path in files(".py") for name in imports(path)]
    reasons = [(path, name, why_refused(path, name)) for path, name in pairs]
    refused = [f"{path} imports {name}: {why}" for path, name, why in reasons if why is not None]
    assert len(pairs) > 1000
    assert not refused, listed(refused)


def test_the_modules_with_a_package_of_their_own_import_it() -> None:
    for package, path in ONE_MODULE.items():
        assert any(name.split(".")[0] == package for name in imports(path)), (package, path)


def opens_the_line(path: str, text: str) -> bool:
    """Whether a module could write to the robot without the write gate; asyncio's lines lead to browsers."""
    free = path not in {"app/bridge/transport.py", "app/bridge/bridge.py"}
    text = text.replace("asyncio.Transport", "")
    if path.startswith("app/server/"):
        text = re.sub(r"self\.transport\.write\([A-Z_]+\)", "", text)
    writes = re.search(r"transport\.write\(|serial_for_url|\bSerial\(", text) is not None
    return (free and re.search(r"\bTransport\b", text) is not None) or (
        writes and path != "app/bridge/transport.py"
    )


def test_only_the_bridge_opens_the_line_and_it_writes_by_the_gate() -> None:
    found = [path for path in files(".py") if opens_the_line(path, (PROJECT / path).read_text())]
    assert not found, listed(found)
    assert opens_the_line("app/robot/service.py", "from app.bridge.transport import Transport")
    assert opens_the_line("app/bridge/bridge.py", "self._transport.write(b'<s,1>')")


@pytest.mark.parametrize(
    ("path", "name"),
    [
        ("core/robot/leg.py", "casadi"),
        ("core/robot/leg.py", "app.session.command_queue"),
        ("core/robot/leg.py", "relative:model"),
        ("solver_jobs/workers/nlp_worker.py", "fastapi"),
        ("solver_jobs/workers/nlp_worker.py", "app.jobs"),
        ("robot_description/builder.py", "viser"),
        ("app/studio/studio.py", "solver_jobs.workers.job_queue"),
        ("app/studio/studio.py", "casadi"),
        ("app/studio/studio.py", "robot_description.builder"),
        ("app/studio/studio.py", "serial"),
        ("app/studio/studio.py", "viser"),
        ("app/bridge/bridge.py", "app.session.command_queue"),
        ("app/bridge/bridge.py", "serial"),
        ("app/bridge/bridge.py", "solver_jobs"),
        ("app/gaits/service.py", "pydantic"),
        ("app/gaits/service.py", "fastapi"),
        ("app/vision/video_io.py", "cv2"),
        ("app/trials/service.py", "app.vision.opencv"),
        ("app/runs/service.py", "mcap.writer"),
    ],
)
def test_the_table_refuses(path: str, name: str) -> None:
    assert why_refused(path, name) is not None


@pytest.mark.parametrize(
    ("path", "name"),
    [
        ("core/robot/leg.py", "numpy"),
        ("solver_jobs/nlp/attempts.py", "casadi"),
        ("app/studio/studio.py", "solver_jobs"),
        ("app/bridge/transport.py", "serial"),
        ("app/emulator/board.py", "app.bridge.states"),
        ("app/routes/events.py", "fastapi"),
        ("app/vision/blobs.py", "app.vision.opencv"),
    ],
)
def test_the_table_permits(path: str, name: str) -> None:
    assert why_refused(path, name) is None


def test_core_touches_no_clock_thread_socket_or_file() -> None:
    offenders = [
        line for path in files(".py") if path.startswith("core/") for line in why_impure(path, imports(path))
    ]
    assert not offenders, listed(offenders)
    assert why_impure("core/robot/leg.py", ["time", "numpy", "importlib.resources"]) != []
    assert why_impure("core/robot/model.py", ["numpy", "importlib.resources"]) == []


def test_the_page_fetches_nothing_from_elsewhere() -> None:
    page = [path for path in files(*PAGE_CODE) if path.startswith(f"{STATIC}/")]
    foreign = [path for path in page if foreign_addresses((PROJECT / path).read_text())]
    assert len(page) > 100
    assert not foreign, listed(foreign)
    assert foreign_addresses('import x from "https://cdn.example/x.js"')
    assert not foreign_addresses('"https://www.w3.org/2000/svg"')


@pytest.mark.parametrize(
    ("statement", "unwanted"),
    [
        ("import app.server.launch, app.cli.commands_robot", SOLVERS | SHAPES | {"app.bench", "cv2"}),
        ("main(['--version'])", HEAVY | {"app.cli.commands_plan", "numpy"}),
        ("main(['--help'])", HEAVY | {"app.cli.commands_plan", "numpy"}),
        ("main(['check', 'walk.csv'])", HEAVY),
    ],
)
def test_a_command_loads_no_more_than_it_needs(statement: str, unwanted: set[str], tmp_path: Path) -> None:
    assert main(["manual", "walk", "-o", str(tmp_path / "walk.csv")]) == 0
    script = f"""
import atexit, sys
atexit.register(lambda: print(*sys.modules, file=sys.stderr))
from app.cli import main
{statement}
"""
    environment = {**os.environ, "PYTHONPATH": str(PROJECT)}
    words = [sys.executable, "-c", script]
    done = subprocess.run(words, cwd=tmp_path, env=environment, capture_output=True, text=True, check=True)
    loaded = done.stderr.splitlines()[-1].split()
    assert "app.cli.parser" in loaded
    assert unwanted.intersection(loaded) == set()
