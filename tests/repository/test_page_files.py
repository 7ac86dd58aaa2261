"""The page's files as they lie on disk: what a strict content policy and an offline laboratory need."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from app.web.page import LATER

STATIC = Path(__file__).resolve().parents[2] / "app" / "static"
MODULES = sorted(STATIC.rglob("*.js"))
PAGE_MODULES = MODULES
SHEETS = sorted(STATIC.rglob("*.css"))
HTML = (STATIC / "index.html").read_text(encoding="utf-8")
SCRIPT = "\n".join(path.read_text(encoding="utf-8") for path in PAGE_MODULES)


IMPORTS = re.compile(
    r"""^(?:import|export)\s[^;"']*?from\s*["']([^"']+)["']|^import\s*["']([^"']+)["']"""
    r"""|\bimport\(\s*["']([^"']+)["']""",
    re.MULTILINE,
)
"""Static imports begin a line; a sentence with the word “from” is none."""


@pytest.mark.parametrize("path", MODULES, ids=lambda path: path.name)
def test_every_import_leads_to_a_file_of_this_folder(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    targets = [next(filter(None, found)) for found in IMPORTS.findall(text)]
    assert all(target.startswith("./") or target.startswith("../") for target in targets)
    missing = [target for target in targets if not (path.parent / target).is_file()]
    assert missing == []


def test_every_file_that_the_html_names_exists() -> None:
    named = re.findall(r'(?:src|href)="/static/([^"]+)"', HTML)
    assert len(named) >= 5
    assert [name for name in named if not (STATIC / name).is_file()] == []


def test_every_id_that_a_module_looks_up_stands_in_the_html() -> None:
    wanted = set(re.findall(r'byId\("([^"]+)"\)', SCRIPT))
    present = set(re.findall(r'\bid="([^"]+)"', HTML))
    # The server adds the template of the modules that come later.
    assert wanted - present == {LATER}


def test_html_keeps_to_the_strict_content_security_policy() -> None:
    assert not re.search(r"<style|\sstyle=|\son[a-z]+=", HTML)
    assert not re.search(r"<script(?![^>]*\ssrc=)", HTML)


@pytest.mark.parametrize("path", [*MODULES, *SHEETS, STATIC / "index.html"], ids=lambda path: path.name)
def test_nothing_is_fetched_from_elsewhere(path: Path) -> None:
    text = path.read_text(encoding="utf-8").replace("http://www.w3.org/2000/svg", "")
    assert not re.search(r"https?://|@import|url\(\s*['\"]?//", text)


@pytest.mark.parametrize(
    "name",
    [
        "Optimise", "Check", "Approve", "Connect", "Arm", "Send to robot", "Pause robot", "Resume robot",
        "Stop", "Clear", "Undo", "Redo", "Save", "Play", "Pause", "Footfall timeline", "Segment table",
        "3D preview", "Gaits", "Jobs", "Robot",
    ],
)  # fmt: skip
def test_the_promised_name_occurs(name: str) -> None:
    assert re.search(rf"""["'>]{re.escape(name)}["'<]""", HTML + SCRIPT)


def test_the_word_emergency_stands_in_one_sentence_only() -> None:
    assert len(re.findall("emergency", HTML + SCRIPT, flags=re.IGNORECASE)) == 1
    assert not re.search(r"\be-stop\b", HTML + SCRIPT, flags=re.IGNORECASE)


@pytest.mark.parametrize("path", [*PAGE_MODULES, *SHEETS], ids=lambda path: path.name)
def test_files_stay_small(path: Path) -> None:
    assert len(path.read_text(encoding="utf-8").splitlines()) <= 400
