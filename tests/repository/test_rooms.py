"""The folders: order, files, sizes and sentences; and that imports of files form no circle."""

from __future__ import annotations

from itertools import pairwise

import pytest

from tests.repository.rooms import (
    DOCUMENT,
    MOST_FILES,
    MOST_LINES,
    MOST_ON_OWN_LEVEL,
    ROOMS,
    ROW,
    overfull,
    overlong,
    python_sentences,
    sentence,
    undocumented,
    why_misplaced,
    why_out_of_order,
)
from tests.repository.source_tree import (
    PAGE_CODE,
    PARTS,
    STATIC,
    circle,
    files,
    files_imported,
    folder_of,
    folders_imported,
    js_imports,
    listed,
)
from tests.support.studio_process import PROJECT


def test_folders_import_only_folders_below_them() -> None:
    found = {(path, below) for path in files(".py", ".js") for below in folders_imported(path)}
    reasons = [(path, why_out_of_order(folder_of(path), below)) for path, below in sorted(found)]
    offenders = [f"{path}: {why}" for path, why in reasons if why is not None]
    assert len(found) > 1000
    assert not offenders, listed(offenders)


@pytest.mark.parametrize(
    ("folder", "imported"),
    [
        ("core/robot", "core/gait"),
        ("core", "core/robot"),
        ("solver_jobs/nlp", "solver_jobs/live"),
        ("solver_jobs/workers", "solver_jobs"),
        ("app/store", "app/gaits"),
        ("app/gaits", "app/studio"),
        ("app/routes/gaits", "app/routes"),
        ("app/bench/page", "app/bench"),
        ("app/server", "app/cli"),
        ("app/static/lib", "app/static/state"),
        ("app/static/plots", "app/static/preview"),
        ("app/static/shell", "app/static"),
    ],
)
def test_the_order_refuses(folder: str, imported: str) -> None:
    assert why_out_of_order(folder, imported) is not None
    assert why_out_of_order(imported, folder) is None


def test_imports_of_a_module_of_the_page_are_read() -> None:
    text = """
/** Names `import { x } from "../lab/panel.js"` and @type {import("../robot/jog.js").Jog}. */
import { h } from "../lib/dom.js";
import {
  watch,
} from '../state/store.js';
export { watch } from "./near.js";
const shown = /** @type {import("../robot/jog.js").Jog} */ (watch());
// import { old } from "../runs/runs.js";
const later = () => import("../check/check.js");
"""
    found = [path.removeprefix(f"{STATIC}/") for path in js_imports(f"{STATIC}/plots/x.js", text)]
    assert found == ["lib/dom.js", "state/store.js", "plots/near.js", "check/check.js"]


@pytest.mark.parametrize("suffix", [".py", ".js"])
def test_imports_of_files_form_no_circle(suffix: str) -> None:
    imported = {path: files_imported(path) for path in files(suffix)}
    assert sum(map(len, imported.values())) > 500
    assert " → ".join(circle(imported)) == ""


def test_a_circle_is_found_in_the_order_of_its_imports() -> None:
    imported = {"a": ["b", "x"], "b": ["c"], "c": ["x"], "d": ["a"]}
    assert circle(imported) == []
    found = circle({**imported, "c": ["a"]})
    assert found[0] == found[-1]
    assert sorted(pairwise(found)) == [("a", "b"), ("b", "c"), ("c", "a")]


def test_every_file_stands_in_a_known_folder() -> None:
    paths = files(".py", *PAGE_CODE)
    reasons = [(path, why_misplaced(path)) for path in paths]
    offenders = [f"{path}: {why}" for path, why in reasons if why is not None]
    assert len(paths) > 500
    assert not offenders, listed(offenders)


@pytest.mark.parametrize(
    "path",
    [
        "core/helpers/arrays.py",
        "app/gaits/old/service.py",
        "app/static/timeline/grid/cells.js",
        "app/static/widgets/button.css",
        "app/robot/panel.js",
        "app/static/state/store.py",
    ],
)
def test_a_misplaced_file_is_refused(path: str) -> None:
    assert why_misplaced(path) is not None


def test_every_known_folder_holds_code() -> None:
    there = {folder_of(path) for path in files(".py", *PAGE_CODE)}
    assert [room for room in ROOMS if room not in there] == []
    assert len(set(ROOMS)) == len(ROOMS)


def test_no_folder_holds_too_many_files() -> None:
    crowded = overfull(files(".py", *PAGE_CODE))
    assert not crowded, listed(crowded)


@pytest.mark.parametrize("folder", ["core/gait", "app/static/shell", *MOST_ON_OWN_LEVEL])
def test_a_crowded_folder_is_refused(folder: str) -> None:
    most = MOST_ON_OWN_LEVEL.get(folder, MOST_FILES)
    paths = [f"{folder}/__init__.py", *(f"{folder}/file{number}.py" for number in range(most))]
    assert overfull(paths) == []
    assert len(overfull([*paths, f"{folder}/one_more.js"])) == 1


def test_no_file_has_too_many_lines() -> None:
    paths = [*files(".py", parts=(*PARTS, "tests")), *files(".js", ".css")]
    offenders = overlong({path: len((PROJECT / path).read_text().splitlines()) for path in paths})
    assert len(paths) > 1000
    assert not offenders, listed(offenders)


def test_a_long_file_is_refused() -> None:
    assert overlong({"core/names.py": MOST_LINES}) == []
    assert len(overlong({"core/names.py": MOST_LINES + 1})) == 1


def test_every_folder_of_python_has_a_docstring_of_one_sentence() -> None:
    without = [
        f"{room}/__init__.py needs one sentence" for room, text in python_sentences().items() if not text
    ]
    assert not without, listed(without)


@pytest.mark.parametrize(
    "text", [None, "", "no capital.", "No full stop", "Two. Sentences.", "Goes on\nin the next line."]
)
def test_a_docstring_that_is_not_one_sentence_is_refused(text: str | None) -> None:
    assert sentence(text) is None


def test_the_document_has_every_folder_in_order_with_its_sentence() -> None:
    rows = ROW.findall((PROJECT / DOCUMENT).read_text())
    offenders = undocumented(dict(rows), python_sentences())
    assert not offenders, listed(offenders)
    assert tuple(room for room, _ in rows) == ROOMS, f"the rows of {DOCUMENT} are not in the order of ORDER"


def test_a_document_that_differs_is_refused() -> None:
    sentences = python_sentences()
    rows = {room: sentences.get(room) or "Something of the page." for room in ROOMS}
    assert undocumented(rows, sentences) == []
    assert len(undocumented({**rows, "core/gone": "It was here."}, sentences)) == 1
    assert len(undocumented({**rows, "core/robot": "Another sentence."}, sentences)) == 1
    assert len(undocumented({**rows, "app/static/lib": "no sentence"}, sentences)) == 1
    del rows["app/static/lib"]
    assert len(undocumented(rows, sentences)) == 1
