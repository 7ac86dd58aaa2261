"""The page's files: served whole, asked for again, and none from elsewhere."""

from __future__ import annotations

import gzip
import os
import re
import urllib.error
import urllib.request
from pathlib import Path

import pytest

from app.web.page import ModulePage
from tests.support.studio_process import PROJECT, StudioProcess

STATIC = PROJECT / "app" / "static"


@pytest.fixture(scope="module")
def studio(lent_studio: StudioProcess) -> StudioProcess:
    return lent_studio


def get(studio: StudioProcess, path: str, **headers: str) -> tuple[int, dict[str, str], bytes]:
    request = urllib.request.Request(studio.url + path, headers=headers)
    try:
        with urllib.request.urlopen(request, timeout=60) as answer:
            return answer.status, dict(answer.headers), answer.read()
    except urllib.error.HTTPError as error:
        with error:
            return error.code, dict(error.headers), error.read()


@pytest.mark.parametrize(
    ("name", "kind"),
    [("editor.js", "javascript"), ("shell/base.css", "text/css"), ("icon.svg", "image/svg+xml")],
)
def test_a_file_comes_whole_with_its_kind_and_is_asked_for_again(
    studio: StudioProcess, name: str, kind: str
) -> None:
    status, headers, body = get(studio, f"static/{name}")
    assert (status, body) == (200, (STATIC / name).read_bytes())
    assert kind in headers["content-type"]
    assert headers["cache-control"] == "no-cache"
    assert headers["x-content-type-options"] == "nosniff"
    again = get(studio, f"static/{name}", **{"if-none-match": headers["etag"]})
    assert (again[0], again[2]) == (304, b"")
    assert get(studio, f"static/{name}", **{"if-none-match": '"other"'})[0] == 200


@pytest.mark.parametrize(
    "path",
    ["static/nope.js", "static/", "static/../server.py", "static/%2e%2e/server.py", "static/%00"]
    + ["static/" + "a" * 300],
)
def test_what_is_not_a_file_of_the_page_is_not_given(studio: StudioProcess, path: str) -> None:
    assert get(studio, path)[0] == 404


def versioned(studio: StudioProcess) -> list[str]:
    """Paths that the page names with its version, in its order."""
    return re.findall(r'"/(static/~[^"]+)"', get(studio, "")[2].decode())


def test_what_the_page_names_is_kept_without_asking_and_an_older_version_is_not(
    studio: StudioProcess,
) -> None:
    paths = versioned(studio)
    assert len(paths) > 5
    for path in (paths[0], paths[-1]):
        status, headers, body = get(studio, path)
        assert (status, "immutable" in headers["cache-control"]) == (200, True)
        older = get(studio, re.sub("~[0-9a-f]+", "~0123456789ab", path))
        assert (older[0], older[1]["cache-control"], older[2]) == (200, "no-cache", body)


def test_the_style_sheets_come_as_one_in_the_order_of_the_html(studio: StudioProcess) -> None:
    names = re.findall(r'rel="stylesheet" href="/static/([^"]+)"', (STATIC / "index.html").read_text())
    (path,) = (path for path in versioned(studio) if path.endswith(".css"))
    _, headers, body = get(studio, path)
    assert "text/css" in headers["content-type"]
    assert body == b"".join((STATIC / name).read_bytes() for name in names)


def test_a_file_is_packed_for_who_takes_it_so(studio: StudioProcess) -> None:
    _, plain, body = get(studio, "static/editor.js")
    assert "content-encoding" not in plain
    status, headers, packed = get(studio, "static/editor.js", **{"accept-encoding": "gzip, br"})
    assert (status, headers["content-encoding"], headers["vary"]) == (200, "gzip", "accept-encoding")
    assert gzip.decompress(packed) == body
    assert len(packed) < 0.6 * len(body)
    assert headers["etag"] != plain["etag"]


def imports(path: Path) -> set[str]:
    """What a module imports before it runs, as names below the folder."""
    found = re.findall(r'from "(\.[^"]+)"', path.read_text())
    return {os.path.normpath(path.relative_to(STATIC).parent / name) for name in found}


def test_the_page_names_every_module_that_it_needs_and_no_other(studio: StudioProcess) -> None:
    page = get(studio, "")[2].decode()
    named = re.findall(r'rel="modulepreload" href="/static/~[^/]+/([^"]+)"', page)
    assert len(named) == len(set(named))
    needed = {"api/socket.js", "boot.js", "editor.js", "panels.js"}.union(
        *(imports(STATIC / name) for name in named)
    )
    assert set(named) == needed


def test_the_list_waits_for_few_modules(studio: StudioProcess) -> None:
    at_once = get(studio, "")[2].decode().split("<template")[0]
    first = re.findall(r'rel="modulepreload" href="/static/~[^/]+/([^"]+)"', at_once)
    assert {"boot.js", "shell/gait_list.js", "state/server_events.js", "api/socket.js"} <= set(first)
    assert len(first) <= 17


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    script = '<script type="module" src="/static/a.js"></script>'
    preload = '<link rel="modulepreload" href="/static/b.js">'
    (tmp_path / "index.html").write_text(f"<head><title>A</title>{script}{preload}</head>")
    (tmp_path / "a.js").write_text('import("./b.js");\n')
    (tmp_path / "b.js").write_text("export const b = 1;\n")
    (tmp_path / "c.js").write_text("export const c = 1;\n")
    return tmp_path


def test_a_changed_module_changes_the_page_and_its_version(folder: Path) -> None:
    page = ModulePage(folder)
    before = page.now()
    assert page.now() is before
    assert before.text.count("modulepreload") == 2
    (folder / "b.js").write_text('import {\n  c,\n} from "./c.js";\nexport const b = c;\n')
    os.utime(folder / "b.js", ns=(1, 1))
    assert page.now().text.count("modulepreload") == 3
    assert page.now().version != before.version


def test_what_is_imported_on_demand_is_not_named(folder: Path) -> None:
    (folder / "b.js").write_text('export const show = () => import("./c.js");\n')
    named = re.findall(r'modulepreload" href="/static/~[^/]+/([^"]+)"', ModulePage(folder).now().text)
    assert named == ["a.js", "b.js"]
