"""The files of versions agree: what is allowed, what was tested, its hashes, and the oldest ones."""

from __future__ import annotations

import ast
import re
import sys
import tomllib
from collections.abc import Iterable

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name
from packaging.version import Version

from tests.support.studio_process import PROJECT

TESTED, HASHED, OLDEST = "constraints.txt", "requirements-hashed.txt", "lowest-versions.txt"
HASH = re.compile(r"--hash=sha256:[0-9a-f]{64}")
MACHINES = (("linux", "x86_64"), ("linux", "aarch64"), ("darwin", "arm64"), ("win32", "AMD64"))
PLATFORMS = [
    {"sys_platform": system, "platform_machine": machine, "python_full_version": f"{python}.0"}
    for system, machine in MACHINES
    for python in ("3.11", "3.12", "3.13", "3.14")
]
CPYTHON = {"platform_python_implementation": "CPython"}


def requirements(file: str) -> list[tuple[Requirement, list[str]]]:
    """The requirements of a file, each with its hashes."""
    text = re.sub(r"^#.*\n", "", (PROJECT / file).read_text(), flags=re.M).replace("\\\n", " ")
    lines = [line for line in text.splitlines() if line.strip()]
    return [(Requirement(HASH.sub("", line)), HASH.findall(line)) for line in lines]


def pinned(file: str) -> dict[str, Version]:
    """The versions that a file pins, by name."""
    found: dict[str, Version] = {}
    for requirement, _ in requirements(file):
        (only,) = requirement.specifier
        assert only.operator == "==", requirement
        name = canonicalize_name(requirement.name)
        assert name not in found, requirement
        found[name] = Version(only.version)
    return found


def allowed() -> list[Requirement]:
    """What the program and its tests ask for."""
    project = tomllib.loads((PROJECT / "pyproject.toml").read_text())["project"]
    return [
        Requirement(text) for text in (*project["dependencies"], *project["optional-dependencies"]["dev"])
    ]


def not_allowed(versions: dict[str, Version], asked: Iterable[Requirement]) -> list[str]:
    """The requirements that a file's versions do not keep."""
    return [str(one) for one in asked if versions[canonicalize_name(one.name)] not in one.specifier]


def test_the_hashed_file_has_the_names_and_versions_of_the_constraints() -> None:
    assert len(pinned(TESTED)) > 50
    assert pinned(HASHED) == pinned(TESTED)


def test_every_version_in_the_hashed_file_has_hashes() -> None:
    assert [str(one) for one, hashes in requirements(HASHED) if not hashes] == []


@pytest.mark.parametrize("platform", PLATFORMS, ids=lambda one: "-".join(one.values()))
def test_the_hashed_file_has_what_the_program_asks_for_on_each_platform(platform: dict[str, str]) -> None:
    there = {
        canonicalize_name(one.name)
        for one, _ in requirements(HASHED)
        if one.marker is None or one.marker.evaluate(platform | CPYTHON)
    }
    assert {canonicalize_name(one.name) for one in allowed()} - there == set()


@pytest.mark.parametrize("file", [TESTED, HASHED, OLDEST])
def test_the_versions_of_a_file_are_allowed(file: str) -> None:
    assert not_allowed(pinned(file), allowed()) == []


@pytest.mark.parametrize("file", [TESTED, HASHED, OLDEST])
def test_a_file_says_nothing_of_where_packages_come_from(file: str) -> None:
    text = (PROJECT / file).read_text()
    assert re.findall(r"://|--(?:extra-)?index|--find-links|--trusted-host", text) == []


def test_the_oldest_versions_are_those_of_the_bounds() -> None:
    oldest, wrong = pinned(OLDEST), []
    for one in allowed():
        (bound,) = (Version(part.version) for part in one.specifier if part.operator == ">=")
        found = oldest[canonicalize_name(one.name)]
        # The first version of a series may have another last digit: 1.2.1 where 1.2 was never published.
        if found.release[: len(bound.release)] != bound.release:
            wrong.append(f"{one}: {found}")
    assert wrong == []


def test_the_physics_engine_with_a_wrong_factorisation_is_excluded() -> None:
    (physics,) = (one for one in allowed() if one.name == "mujoco-core")
    assert "4.0.0" not in physics.specifier
    assert "4.0.1" in physics.specifier


MADE_TO_DERIVE_FROM = {
    "casadi.Callback",
    "matplotlib.figure.Figure",
    "msgspec.Struct",
    "ortools.sat.python.cp_model.CpSolverSolutionCallback",
    "pydantic.BaseModel",
    "starlette.exceptions.HTTPException",
}
"""Classes of others that their documentation has people derive from."""


def imported_names(tree: ast.Module) -> dict[str, str]:
    """What a file calls what it imports from others, with the whole name of that."""
    found: dict[str, str] = {}
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and node.module and not node.level:
            found |= {one.asname or one.name: f"{node.module}.{one.name}" for one in node.names}
        elif isinstance(node, ast.Import):
            found |= {one.asname or one.name: one.name for one in node.names}
    return found


def internals(tree: ast.Module) -> set[str]:
    """Names of others' private modules that a file imports, and of others' classes that it derives from."""
    names = imported_names(tree)
    private = {name for name in names.values() if re.search(r"\._[a-z]", name.rpartition(".")[0])}
    bases = {
        ast.unparse(base) for node in ast.walk(tree) if isinstance(node, ast.ClassDef) for base in node.bases
    }
    whole = {
        names[base.partition(".")[0]] + base[len(base.partition(".")[0]) :]
        for base in bases
        if base.partition(".")[0] in names
    }
    return {
        name
        for name in private | whole - MADE_TO_DERIVE_FROM
        if name.partition(".")[0] not in {*sys.stdlib_module_names, "app", "core", "solver_jobs"}
    }


def test_whose_internals_are_used_has_an_upper_bound() -> None:
    files = [path for room in ("app", "core", "solver_jobs") for path in (PROJECT / room).rglob("*.py")]
    used = {name.partition(".")[0] for path in files for name in internals(ast.parse(path.read_text()))}
    bounded = {
        canonicalize_name(one.name)
        for one in allowed()
        if any(limit.operator == "<" for limit in one.specifier)
    }
    assert used >= {"uvicorn", "websockets"}
    assert used <= bounded


def test_internals_are_found_by_whatever_name_they_are_imported() -> None:
    text = "import h11 as wire\nfrom a._b import C\nfrom pydantic import BaseModel as B\n"
    text += "class X(wire.Connection): ...\nclass Y(C): ...\nclass Z(B): ...\n"
    assert internals(ast.parse(text)) == {"h11.Connection", "a._b.C"}
