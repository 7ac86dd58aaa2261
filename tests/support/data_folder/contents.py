"""What a studio says of a data folder, as far as it is kept: no plans, no verdicts, no estimates."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from tests.support.data_folder.client import Client

Facts = dict[str, Any]

DOCUMENT = ("name", "robot", "orientation", "direction", "order", "step", "iterations", "notes", "timeline")
"""Fields of a gait's document that are compared."""
APPROVAL = ("number", "by", "when", "waypoints_hash", "verdict_hash", "robot_hash", "version")
RUN = ("gait", "gait_name", "waypoints_hash", "by", "state", "sentence", "reached", "count", "note")
TRIAL = ("name", "gait", "gait_name", "run", "expected_cm", "iterations", "note", "is_example", "frames")
ATLAS = ("robot", "kind", "seed", "gaits", "solved", "infeasible", "failed", "fastest")
JOB = ("kind", "gait", "gait_name", "state", "sentence")


def contents(client: Client, gaits: Iterable[str]) -> Facts:
    """Everything that is kept, by subject; of gaits those that are named."""
    gaits = sorted(gaits)
    return {
        "saved gaits": {line["id"]: line["name"] for line in _lines(client) if line["kind"] == "saved"},
        "edited gaits": sorted(line["id"] for line in _lines(client) if line["edited"]),
        "gaits": {gait: _gait(client, gait) for gait in gaits},
        "versions": {gait: _versions(client, gait) for gait in gaits},
        "approvals": {gait: _approvals(client, gait) for gait in gaits},
        "deleted gaits": {line["id"]: line["name"] for line in client.get("/api/gaits/deleted")["gaits"]},
        "jobs": {job["id"]: _job(client, job["id"]) for job in client.get("/api/jobs")["jobs"]},
        "simulations": {gait: found for gait in gaits if (found := _simulation(client, gait)) is not None},
        "runs": {run["id"]: _run(client, run["id"]) for run in client.get("/api/runs?most=200")["runs"]},
        "trials": {one["id"]: _trial(client, one["id"]) for one in client.get("/api/trials")["trials"]},
        "learning": _learning(client),
        "cameras": _cameras(client),
        "atlases": {
            one["name"]: {**_some(one, ATLAS), "rows": _rows(client, f"/api/atlases/{one['name']}/export")}
            for one in client.get("/api/atlases")["atlases"]
            if not one["included"]
        },
        "last device": client.get("/api/robot/ports")["last"],
    }


def touched(client: Client) -> list[str]:
    """The gaits that are saved or edited."""
    return [line["id"] for line in _lines(client) if line["kind"] == "saved" or line["edited"]]


def _lines(client: Client) -> list[Facts]:
    lines: list[Facts] = client.get("/api/gaits")["gaits"]
    return lines


def _some(content: Facts, keys: Iterable[str]) -> Facts:
    return {key: content[key] for key in keys}


def _rows(client: Client, path: str) -> int:
    return len(client.text(path.replace(" ", "%20")).splitlines())


def _gait(client: Client, gait: str) -> Facts:
    view = client.get(f"/api/gaits/{gait}/view")
    document = view["document"]
    parts = [[part["gait"]["name"], part["times"], part["source"]] for part in document.get("sequence", [])]
    return {**_some(document, DOCUMENT), "kind": view["kind"], "parts": parts, "undo": view["undo"]}


def _versions(client: Client, gait: str) -> list[Facts]:
    path = f"/api/gaits/{gait}/versions"
    lines = client.get(path)["versions"]
    return [
        {
            **_some(line, ("number", "made", "kind", "name", "by")),
            "document": _some(client.get(f"{path}/{line['number']}")["document"], DOCUMENT),
        }
        for line in lines
    ]


def _approvals(client: Client, gait: str) -> list[Facts]:
    path = f"/api/gaits/{gait}/approvals"
    found = []
    for line in client.get(path)["approvals"]:
        client.get(f"{path}/{line['number']}/difference")  # reads what was approved
        found.append({**_some(line, APPROVAL), "figures": line["figures"], "warnings": len(line["warnings"])})
    return found


def _job(client: Client, job: str) -> Facts:
    content = client.get(f"/api/jobs/{job}")
    return {**_some(content, JOB), "has result": content["result"] is not None}


def _simulation(client: Client, gait: str) -> Facts | None:
    standing = client.get(f"/api/gaits/{gait}/view")["simulation"]
    if standing is None:
        return None
    content = client.get(f"/api/simulations/{standing['key']}")
    client.studio.blob(f"/api/simulations/{standing['key']}/ghost")
    return {
        **_some(content, ("key", "gait", "robot", "waypoints_hash", "made")),
        "physics": content["physics"]["name"],
        "samples": len(content["motion"]["times"]),
        "variations": content["variations"] is not None,
    }


def _run(client: Client, run: str) -> Facts:
    path = f"/api/runs/{run}"
    content = client.get(path)
    return {
        **_some(content, RUN),
        "approved by": (content["approval"] or {}).get("by"),
        "states": [[state["link"], state["robot"]] for state in content["states"]],
        "samples": client.get(f"{path}/strokes")["count"],
        "rows": _rows(client, f"{path}/run.csv"),
    }


def _trial(client: Client, trial: str) -> Facts:
    path = f"/api/trials/{trial}"
    content, beside = client.get(path), client.get(f"{path}/beside")
    photos = client.get(f"{path}/photos")["photos"]
    for photo in photos:
        client.studio.blob(f"{path}/photos/{photo['id']}/picture")
    return {
        **_some(content, TRIAL),
        "distance_cm": round(content["figures"]["distance"], 2),
        "photos": [[photo["name"], photo["caption"], photo["width"]] for photo in photos],
        "sources": [row["source"] for row in beside["rows"]],
        "rows": _rows(client, f"{path}/track.csv"),
    }


def _learning(client: Client) -> Facts:
    courses = client.get("/api/learning")["courses"]
    sets = client.get("/api/learning/sets")["sets"]
    return {
        "courses": {
            one["id"]: {
                **_some(one, ("state", "source", "robot", "gaits", "total", "sentence")),
                "has result": client.get(f"/api/learning/{one['id']}")["result"] is not None,
            }
            for one in courses
        },
        "sets": [_some(one, ("name", "version", "robot", "learning", "key", "note")) for one in sets],
    }


def _cameras(client: Client) -> Facts:
    setups = client.get("/api/setups")["setups"]
    return {
        "setups": {
            one["id"]: [one["revision"], one["setup"]["name"], len(one["setup"]["points"]), one["ready"]]
            for one in setups
        },
        "cameras": [
            _some(one, ("id", "name", "use", "setup", "records"))
            for one in client.get("/api/cameras")["cameras"]
        ],
        "videos": {
            one["id"]: {
                **_some(one, ("name", "kind", "frames", "size")),
                "bytes": len(client.studio.blob(f"/api/videos/{one['id']}/file")),
            }
            for one in client.get("/api/videos")["videos"]
        },
    }
