"""Data folders that earlier commits made: this program opens everything that is kept in them.

Each archive holds a folder and what the studio that made it said of it (`tests/support/data_folder`). An
approval may lapse, since it is of the waypoints of its time; then the page is told why.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

from app.store.backups import found_backups
from app.store.quick_check import damage_of
from tests.support.data_folder.archive import Unpacked, unpack
from tests.support.data_folder.client import Client
from tests.support.data_folder.contents import contents
from tests.support.data_folder.lab import CAMERA
from tests.support.studio_process import running_studio

FOLDERS = sorted((Path(__file__).parent / "data_folders").glob("*.tar.xz"))
LEAST = {
    "saved gaits": 14,
    "edited gaits": 3,
    "approved gaits": 6,
    "deleted gaits": 1,
    "jobs": 15,
    "simulations": 5,
    "runs": 2,
    "trials": 5,
    "atlases": 2,
}
"""How many of each an archive has at least, so that an empty one proves nothing."""
JOB_STATES = {"done", "infeasible", "failed", "cancelled", "interrupted"}
SUBJECTS = (
    "saved gaits",
    "edited gaits",
    "gaits",
    "versions",
    "approvals",
    "deleted gaits",
    "jobs",
    "simulations",
    "runs",
    "trials",
    "learning",
    "cameras",
    "atlases",
    "last device",
)


@dataclass(frozen=True)
class Opened:
    """A studio on an old data folder."""

    client: Client
    data: Path
    kept: dict[str, Any]
    """What the program that made the folder said of it."""
    now: dict[str, Any]
    """What this program says of it."""


@pytest.fixture(scope="module", params=FOLDERS, ids=lambda path: path.name.partition(".")[0])
def folder(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Unpacked:
    return unpack(request.param, tmp_path_factory.mktemp("old"))


@pytest.fixture(scope="module")
def opened(folder: Unpacked) -> Iterator[Opened]:
    film = next((folder.data / "videos").glob("*.avi"))
    with running_studio(folder.data, "--camera", f"{CAMERA}={film}") as studio:
        client = Client(studio)
        yield Opened(client, folder.data, folder.contents, contents(client, folder.contents["gaits"]))


def test_there_is_a_folder_and_it_has_much_of_everything(folder: Unpacked) -> None:
    kept = folder.contents
    assert {subject: len(kept[subject]) for subject in LEAST if len(kept[subject]) < LEAST[subject]} == {}
    assert {job["state"] for job in kept["jobs"].values()} == JOB_STATES
    assert {run["state"] for run in kept["runs"].values()} == {"done", "stopped"}
    assert len(kept["learning"]["sets"]) == 2
    assert all(kept["cameras"].values())
    assert list((folder.data / "set-aside").iterdir())


@pytest.mark.heavy
def test_the_database_is_whole_after_it_was_opened(opened: Opened) -> None:
    assert damage_of(opened.data / "studio.sqlite3", is_open=True) is None
    assert opened.client.get("/api/health")["storage"] == {"damaged": False, "sentence": None}
    assert found_backups(opened.data)


@pytest.mark.parametrize("subject", SUBJECTS)
def test_it_reads_what_was_kept(opened: Opened, subject: str) -> None:
    now, kept = opened.now[subject], opened.kept[subject]
    if subject == "runs":  # one more was on when its program was killed
        now = {run: content for run, content in now.items() if run in kept}
    if subject == "simulations":  # those of another gait with the same waypoints count now
        now = {gait: content for gait, content in now.items() if gait in kept}
    assert now == kept


def test_every_gait_of_the_list_can_be_opened(opened: Opened) -> None:
    lines = opened.client.get("/api/gaits")["gaits"]
    assert [
        (line["id"], line["problem"]) for line in lines if line["problem"] or line["kind"] == "damaged"
    ] == []
    for line in lines:
        assert opened.client.get(f"/api/gaits/{line['id']}")["name"] == line["name"]


def test_an_approval_stands_or_the_page_is_told_why_it_does_not(opened: Opened) -> None:
    for gait in opened.kept["approved gaits"]:
        view = opened.client.get(f"/api/gaits/{gait}/view")
        approved = opened.kept["approvals"][gait][0]
        stands = [one["stands"] for one in opened.client.get(f"/api/gaits/{gait}/approvals")["approvals"]]
        if approved["waypoints_hash"] == view["plan"]["waypoints_hash"]:
            assert view["approval"]["waypoints_hash"] == approved["waypoints_hash"]
            assert (view["revoked"], stands.count(True), stands[0]) == (None, 1, True)
        else:
            assert (view["approval"], any(stands)) == (None, False)
            assert "waypoints are not the approved ones" in view["revoked"]
            assert f"the approval by {approved['by']} of " in view["revoked"]


def test_a_simulation_of_what_is_still_sent_is_fresh(opened: Opened) -> None:
    for gait, kept in opened.kept["simulations"].items():
        view = opened.client.get(f"/api/gaits/{gait}/view")
        # Earlier programs bound a simulation to raw numbers, which only one kind of processor makes.
        plan = opened.client.get(f"/api/simulations/{kept['key']}").get("plan", view["plan"]["hash"])
        if kept["waypoints_hash"] == view["plan"]["waypoints_hash"] and plan == view["plan"]["hash"]:
            assert view["simulation"]["fresh"], gait


def test_a_run_whose_program_was_killed_is_ended_and_its_journal_taken(opened: Opened) -> None:
    (run,) = opened.now["runs"].keys() - opened.kept["runs"].keys()
    content = opened.now["runs"][run]
    assert (content["state"], content["gait"]) == ("interrupted", "file:walk.csv")
    assert content["samples"] > 10
    assert not list((opened.data / "running").glob("*.journal"))


def test_what_was_deleted_comes_back(opened: Opened) -> None:
    deleted, client = opened.kept["deleted"], opened.client
    gait = client.post(f"/api/gaits/{deleted['gait']}/restore")
    assert gait["name"] == opened.kept["deleted gaits"][deleted["gait"]]
    assert gait["document"]["notes"] == "Deleted after this edit."
    assert client.post(f"/api/runs/{deleted['run']}/restore")["gait"] == "quadruped-wave-1"
    assert client.post(f"/api/trials/{deleted['trial']}/restore")["name"] == "Deleted trial"


def test_editing_goes_on_where_it_was(opened: Opened) -> None:
    client, kept = opened.client, opened.kept["gaits"]["amble-kept"]
    assert client.post("/api/gaits/amble-kept/undo")["document"]["step"] != kept["step"]
    assert client.post("/api/gaits/amble-kept/redo")["document"]["step"] == kept["step"]
