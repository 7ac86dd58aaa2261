"""The studio for scripts: shows a gait or a plan in the browser."""

from __future__ import annotations

import atexit
import json
import subprocess
import sys
import urllib.error
import urllib.request
import webbrowser
from pathlib import Path
from urllib.parse import quote

from app.documents.gait_json import gait_content
from app.scripting.gaits import Gait, gait
from app.scripting.plans import Plan
from app.store.folder_lock import studio_address
from app.store.gait_files import default_data_folder
from core.errors import InputError, StateError

READY = "is ready at "
ANSWER_SECONDS = 30.0

_ROOT = Path(__file__).resolve().parents[2]
_BEGIN = (
    f"import sys; sys.path.insert(0, {str(_ROOT)!r}); from footfall.app.cli import main; sys.exit(main())"
)
_ours: dict[Path, subprocess.Popen[str]] = {}


def show(
    source: Plan | Gait | str | Path, *, data: str | Path | None = None, opens_browser: bool = True
) -> str:
    """Shows a gait in a studio: in the one that is running, else in one that ends with this program.

    The gait is saved in the studio's data folder, as a new one where it is not there yet.

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
    page = f"{address}?gait={quote(_kept(address, of))}"
    if opens_browser:
        webbrowser.open(page)
    return page


def _kept(address: str, of: Gait) -> str:
    """The gait's id in the studio; a new one where the studio has another gait, or none, under its id."""
    content = gait_content(of.document)
    if of.id is not None and _asked(f"{address}api/gaits/{quote(of.id)}") == content:
        return of.id
    made = _asked(f"{address}api/gaits", content)
    return str(made["id"])


def _asked(url: str, content: object = None) -> dict[str, object]:
    body = None if content is None else json.dumps(content).encode()
    request = urllib.request.Request(url, body, {"content-type": "application/json"})
    try:
        with urllib.request.urlopen(request, timeout=ANSWER_SECONDS) as answer:
            found: dict[str, object] = json.load(answer)
            return found
    except urllib.error.HTTPError as error:
        with error:
            if error.code == 404:
                return {}
            demands = error.code in (401, 403)
            sentence = "it demands a token. Use its page, or end it." if demands else error.reason
        raise StateError(f"The studio at {url} refuses: {sentence}", "studio") from error
    except OSError as error:
        raise StateError(f"The studio at {url} does not answer: {error}", "studio") from error


def _started(folder: Path) -> str:
    """Starts a studio of our own, on a free port; it ends with this program."""
    words = [sys.executable, "-c", _BEGIN, "serve", "--no-browser", "--port", "0", "--data", str(folder)]
    process = subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert process.stdout is not None
    for line in process.stdout:
        if READY in line:
            _ours[folder] = process
            return line.partition(READY)[2].strip()
    _, said = process.communicate()
    raise StateError(f"The studio did not start: {said.strip()}", "studio")


def _end() -> None:
    for process in _ours.values():
        process.terminate()


atexit.register(_end)
