"""Films of feet: how fast and how well they are tracked, how soon a look and a run's trial are there."""

import tempfile
import time
from pathlib import Path

import numpy as np

from app.bench.common.measure import Row, milliseconds
from app.bench.page.film import ACROSS, Film, draw_film, stepping_feet
from app.bench.robot.processes import Studio, Tap, emulator_process, wait_until
from app.bench.robot.stop import stop_latencies
from app.cameras.setup_schema import SetupDocument
from app.common.json import Json
from app.vision.frame_source import PICTURES
from app.vision.services import ask, open_vision_services
from app.vision.tracking import track_video
from app.vision.video_io import use_one_thread
from app.vision.worker import DetectBlobs, Source
from core.errors import StateError

SIZES = ((640, 480), (1280, 720))
SECONDS = 6.0
"""Of the film."""

LOOKS = 60
"""Looks at a picture while a colour is tuned."""

LAPS = 3
"""Walks of the run that is recorded; each lasts half a minute."""

STOPS = 10
"""Stops while the camera records, and as many while there is none."""

RUN_SECONDS = 600.0
"""Longest wait for the run."""


def bench_video() -> list[Row]:
    """Tracking on one core, looks while tuning, and the trial of a run."""
    with tempfile.TemporaryDirectory(prefix="footfall-") as folder:
        films = {size: draw_film(Path(folder) / f"{size[0]}", size, stepping_feet(SECONDS)) for size in SIZES}
        return [
            *(_tracking(film) for film in films.values()),
            *(_looking(film) for film in films.values()),
            *run_rows(films[SIZES[0]], Path(folder)),
        ]


def _words(film: Film) -> str:
    width, height = film.setup.size or (0, 0)
    return f"{width} × {height}"


def _tracking(film: Film) -> Row:
    use_one_thread()
    begun, worked = time.perf_counter(), time.process_time()
    found = track_video(film.folder, film.setup.tracking())
    seconds, used = time.perf_counter() - begun, time.process_time() - worked
    if found is None:
        raise StateError("The film was not tracked to its end.", "video")
    away = np.linalg.norm(found.track.feet - film.feet, axis=2) * 1000.0
    return {
        "tracking": _words(film),
        "frames": len(film.feet),
        "frames/s": round(len(film.feet) / seconds, 1),
        "frames/s of CPU": round(len(film.feet) / used, 1),
        "median mm": round(float(np.median(away)), 3),
        "99 % mm": round(float(np.quantile(away, 0.99)), 3),
        "pixel mm": round(ACROSS * 1000.0 / (film.setup.size or (1, 1))[0], 3),
        "unseen": int(found.unseen.sum()),
        "false": int(found.false.sum()),
    }


def _looking(film: Film) -> Row:
    """From question to answer, the picture's file included, as the least saturation is moved."""
    vision = open_vision_services()
    setup = film.setup.tracking()
    try:
        waits = []
        for number in range(LOOKS + 1):
            begun = time.perf_counter()
            width = 1280
            look = DetectBlobs(Source(film.folder, 40), 0, setup.colours, setup.limits, setup, True, width)
            found = ask(vision.interactive, look, 30.0)
            if found["chosen"] is None:
                raise StateError("A foot was not found in the film.", "video")
            if number:  # the first starts the process
                waits.append(time.perf_counter() - begun)
    finally:
        vision.close()
    return {
        "look": _words(film),
        "looks": LOOKS,
        "median ms": milliseconds(float(np.median(waits))),
        "95 % ms": milliseconds(float(np.quantile(waits, 0.95))),
    }


def run_rows(film: Film, folder: Path, laps: int = LAPS, stops: int = STOPS) -> list[Row]:
    """A run that a film served as a camera records, and stops with and without a recording.

    Args:
        film: is looped.
        folder: for the studio's data.
        laps: walks of the run.
        stops: of each kind.
    """
    camera = ("--camera", f"under={film.folder / PICTURES}")
    with emulator_process() as robot:
        tap = Tap(robot)
        studio = Studio(folder / "data", tap.device, *camera)
        try:
            studio.connect()
            bare = _stopped_runs(studio, tap, stops)
            _records(studio, film)
            recorded = _stopped_runs(studio, tap, stops)
            run = _recorded_run(studio, laps)
        finally:
            studio.close()
            tap.close()
    return [_stop_row("no camera", bare), _stop_row("a camera records", recorded), run]


def _stopped_runs(studio: Studio, tap: Tap, stops: int) -> list[float]:
    """Seconds from a request for a stop in mid run to its first byte on the line; one for each run."""
    waits = []
    for _ in range(stops):
        studio.begin_run("walk")
        waits += stop_latencies(studio, tap, 1)
        wait_until(lambda: studio.robot()["robot"] == "stopped", "the robot stopped")
        studio.ask("POST", "api/robot/clear", {"by": "bench"})
        wait_until(lambda: studio.robot()["robot"] == "disarmed", "the stop is cleared")
    return waits


def _records(studio: Studio, film: Film) -> None:
    """Has the camera record with the run."""
    made = film.setup
    lens = made.lens
    document = {
        "name": made.name,
        "size": made.size,
        "lens": None
        if lens is None
        else {"matrix": lens.matrix.tolist(), "distortion": lens.distortion.tolist()},
        "points": [
            {"pixel": pixel.tolist(), "place_cm": (place * 100.0).tolist()}
            for pixel, place in zip(made.pixels, made.places, strict=True)
        ],
    }
    content = SetupDocument.model_validate(document).model_dump(mode="json")
    setup = studio.ask("POST", "api/setups", content)["id"]
    studio.ask("PUT", "api/cameras/under", {"use": "under", "setup": setup, "records": True})
    wait_until(lambda: _camera(studio)["state"] == "live", "the camera is live")


def _camera(studio: Studio) -> Json:
    camera: Json = studio.ask("GET", "api/cameras")["cameras"][0]
    return camera


def _recorded_run(studio: Studio, laps: int) -> Row:
    """From the run's end, as an answer of the studio tells it, to an answer with the trial's figures."""
    run = studio.begin_run("walk", laps)
    wait_until(lambda: studio.robot()["robot"] in ("done", "fault"), "the run ended", RUN_SECONDS)
    begun = time.monotonic()
    wait_until(lambda: _video(studio, run)["state"] != "recording", "the recording is kept")
    video = _video(studio, run)
    if not video["trial"]:
        raise StateError(f"There is no trial of the run: {video['sentence']}", "video")
    trial = studio.ask("GET", f"api/trials/{video['trial']}")
    studio.ask("GET", "api/trials")
    waited = time.monotonic() - begun
    return {
        "run to trial": f"{laps} walks",
        "run s": round(trial["seconds"], 1),
        "pictures": video["frames"],
        "frames with missing ones": trial["frames"],
        "frames/s": round(trial["frame_rate"], 1),
        "iterations by": trial["ends_from"],
        "video MB": round(video["bytes"] / 1e6, 1),
        "run's end to trial s": round(waited, 2),
    }


def _video(studio: Studio, run: str) -> Json:
    video: Json = studio.ask("GET", f"api/videos?run={run}")["videos"][0]
    return video


def _stop_row(name: str, seconds: list[float]) -> Row:
    return {
        "stop while": name,
        "stops": len(seconds),
        "median ms": milliseconds(float(np.median(seconds))),
        "most ms": milliseconds(max(seconds)),
    }
