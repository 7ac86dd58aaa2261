"""Somebody who uses the studio until it is killed."""

from __future__ import annotations

import threading
from collections import Counter
from http.client import HTTPException
from typing import Any

from tests.support.studio_process import Answer, StudioProcess


class GoneError(Exception):
    """The studio does not answer any more."""


class Actor(threading.Thread):
    """Does one thing after the other by HTTP until the studio no longer answers.

    Args:
        studio: which one.

    Attributes:
        doing: the kind of action that was asked for and is not answered yet; nothing in between.
        done: how many of each kind were answered.
        error: why it gave up while the studio lived.
    """

    def __init__(self, studio: StudioProcess) -> None:
        super().__init__(daemon=True)
        self._studio = studio
        self.doing = ""
        self.done: Counter[str] = Counter()
        self.error: BaseException | None = None

    def run(self) -> None:
        """Acts until the studio is gone."""
        try:
            while True:
                self.act()
        except GoneError:
            pass
        except BaseException as error:
            self.error = error

    def act(self) -> None:
        """One action, or several that belong together."""
        raise NotImplementedError

    def look(self, path: str) -> Any:
        """What stands at a path."""
        answer = self._ask("GET", path, None)
        assert answer.status == 200, (path, answer)
        return answer.content

    def change(self, kind: str, method: str, path: str, content: Any = None) -> Answer:
        """Asks for a change, which is in flight until it is answered."""
        self.doing = kind
        answer = self._ask(method, path, content)
        self.doing = ""
        self.done[kind] += 1
        return answer

    def _ask(self, method: str, path: str, content: Any) -> Answer:
        try:
            return self._studio.ask(method, path, content)
        except (HTTPException, OSError, ValueError) as error:  # no connection, or half an answer
            raise GoneError from error
