"""Requests to a studio that must succeed, and waiting for its jobs."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any
from urllib.parse import quote

from app.jobs.repository import ENDED
from tests.support.studio_process import StudioProcess, wait_for

BY = "Ada"


@dataclass(frozen=True)
class Client:
    """A person at a studio."""

    studio: StudioProcess

    def get(self, path: str) -> Any:
        """The JSON content at a path."""
        return self.send("GET", path)

    def post(self, path: str, content: Any = None) -> Any:
        """The answer to a POST."""
        return self.send("POST", path, content)

    def send(self, method: str, path: str, content: Any = None) -> Any:
        """The answer to a request that must succeed."""
        answer = self.studio.ask(method, path, content)
        if answer.status >= 300:
            raise AssertionError(f"{method} {path} was refused ({answer.status}): {answer.content}")
        return answer.content

    def copy(self, gait: str, name: str, **changes: Any) -> str:
        """The id of a saved copy of a gait, with some fields of its document changed."""
        document = {**self.get(f"/api/gaits/{gait}"), "name": name, **changes}
        return str(self.post("/api/gaits", document)["id"])

    def edit(self, gait: str, label: str, **changes: Any) -> None:
        """Changes fields of a gait's document, as one edit."""
        document = {**self.get(f"/api/gaits/{gait}"), **changes}
        self.send("PUT", f"/api/gaits/{gait}?label={quote(label)}", document)

    def approve(self, gait: str) -> None:
        """Checks and approves a gait, warnings included."""
        self.post(f"/api/gaits/{gait}/check")
        self.post(f"/api/gaits/{gait}/approve", {"by": BY, "accept_warnings": True})

    def job(self, kind: str, gait: str, **more: Any) -> str:
        """The state in which a new job of a gait ends."""
        return self.end_of(self.post("/api/jobs", {"kind": kind, "gait": gait, **more}))

    def end_of(self, job: Any) -> str:
        """The state in which a job ends."""
        path = f"/api/jobs/{job['id']}"
        wait_for(lambda: self.get(path)["state"] in ENDED, f"the job {path} ended")
        return str(self.get(path)["state"])

    def cancel(self, job: Any) -> None:
        """Cancels a job once it is on."""
        path = f"/api/jobs/{job['id']}"
        wait_for(lambda: self.get(path)["started"] is not None, f"the job {path} is on")
        self.send("DELETE", path)
        wait_for(lambda: self.get(path)["state"] == "cancelled", f"the job {path} is cancelled")

    def text(self, path: str) -> str:
        """The text at a path."""
        return self.studio.text(path)
