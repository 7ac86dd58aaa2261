"""What a person makes at the desk: gaits, sequences, optimised motions, simulations, approvals, an atlas."""

from __future__ import annotations

import json
from pathlib import Path

from tests.support.data_folder.client import Client
from tests.support.studio_process import wait_for

WALK = "walk-kept"
"""A drawn walk with versions, an optimised motion, a simulation, an approval and runs."""
APPROVED = (
    WALK,
    "hexapod-wave",
    "quadruped-wave-1",
    "quadruped-wave-2",
    "walk",
    "fast-c-gait",
    "walk-manual-0",
    "walk-and-turn",
    "c-gait",
)
"""Gaits that are approved; the last one is edited afterwards."""
DELETED = "rotate-deleted"
TOO_FAR = {"step": [0.0177, 0.0177, 0.0], "iterations": 6}
"""Changes that give the optimiser several seconds of work."""


def make_gaits(client: Client) -> None:
    """Gaits of every kind and robot, edited, renamed, and one deleted."""
    client.copy("walk", "Walk, kept")
    edit_walk(client)
    client.copy("hexapod-wave", "Hexapod wave, kept")
    client.copy("dodecapod-three-up", "Dodecapod, kept")
    client.copy("walk-manual-1", "Manual walk, kept")
    client.copy("fast-c-gait", "Fast C-Gait, kept")
    client.copy("walk-manual-0", "Nine motors, kept", robot="deltawalker9")
    client.copy("walk", "Five motors, kept", robot="deltawalker5")
    client.copy("textbook-trot", "Trot without a motion")
    import_gaits(client)
    renamed = client.copy("amble", "Amble, kept")
    client.edit(renamed, "Rename", name="Amble, renamed")
    client.edit(renamed, "Shorter step", step=[0.006, 0.006, 0.0])  # not saved
    client.edit("s-gait", "Notes", notes="A gait of the library, edited and not saved.")
    client.copy("rotate", "Rotate, deleted")
    client.edit(DELETED, "Notes", notes="Deleted after this edit.")
    client.send("DELETE", f"/api/gaits/{DELETED}")
    find_poses(client)


def edit_walk(client: Client) -> None:
    """Edits, undo, saves, a named version and a way back to it."""
    path = f"/api/gaits/{WALK}"
    client.edit(WALK, "Longer step", step=[0.009, 0.009, 0.0])
    client.post(f"{path}/versions", {"name": "Longer step"})
    client.post(f"{path}/save")
    client.edit(WALK, "Notes", notes="Goes 10 mm again.")
    client.post(f"{path}/undo")
    client.post(f"{path}/redo")
    client.post(f"{path}/redraw", {"order": [3, 2, 4, 1], "phase_knots": 6, "closing_knots": 5})
    client.post(f"{path}/save")
    client.post(f"{path}/versions/1/restore")
    client.edit(WALK, "Margin", options={**client.get(path)["options"], "margin": 0.005})
    client.post(f"{path}/save")


def import_gaits(client: Client) -> None:
    """A recorded trajectory with its companion, and recorded waypoints."""
    pair = {form: client.text(f"/api/gaits/walk/export/{form}") for form in ("csv", "companion")}
    body = json.dumps(pair).encode()
    client.post("/api/gaits/import?file=walk.csv&name=Recorded%20walk", body)
    waypoints = client.text("/api/gaits/amble/export/waypoints").encode()
    client.post("/api/gaits/import?file=amble.csv&name=Recorded%20waypoints", waypoints)


def find_poses(client: Client) -> None:
    """A gait whose poses were searched here."""
    asked = {"name": "Own fastest", "step": 0.015, "cycles": 1}
    path = f"/api/gaits/{client.post('/api/fastest/gaits', asked)['id']}"
    wait_for(lambda: client.get(f"{path}/view")["plan"]["source"] == "poses", "the poses are found")
    client.post(f"{path}/save")


def change_a_file(client: Client, data: Path) -> None:
    """A file that somebody changed outside the studio, and that is set aside."""
    path = data / "gaits" / "dodecapod-kept.json"
    path.write_text(json.dumps({**json.loads(path.read_text()), "notes": "Written by hand."}))
    client.post("/api/gaits/dodecapod-kept/file", {"keep": "mine"})


def make_sequences(client: Client) -> None:
    """A sequence with a transition and one whose parts are optimised."""
    parts = [{"gait": "walk", "times": 2}, {"gait": "walk-manual-0"}, {"gait": "rotate"}]
    made = client.post("/api/sequences", {"name": "Walk, manual walk, turn", "parts": parts})
    if not any(part["is_transition"] for part in made["plan"]["parts"]):
        raise AssertionError("The sequence has no transition; choose parts that need one.")
    parts = [{"gait": "walk"}, {"gait": "rotate"}]
    made = client.post("/api/sequences", {"name": "Walk and turn", "parts": parts, "notes": "Optimised."})
    for job in client.post(f"/api/gaits/{made['id']}/sequence/optimise")["jobs"]:
        client.end_of({"id": job})


def compute(client: Client) -> None:
    """Jobs that are done, have no solution, or are cancelled."""
    states = [
        client.job("optimise", WALK),
        client.job("optimise", "hexapod-wave-kept"),
        client.job("timing", WALK),
        client.job("simulate", WALK),
        client.job("simulate", "fast-c-gait"),
        client.job("simulate", "hexapod-wave-kept"),
        client.job("simulate", "manual-walk-kept", variations=2),
        client.end_of(client.post("/api/atlases", {"name": "Twenty gaits", "count": 20, "seed": 3})),
    ]
    unsolved = client.job("optimise", "trot-without-a-motion")
    if {*states} != {"done"} or unsolved != "infeasible":
        raise AssertionError(f"Some jobs ended otherwise: {states}, {unsolved}.")
    client.cancel(begin_long_job(client))
    client.cancel(client.post("/api/fastest/searches", {"step": 0.015}))
    client.cancel(client.post("/api/atlases", {"name": "Cancelled", "count": 100_000}))


def begin_long_job(client: Client) -> object:
    """An optimisation that takes several seconds."""
    if client.get("/api/gaits/amble-order-2")["iterations"] == 1:
        options = {**client.get("/api/gaits/amble-order-2")["options"], "workspace": "cylinder"}
        client.edit("amble-order-2", "Too far", **TOO_FAR, options=options)
    return client.post("/api/jobs", {"kind": "optimise", "gait": "amble-order-2"})


def approve_gaits(client: Client) -> None:
    """Approvals of drawn, optimised, manual and pose gaits and a sequence; one is lost by an edit."""
    for gait in APPROVED:
        client.approve(gait)
    client.edit(APPROVED[-1], "Shorter step", step=[0.009, 0.0, 0.0])
