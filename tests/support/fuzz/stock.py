"""What a studio holds before it is attacked: one of everything, its ids, and real bodies of requests."""

from __future__ import annotations

import base64
import io
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from urllib.parse import quote

import numpy as np
from PIL import Image

from core.vision.track_csv import format_track_csv
from tests.support.studio_process import StudioProcess, wait_for
from tests.support.trials.rendered import LENS, SIZE, VIEW, write_video
from tests.support.trials.tracks import RATE, stepping_track

GAITS = ("walk", "rotate", "walk-manual-0", "textbook-trot", "hexapod-tripod", "walk-turn-s-gait")
"""Of the library: optimised, turning, a segment table, without a motion, six legs, a sequence."""

OWN = "fuzzed"
"""What is kept under a name is called so."""

CORNERS = np.array([[-0.04, -0.04], [0.04, -0.04], [0.04, 0.04], [-0.04, 0.04]])
SETUP: dict[str, Any] = {
    "name": OWN,
    "size": list(SIZE),
    "lens": {"matrix": LENS.matrix.tolist(), "distortion": LENS.distortion.tolist()},
    "points": [
        {"pixel": pixel.tolist(), "place_cm": (place * 100).tolist()}
        for pixel, place in zip(LENS.bent(VIEW.pixels(CORNERS)), CORNERS, strict=True)
    ],
}


@dataclass(frozen=True)
class Stock:
    """What requests may name and carry.

    Args:
        ids: values of each parameter of a path or an address, by its name.
        bodies: real bodies by operation, as JSON values or as the content of a file.
        documents: the stored gaits.
    """

    ids: Mapping[str, tuple[str, ...]]
    bodies: Mapping[str, tuple[Any, ...]]
    documents: Mapping[str, dict[str, Any]]


def film() -> bytes:
    """A short film of four feet."""
    feet = stepping_track((0.0085, 0.0085), 1).feet[::40]
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "film.avi"
        write_video(path, feet, RATE)
        return path.read_bytes()


def picture(form: str) -> bytes:
    """A small picture."""
    file = io.BytesIO()
    Image.effect_noise((320, 240), 60).convert("RGB").save(file, form)
    return file.getvalue()


def stocked(studio: StudioProcess) -> Stock:
    """Fills the studio with one of everything."""
    documents = {gait: studio.document(gait) for gait in GAITS}
    plan = _kept(studio, "GET", "/api/gaits/walk/view")["plan"]
    run = _stopped_run(studio)
    video_content = film()
    video = _kept(studio, "POST", "/api/videos?name=film.avi", video_content)["id"]
    setup = _kept(studio, "POST", "/api/setups", SETUP)["id"]
    csv = format_track_csv(stepping_track((0.0085, 0.0085), 1))
    new_trial = {"name": OWN, "csv": csv, "expected_cm": 1.0, "gait": "walk", "note": "on glass"}
    trial = _kept(studio, "POST", "/api/trials", new_trial)["id"]
    jpeg = picture("JPEG")
    photo = _kept(studio, "POST", f"/api/trials/{trial}/photos?name=p.jpg", jpeg)["id"]
    job = _done(studio, "/api/jobs", {"kind": "simulate", "gait": "walk"})
    optimised = _done(studio, "/api/jobs", {"kind": "optimise", "gait": "c-gait"})
    simulation = _kept(studio, "GET", "/api/gaits/walk/view")["simulation"]["key"]
    ran = _kept(studio, "POST", "/api/trials", {**new_trial, "gait": "", "run": run})["id"]
    learning = _kept(studio, "POST", "/api/learning", {"table": _table(studio)})["id"]
    studio.ask("DELETE", f"/api/learning/{learning}")
    pattern = _kept(studio, "POST", "/api/patterns", TRANSITION)["id"]
    ids = {
        "gait_id": tuple(documents),
        "number": ("1", "0", str(pattern)),
        "job_id": (job, optimised),
        "run": (run,),
        "key": (simulation,),
        "trial": (trial, ran),
        "photo": (photo,),
        "learning": (learning,),
        "setup": (setup,),
        "video": (video,),
        "camera": ("film",),
        "plan": (plan["hash"],),
        "gait": ("walk", "rotate"),
        "copy_of": ("walk", "walk-manual-0"),
        "robot": ("deltawalker", "hexapod", "dodecapod"),
        "state": ("done", "stopped"),
        "file": ("walk.csv", "walk.json", "w.txt"),
        "since": ("2024-01-31",),
        "until": ("2030-01-31",),
    }
    files = Files(studio, csv, video_content, jpeg, plan)
    return Stock(ids, bodies_of(documents, ids, new_trial, files), documents)


