"""The studio for scripts: shows a gait or a plan in the browser."""

from __future__ import annotations

import atexit
import json
import subprocess
import tempfile
import time
import urllib.error
import urllib.request
import webbrowser
from contextlib import suppress
from http.client import HTTPException
from pathlib import Path
from urllib.parse import quote

from app.common.own_command import own_command
from app.documents.gait_json import gait_content
from app.scripting.gaits import Gait, gait
from app.scripting.plans import Plan
from app.store.folder_lock import studio_address
from app.store.gait_files import default_data_folder
from core.errors import InputError, StateError

ANSWER_SECONDS, START_SECONDS, LOOK_SECONDS = 30.0, 60.0, 0.1

_ours: list[subprocess.Popen[bytes]] = []
"""The studios that this program has started."""
_shown: dict[tuple[Path, str], str] = {}
"""Ids of the gaits that were shown, by data folder and document."""


def show(
    source: Plan | Gait | str | Path, *, data: str | Path | None = None, opens_browser: bool = True
) -> str:
    """Shows a gait in a studio: in the one that is running, else in one that ends with this program.

    The gait is saved in the studio's data folder, as a new one where it is not there yet. Of a plan its gait
    is shown, of which the studio makes a plan of its own.

    Args:
        source: a gait as for `footfall.gait`, or a plan of one; its lengths are in m.
        data: the studio's data folder; the usual one where None.
        opens_browser: whether to open a browser tab.

    Returns:
        The address of the page; no arrays.

    Raises:
        InputError: there is no such gait, or the plan is of waypoints alone.
        StateError: the running studio demands a token, or none could be started.

    Example:
        >>> import footfall as ff
        >>> ff.show("walk")  # doctest: +SKIP
        'http://127.0.0.1:8400/?gait=walk'
    """
    of = source.gait if isinstance(source, Plan) else gait(source)
    if of is None:
        raise InputError("This plan is of waypoints alone; the studio shows gaits.", "source")
    folder = (default_data_folder() if data is None else Path(data)).expanduser()
    address = studio_address(folder) or _started(folder)
    page = f"{address}?gait={quote(_kept(address, folder, of))}"
    if opens_browser:
        webbrowser.open(page)
    return page


def _kept(address: str, folder: Path, of: Gait) -> str:
    """The gait's id in the studio; a new one where the studio has another gait, or none, under its id."""
    content = gait_content(of.document)
    key = folder, json.dumps(content)
    for gait_id in (of.id, _shown.get(key)):
        if gait_id is not None and _asked(f"{address}api/gaits/{quote(gait_id)}") == content:
            return gait_id
    made = _asked(f"{address}api/gaits", content)
    if "id" not in made:
        raise StateError(f"The studio at {address} did not take the gait.", "studio")
    _shown[key] = str(made["id"])
    return _shown[key]


def _asked(url: str, content: object = None) -> dict[str, object]:
    """The studio's answer; nothing where it has no such gait."""
    body = None if content is None else json.dumps(content).encode()
    request = urllib.request.Request(url, body, {"content-type": "application/json"})
    # No proxy stands between a program and a studio on the same computer.
    opener = urllib.request.build_opener(urllib.request.ProxyHandler({}))
    try:
        with opener.open(request, timeout=ANSWER_SECONDS) as answer:
            found: dict[str, object] = json.load(answer)
            return found
    except urllib.error.HTTPError as error:
        with error:
            if error.code == 404 and content is None:
                return {}
            demands = error.code in (401, 403)
            sentence = "it demands a token. Use its page, or end it." if demands else _sentence(error)
        raise StateError(f"The studio at {url} refuses: {sentence}", "studio") from error
    except (OSError, ValueError, HTTPException) as error:
        raise StateError(f"The studio at {url} does not answer: {error}", "studio") from error


def _sentence(error: urllib.error.HTTPError) -> str:
    """What the studio says, or else what the status means."""
    with suppress(ValueError, OSError, AttributeError):
        said = json.loads(error.read()).get("error")
        if isinstance(said, str):
            return said
    return str(error.reason)


def _started(folder: Path) -> str:
    """Starts a studio of our own, on a free port; it ends with this program, and no sooner."""
    words = own_command("serve", "--no-browser", "--port", "0", "--data", str(folder))
    with tempfile.TemporaryFile() as said:
        process = subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=said, process_group=0)
        deadline = time.monotonic() + START_SECONDS
        while process.poll() is None and time.monotonic() < deadline:
            address = studio_address(folder) if folder.exists() else None
            if address is not None:
                _ours.append(process)
                return address
            time.sleep(LOOK_SECONDS)
        process.terminate()
        process.wait()
        said.seek(0)
        raise StateError(f"The studio did not start: {said.read().decode().strip()}", "studio")


def _end() -> None:
    for process in _ours:
        process.terminate()
    for process in _ours:
        process.wait()


atexit.register(_end)
