"""The documentation: its links, the files and names that it mentions, and the glossary."""

from __future__ import annotations

import re
from collections.abc import Sequence
from functools import cache
from itertools import pairwise

import pytest

from tests.repository.source_tree import PARTS, files, listed
from tests.support.studio_process import PROJECT

DOCUMENTS = sorted(
    [
        "README.md",
        "SECURITY.md",
        "robot_description/README.md",
        *(f"docs/{p.name}" for p in PROJECT.glob("docs/*.md")),
    ]
)
LINK = re.compile(r"\]\(([^)#\s]+)(?:#[^)]*)?\)")
CODE = re.compile(r"`([^`\n]+)`")
ENTRY = re.compile(r"- \*\*([^*:]+)\*\*: ([A-Z].*\.)")
LONGEST_ENTRY = 140
FEWEST_WORDS, MOST_WORDS = 35, 50


def text_of(document: str) -> str:
    return (PROJECT / document).read_text(encoding="utf-8")


def dead_links(document: str, text: str) -> list[str]:
    """Links of a document that lead to no file."""
    folder = (PROJECT / document).parent
    targets = [target for target in LINK.findall(text) if not re.match(r"[a-z]+:", target)]
    return [f"{document}: there is no {target}" for target in targets if not (folder / target).exists()]


def lost_paths(document: str, text: str) -> list[str]:
    """Files and folders of the program that a document names and that are not there."""
    named = [
        code for code in CODE.findall(text) if code.split("/")[0] in (*PARTS, "tests", "docs") and "/" in code
    ]
    plain = [code for code in named if re.fullmatch(r"[\w./-]+", code)]
    return [f"{document}: there is no {path}" for path in plain if not (PROJECT / path).exists()]


def unknown_names(text: str) -> list[str]:
    """Classes, functions and constants that a document names and that occur nowhere in the program."""
    named = {code for code in CODE.findall(text) if re.fullmatch(r"[A-Za-z][A-Za-z_]{3,}", code)}
    return sorted(name for name in named if name not in names_in_code() and not (PROJECT / name).exists())


@cache
def names_in_code() -> frozenset[str]:
    paths = [*files(".py", ".js"), "tests/repository/rooms.py"]
    return frozenset(word for path in paths for word in re.findall(r"\w+", (PROJECT / path).read_text()))


def faults_of_glossary(lines: Sequence[str]) -> list[str]:
    """What is wrong with the lines of a glossary: form, length, order, or words given twice."""
    entries = [ENTRY.fullmatch(line) for line in lines]
    faults = [
        f"“{line}” is not “- **word**: Sentence.”" for line, e in zip(lines, entries, strict=True) if not e
    ]
    faults += [
        f"“{line}” is longer than {LONGEST_ENTRY} characters" for line in lines if len(line) > LONGEST_ENTRY
    ]
    words = [entry.group(1).casefold() for entry in entries if entry]
    faults += [f"“{word}” stands twice" for word in sorted({word for word in words if words.count(word) > 1})]
    return faults + [f"“{b}” comes before “{a}”" for a, b in pairwise(words) if b < a]


def test_every_link_leads_to_a_file() -> None:
    offenders = [line for document in DOCUMENTS for line in dead_links(document, text_of(document))]
    assert sum(len(LINK.findall(text_of(document))) for document in DOCUMENTS) > 30
    assert not offenders, listed(offenders)


def test_every_path_that_a_document_names_is_there() -> None:
    offenders = [line for document in DOCUMENTS for line in lost_paths(document, text_of(document))]
    assert not offenders, listed(offenders)


def test_every_name_in_the_architecture_occurs_in_the_code() -> None:
    assert unknown_names(text_of("docs/architecture.md")) == []


def test_what_is_not_there_is_found() -> None:
    text = "[This](gone.md), [that](checks.md#rules), [far](https://a.org); `core/gone/x.py`, `check_planet`."
    assert dead_links("docs/checks.md", text) == ["docs/checks.md: there is no gone.md"]
    assert lost_paths("docs/checks.md", text) == ["docs/checks.md: there is no core/gone/x.py"]
    assert unknown_names(text) == ["check_planet"]


def test_the_glossary_is_sorted_and_has_one_line_a_word() -> None:
    lines = [
        line
        for line in text_of("docs/glossary.md").split("\n")[1:]
        if line and not line.startswith("The words")
    ]
    assert faults_of_glossary(lines) == []
    assert FEWEST_WORDS <= len(lines) <= MOST_WORDS


@pytest.mark.parametrize(
    "lines",
    [
        ["- **gait**: The document.", "- **foot**: The end of a leg."],
        ["- **gait**: The document.", "- **Gait**: The document again."],
        ["- **gait**: The document"],
        ["gait: The document."],
        ["- **gait**: The document.", "that a person edits."],
        ["- **gait**: " + "The document " * 12 + "."],
    ],
)
def test_a_faulty_glossary_is_refused(lines: list[str]) -> None:
    assert faults_of_glossary(lines) != []