@dataclass(frozen=True)
class Files:
    """Files that requests carry.

    Args:
        studio: that exports some.
        csv: a foot track.
        film: a video.
        jpeg: a picture.
        plan: of a walk.
    """

    studio: StudioProcess
    csv: str
    film: bytes
    jpeg: bytes
    plan: dict[str, Any]

    def exported(self, form: str) -> bytes:
        """The walk in one of the forms that the studio writes."""
        return self.studio.blob(f"/api/gaits/walk/export/{form}")


TRANSITION: dict[str, Any] = {
    "kind": "transition",
    "gait": "walk",
    "to": "rotate",
    "sample": 10,
    "to_sample": 20,
    "walkable": True,
    "count": 2,
    "seconds": 5.0,
    "locked": [1],
    "cells": [[0, 3, 1]],
    "rules": {"shortest_swing": 4, "balance": 0.003},
    "weights": {"limb_changes": 5},
}


def bodies_of(
    documents: Mapping[str, dict[str, Any]],
    ids: Mapping[str, tuple[str, ...]],
    trial: dict[str, Any],
    files: Files,
) -> dict[str, tuple[Any, ...]]:
    """Real bodies for the operations whose schema says too little."""
    gaits = tuple(documents.values())
    manual = documents["walk-manual-0"]
    defaults = _kept(files.studio, "GET", "/api/setups")["defaults"]
    look = {"foot": 1, "colours": defaults["colours"], "limits": {"most_area": 900.0}, "setup": SETUP}
    transition = TRANSITION
    limbs = {"kind": "limbs", "gait": "walk", "samples": 16, "limbs": ["walks"] * 3 + ["held"], "seconds": 2}
    drawing = {"kind": "drawing", "gait": "rotate", "painted": True, "document": documents["rotate"]}
    rows = ["".join("1" if c else "0" for c in row) for row in files.plan["contact"]]
    use = {"question": drawing, "feet": rows, "name": OWN}
    step = {"part": "motor", "by_mm": 0.5, "foot": 1, "motor": 2, "axis": None}
    jog = {"steps": [step, {"part": "body", "by_mm": 1, "axis": "x"}], "preview": True, "from_mm": [5.5] * 12}
    board = {"name": "b", "frame": 1, "size": [640, 480], "found": True, "points": _corners()}
    lens = {"columns": 4, "rows": 3, "boards": [{**board, "name": str(number)} for number in range(4)]}
    picture_url = "data:image/jpeg;base64," + _base64(files.jpeg)
    track = {**{key: trial[key] for key in ("name", "expected_cm", "gait")}, "setup": ids["setup"][0]}
    return {
        "POST /api/gaits": gaits,
        "PUT /api/gaits/{gait_id}": gaits,
        "POST /api/gaits/import": (
            *(files.exported(form) for form in ("csv", "waypoints", "phases")),
            gaits[0],
        ),
        "POST /api/gaits/{gait_id}/live": tuple({"document": one} for one in gaits),
        "POST /api/gaits/{gait_id}/remedies": tuple({"document": one, "tips": False} for one in gaits),
        "POST /api/gaits/{gait_id}/limit": tuple({"document": one, "which": "step"} for one in gaits),
        "POST /api/gaits/{gait_id}/redraw": ({"order": [3, 2, 4, 1], "phase_knots": 5, "closing_knots": 5},),
        "POST /api/sequences": (
            {"name": OWN, "parts": [{"gait": "walk", "times": 2}, {"gait": "rotate"}], "notes": "n"},
        ),
        "POST /api/jobs": tuple({"kind": k, "gait": "walk"} for k in ("optimise", "timing", "simulate")),
        "POST /api/patterns": (transition, limbs, drawing),
        "POST /api/patterns/gait": (use,),
        "POST /api/patterns/document": (use,),
        "POST /api/patterns/plan": (use,),
        "POST /api/robot/send": ({"gait": "walk", "waypoints_hash": None, "from": 0, "iterations": 1},),
        "POST /api/robot/connect": ({"device": "emulator"}, {}),
        "POST /api/robot/jog": (jog, {**jog, "look": {"part": "foot", "foot": 2}}),
        "POST /api/robot/motor-test": ({"robot": "deltawalker"}, {}),
        "POST /api/robot/jog/ghost": ({"steps": [step], "from_mm": [5.5] * 12, "x": 0.1, "heading": 0.2},),
        "POST /api/tables/made": tuple({"document": one} for one in (gaits[0], manual)),
        "POST /api/tables/repairs": ({"table": manual["segment_table"], "kept": [[0, 1], [1, 2]]},),
        "POST /api/tables/pose": ({"document": manual, "strokes_mm": [5.5] * 12},),
        "POST /api/trials": (trial, {**trial, "pixels": {"per_cm": 40, "origin": [300, 250]}}),
        "PUT /api/trials/{trial}": ({"revision": 1, "note": "tape", "ends": [400]},),
        "POST /api/trials/{trial}/photos": (files.jpeg, picture("PNG")),
        "POST /api/learning": ({"trials": list(ids["trial"])}, {"table": _table(files.studio)}),
        "POST /api/setups": (SETUP,),
        "POST /api/setups/check": (SETUP,),
        "PUT /api/setups/{setup}": ({"revision": 1, "setup": SETUP},),
        "POST /api/boards": (files.jpeg,),
        "POST /api/lens": (lens,),
        "POST /api/lens/look": ({"lens": SETUP["lens"], "picture": picture_url},),
        "POST /api/videos": (files.film,),
        "POST /api/videos/{video}/look": (look,),
        "POST /api/videos/{video}/boards": ({"columns": 4, "rows": 3, "frames": [0, 5]},),
        "POST /api/videos/{video}/track": (track,),
        "POST /api/cameras/{camera}/look": (look,),
        "PUT /api/cameras/{camera}": ({"use": "under", "setup": ids["setup"][0], "records": False},),
    }


