"""`python -m tests.support.data_folder OUT.tar.xz` makes a data folder by this commit's program and packs it.

It takes about six minutes. A studio of this checkout runs as a process, and gets requests as from a page.
`footfall` itself adds a run that is killed. Keep the archive as `tests/app/store/data_folders/COMMIT.tar.xz`.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

from app.emulator.emulated_robot import start_emulator
from tests.support.data_folder import design, lab
from tests.support.data_folder.archive import pack
from tests.support.data_folder.client import Client
from tests.support.data_folder.contents import contents, touched
from tests.support.studio_process import PROJECT, running_studio, wait_for

SIMULATED = ("c-gait-order-1",)
"""Gaits of the library that are simulated, and neither edited nor approved."""


def work(client: Client, data: Path, film: Path) -> dict[str, str]:
    """The first session; ends while a job is on. Returns the ids of what was deleted."""
    learning = lab.begin_learning(client, lab.make_trials(client))
    design.make_gaits(client)
    design.change_a_file(client, data)
    design.make_sequences(client)
    design.compute(client)
    design.approve_gaits(client)
    lab.make_videos(client, film)
    lab.connect(client)
    run, deleted_run = lab.make_runs(client)
    deleted_trial = lab.finish_trials(client, run)
    lab.finish_learning(client, learning)
    design.begin_long_job(client)
    return {"gait": design.DELETED, "run": deleted_run, "trial": deleted_trial}


def look(client: Client, device: str) -> dict[str, Any]:
    """The second session: a robot on a serial device, and all that is kept."""
    lab.connect(client, device)
    gaits = {*touched(client), *design.APPROVED, *SIMULATED}
    found = contents(client, gaits)
    stands = [gait for gait in gaits if client.get(f"/api/gaits/{gait}/view")["approval"] is not None]
    return {**found, "approved gaits": sorted(stands), "way": client.text("/api/gaits/walk/export/waypoints")}


def leave_a_run(data: Path, waypoints: Path) -> None:
    """A run of `footfall send` whose process is killed, so that its journal stays."""
    command = [sys.executable, "-m", "app", "send", str(waypoints), "--robot", "emulator", "--yes"]
    process = subprocess.Popen([*command, "--data", str(data)], cwd=PROJECT)
    try:
        journals = data / "running"
        wait_for(lambda: any(one.stat().st_size > 8000 for one in journals.glob("*.journal")), "a run is on")
    finally:
        process.kill()
        process.wait()


def main(archive: Path) -> None:
    """Makes a folder and packs it."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        data, film, waypoints = folder / "data", folder / "film.avi", folder / "walk.csv"
        lab.write_film(film)
        words = ("--robot", "emulator", "--camera", f"{lab.CAMERA}={film}")
        with running_studio(data, *words) as studio:
            deleted = work(Client(studio), data, film)
        emulator = start_emulator()
        try:
            with running_studio(data, *words) as studio:
                found = look(Client(studio), emulator.device)
        finally:
            emulator.close()
        waypoints.write_text(found.pop("way"))
        leave_a_run(data, waypoints)
        pack(data, {**found, "deleted": deleted}, archive)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
