"""The page's files as they lie on disk: what a strict content policy and an offline laboratory need."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from app.web.page import LATER

STATIC = Path(__file__).resolve().parents[2] / "app" / "static"
HTML = (STATIC / "index.html").read_text(encoding="utf-8")
TEXTS = {
    str(path.relative_to(STATIC)): path.read_text(encoding="utf-8")
    for path in sorted(STATIC.rglob("*"))
    if path.suffix in (".js", ".css")
}
"""Modules and style sheets."""
MODULES = {name: text for name, text in TEXTS.items() if name.endswith(".js")}
SCRIPT = "\n".join(MODULES.values())

IMPORTS = re.compile(
    r"""^(?:import|export)\s[^;"']*?from\s*["']([^"']+)["']|^import\s*["']([^"']+)["']"""
    r"""|\bimport\(\s*["']([^"']+)["']""",
    re.MULTILINE,
)
"""Static imports begin a line; a sentence with the word “from” is none."""

ELSEWHERE = re.compile(r"https?://|@import|url\(\s*['\"]?//")
NAMESPACE = "http://www.w3.org/2000/svg"
"""A name that browsers compare; nobody fetches it."""


def test_there_are_modules_and_style_sheets() -> None:
    assert len(MODULES) > 50
    assert len(TEXTS) - len(MODULES) > 5


def test_every_import_leads_to_a_file_of_this_folder() -> None:
    found = [
        (name, next(filter(None, targets)))
        for name, text in MODULES.items()
        for targets in IMPORTS.findall(text)
    ]
    assert len(found) > len(MODULES)
    astray = [
        f"{name}: {target}"
        for name, target in found
        if not target.startswith(("./", "../")) or not (STATIC / name).parent.joinpath(target).is_file()
    ]
    assert astray == [], "imports that lead nowhere"


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


@pytest.mark.parametrize("text", ['"https://x.org/a.js"', '@import "a.css";', "url(//x.org/a.png)"])
def test_what_leads_elsewhere_is_seen(text: str) -> None:
    assert leads_elsewhere(text)


def leads_elsewhere(text: str) -> bool:
    return ELSEWHERE.search(text.replace(NAMESPACE, "")) is not None


def test_nothing_is_fetched_from_elsewhere() -> None:
    files = {**TEXTS, "index.html": HTML}
    assert [name for name, text in files.items() if leads_elsewhere(text)] == []


PROMISED = (
    "Optimise", "Check", "Approve", "Connect", "Arm", "Send to robot", "Pause robot", "Resume robot",
    "Stop", "Clear", "Undo", "Redo", "Save", "Play", "Pause", "Footfall timeline", "Segment table",
    "3D preview", "Gaits", "Jobs", "Robot",
)  # fmt: skip


def test_the_promised_names_occur() -> None:
    text = HTML + SCRIPT
    assert [name for name in PROMISED if not re.search(rf"""["'>]{re.escape(name)}["'<]""", text)] == []


def test_the_word_emergency_stands_in_one_sentence_only() -> None:
    assert len(re.findall("emergency", HTML + SCRIPT, flags=re.IGNORECASE)) == 1
    assert not re.search(r"\be-stop\b", HTML + SCRIPT, flags=re.IGNORECASE)
