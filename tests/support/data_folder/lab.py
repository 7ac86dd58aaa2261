"""What happens at the robot: runs on the emulated one, trials, learning, a camera and a video."""

from __future__ import annotations

import io
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from PIL import Image

from tests.support.data_folder.client import BY, Client
from tests.support.data_folder.design import WALK
from tests.support.studio_process import wait_for
from tests.support.trials.tracks import stepping_track

CAMERA = "Under the glass"
SIDE = 64
"""Width and height of the video, px."""
LAPS = 8
TRIALS = {
    "walk-manual-0": (0.0055, 0.0055),
    "amble-manual-0": (0.0055, 0.0055),
    "s-gait-manual-0": (0.0085, 0.0),
}
"""Gaits of trials, with the step of a robot that is held back, m."""


def write_film(path: Path) -> None:
    """A short video of grey pictures, in which no foot is seen."""
    film = cv2.VideoWriter(str(path), cv2.VideoWriter.fourcc(*"MJPG"), 13.0, (SIDE, SIDE))
    for shade in range(0, 160, 20):
        film.write(np.full((SIDE, SIDE, 3), shade, dtype=np.uint8))
    film.release()


def connect(client: Client, device: str = "emulator") -> None:
    """Connects the robot and waits until it stands still."""
    client.post("/api/robot/connect", {"by": BY, "device": device})
    wait_for(lambda: bool(client.get("/api/robot")["robot"] == "disarmed"), "the robot is up")


def run(client: Client, gait: str, *, stops: bool) -> str:
    """The id of a run that went to its end, or was stopped after some waypoints."""
    wait_for(lambda: client.get("/api/robot")["robot"] in ("disarmed", "done"), "the robot stands still")
    client.post("/api/robot/arm", {"by": BY})
    sent = client.post("/api/robot/send", {"gait": gait, "by": BY})["run"]["id"]
    if stops:
        wait_for(lambda: client.get("/api/robot")["run"]["sent"] > 3, "some waypoints are out")
        client.post(f"/api/robot/stop?by={BY}")
    state = "stopped" if stops else "done"
    wait_for(lambda: bool(client.get("/api/robot")["robot"] == state), f"the run is {state}")
    if stops:
        client.post("/api/robot/clear", {"by": BY})
    return str(sent)


def make_runs(client: Client) -> tuple[str, str]:
    """Three runs; the ids of the complete one and of a stopped one that is deleted."""
    complete = run(client, WALK, stops=False)
    client.send("PUT", f"/api/runs/{complete}/note", {"note": "Went to its end."})
    run(client, "fast-c-gait", stops=True)
    deleted = run(client, "quadruped-wave-1", stops=True)
    client.send("DELETE", f"/api/runs/{deleted}")
    return complete, deleted


def track_csv(step: tuple[float, float], laps: int) -> str:
    """The file of a track that steps evenly, in cm."""
    feet = stepping_track(step, laps).feet.reshape(-1, 8) * 100.0
    head = ",".join(f"X_D{foot},Y_D{foot}" for foot in range(1, 5))
    return "\n".join([head, *(",".join(f"{value:.3f}" for value in row) for row in feet.tolist())]) + "\n"


def make_trials(client: Client) -> list[str]:
    """The ids of trials of different gaits, from which parameters can be learned."""
    return [
        str(add_trial(client, f"Trial of {gait}", track_csv(step, LAPS), LAPS, gait=gait)["id"])
        for gait, step in TRIALS.items()
    ]


def add_trial(client: Client, name: str, csv: str, laps: int, **more: str) -> Any:
    """A new trial."""
    asked = {"name": name, "csv": csv, "expected_cm": 1.0 * laps, "iterations": laps, "note": "Made."}
    return client.post("/api/trials", {**asked, **more})


def finish_trials(client: Client, run_id: str) -> str:
    """A trial of a run with a simulation and a photo, and an example; the id of a deleted trial."""
    csv = track_csv((0.0065, 0.006), 1)
    trial = add_trial(client, "Trial of a run", csv, 1, run=run_id)["id"]
    client.post(f"/api/trials/{trial}/simulation")
    seen = f"/api/trials/{trial}/beside"
    wait_for(lambda: bool(client.get(seen)["simulation"]["state"] == "done"), "the trial is simulated")
    picture = io.BytesIO()
    Image.new("RGB", (40, 30), (90, 140, 60)).save(picture, "PNG")
    photos = f"/api/trials/{trial}/photos"
    photo = client.post(f"{photos}?name=shoe.png", picture.getvalue())["id"]
    client.send("PUT", f"{photos}/{photo}", {"caption": "The shoe"})
    client.post("/api/trials/example")
    deleted = str(add_trial(client, "Deleted trial", csv, 1)["id"])
    client.send("DELETE", f"/api/trials/{deleted}")
    return deleted


def begin_learning(client: Client, trials: list[str]) -> str:
    """The id of a course of learning that has begun."""
    return str(client.post("/api/learning", {"trials": trials})["id"])


def finish_learning(client: Client, course: str) -> None:
    """Keeps what was learned in two versions, and simulates with the second one."""
    path = f"/api/learning/{course}"
    wait_for(lambda: client.get(path)["state"] != "running", "the course ended", 900.0)
    for _ in range(2):
        kept = client.post(f"{path}/set", {"name": "From three trials"})
    client.job("simulate", "c-gait-order-1", physics=kept["key"])


def make_videos(client: Client, film: Path) -> None:
    """A camera with its setup in two revisions, and a video in which no feet are found."""
    ends = (8, SIDE - 8)
    points = [{"pixel": [x, y], "place_cm": [(x - 32) / 6, (32 - y) / 6]} for x in ends for y in ends]
    made = client.post("/api/setups", {"name": CAMERA, "size": [SIDE, SIDE], "points": points})
    changed = {"revision": made["revision"], "setup": {**made["setup"], "note": "Looked at again."}}
    client.send("PUT", f"/api/setups/{made['id']}", changed)
    camera = client.get("/api/cameras")["cameras"][0]["id"]
    client.send("PUT", f"/api/cameras/{camera}", {"use": "under", "setup": made["id"], "records": False})
    video = client.post("/api/videos?name=grey.avi", film.read_bytes())["id"]
    asked = {"setup": made["id"], "name": "Filmed", "expected_cm": 1.0, "gait": "walk"}
    state = client.end_of(client.post(f"/api/videos/{video}/track", asked))
    if state != "failed":
        raise AssertionError(f"Tracking of grey pictures is {state}.")