def _kept(studio: StudioProcess, method: str, path: str, content: Any = None) -> dict[str, Any]:
    answer = studio.ask(method, path, content)
    if answer.status >= 300:
        raise AssertionError(f"{method} {path}: {answer.status} {answer.content}")
    kept: dict[str, Any] = answer.content
    return kept


def _done(studio: StudioProcess, path: str, content: Any) -> str:
    """A job that has come to its end."""
    job = _kept(studio, "POST", path, content)["id"]
    wait_for(lambda: studio.ask("GET", f"/api/jobs/{job}").content["ended"] is not None, f"{path} ends")
    return str(job)


def _stopped_run(studio: StudioProcess) -> str:
    """A run of the walk that was stopped on its way, and the robot as it was before."""
    _kept(studio, "POST", "/api/robot/connect", {})
    wait_for(lambda: studio.robot()["allowed"]["arm"] is None, "the robot can be armed")
    approve(studio, "walk")
    _kept(studio, "POST", "/api/robot/arm", {})
    _kept(studio, "POST", "/api/robot/send", {"gait": "walk"})
    wait_for(lambda: bool(studio.robot()["run"]), "the run is on")
    wait_for(lambda: (studio.robot()["run"] or {}).get("acknowledged", 1) > 0, "a waypoint is reached")
    _kept(studio, "POST", "/api/robot/stop")
    wait_for(lambda: studio.ask("POST", "/api/robot/clear", {}).status == 200, "the stop is confirmed")
    return str(_kept(studio, "GET", "/api/runs")["runs"][0]["id"])


def approve(studio: StudioProcess, gait: str) -> None:
    """Checks a gait and approves it with its warnings."""
    _kept(studio, "POST", f"/api/gaits/{gait}/check")
    verdict = _kept(studio, "GET", f"/api/gaits/{gait}/view")["verdict"]
    assert verdict is not None, "somebody else has edited the gait"
    approval = {"by": OWN, "verdict_hash": verdict["hash"], "accept_warnings": True}
    _kept(studio, "POST", f"/api/gaits/{gait}/approve", approval)


def _corners() -> list[list[float]]:
    return [[100.0 + 40 * column, 100.0 + 40 * row] for row in range(3) for column in range(4)]


def _base64(content: bytes) -> str:
    return base64.b64encode(content).decode()


def _table(studio: StudioProcess) -> dict[str, Any]:
    """What learning takes: figures of three gaits, and the trajectories that they came of."""
    head = "Traj, +x, -x, dx, +y, -y, dy, dist, angle, % err"
    rows = [f"Traj{kind}a_o1,3.6,0.1,3.5,0.5,0.2,0.4,3.7,8.5,22.0" for kind in "ABC"]
    names = {"walk_a.csv": "walk", "ambl_a.csv": "amble", "mtri_a.csv": "s-gait"}
    trajectories = {file: studio.text(f"/api/gaits/{gait}/export/csv") for file, gait in names.items()}
    return {"csv": "\n".join([head, *rows]), "trajectories": trajectories}


def path_of(path: str, values: Mapping[str, str]) -> str:
    """The path with values in its braces."""
    for name, value in values.items():
        path = path.replace("{" + name + "}", quote(value.encode(errors="surrogatepass"), safe=""))
    return path
