"""`bench --docs`: the commands whose figures the documents quote, run again."""

import json
import os
import shlex
import subprocess
from argparse import Namespace
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from tempfile import TemporaryDirectory

import footfall
from app.bench.printed_figures import Difference, differences, lost_figures
from app.bench.quoted_figures import FOLDER, Kind, Quotation, Uncompared, read_documents
from app.cli.common.output import NOT_FIT, note, show
from app.common.json import Json
from app.common.own_command import own_command
from app.published.reference import find_folder
from core.errors import InputError

ROOT = Path(footfall.__file__).resolve().parent
"""Folder of the source tree, where the documents stand."""


def run_documents(options: Namespace) -> int:
    """Runs the quick commands whose figures the documents quote, and names the figures that differ.

    Args:
        options: `names` (benchmarks that are run instead, however long they take) and `reference`.

    Returns:
        0 where all agree, `NOT_FIT` where some differ.

    Raises:
        InputError: the documents are not there, are malformed, or quote nothing of a named benchmark; or the
            folder of published data is not there.
    """
    if options.reference is not None:
        find_folder(options.reference)
    documents = read_documents(ROOT)
    found = [quotation for document in documents for quotation in document.quotations]
    chosen = [quotation for quotation in found if _is_run(quotation, options.names, options.reference)]
    for name in options.names:
        if not any(name in quotation.benchmarks for quotation in chosen):
            raise InputError(f"No figure of {name} can be compared{_why(found, name)}.", "NAME")
    differing = [lost for quotation in found for lost in lost_figures(quotation)]
    printed: dict[str, Json] = {}
    for quotation in chosen:
        if quotation.command not in printed:
            note(f"Running {quotation.command} …")
            printed[quotation.command] = content_of(quotation.command, options.reference)
        differing += differences(quotation, printed[quotation.command])
    left = [quotation for quotation in found if quotation not in chosen]
    uncompared = [one for document in documents for one in document.uncompared]
    content: Json = {
        "compared": _figures(chosen),
        "differ": [asdict(one) for one in differing],
        "not_compared": [asdict(one) for one in uncompared],
        "not_run": [
            {"file": one.file, "line": one.line, "command": one.command, "why": _why_not(one)} for one in left
        ],
    }
    show(options, content, _lines(chosen, differing, left, uncompared))
    return NOT_FIT if differing else 0


def _is_run(quotation: Quotation, names: Sequence[str], reference: Path | None) -> bool:
    if FOLDER in shlex.split(quotation.command) and reference is None:
        return False
    if names:
        return quotation.kind is not Kind.MACHINE and set(quotation.benchmarks) & set(names) != set()
    return quotation.kind is Kind.QUICK


def _why(found: Sequence[Quotation], name: str) -> str:
    own = [quotation for quotation in found if name in quotation.benchmarks]
    if any(quotation.kind is not Kind.MACHINE for quotation in own):
        return " without published data; name its folder after --reference"
    return ": it measures times" if own else ": no document names this command for one"


def content_of(command: str, reference: Path | None) -> Json:
    """The JSON of a command, or of the last of several that `&&` joins; `{"error": …}` where it prints none.

    Args:
        command: as a person types it; it runs in an empty folder, with an empty data folder.
        reference: stands in place of `FOLDER`.
    """
    content: Json = {}
    data = FOLDER if reference is None else str(reference.resolve())
    with TemporaryDirectory() as folder:
        environment = os.environ | {"XDG_DATA_HOME": folder}
        for part in command.split("&&"):
            words = [data if word == FOLDER else word for word in shlex.split(part)]
            done = subprocess.run(
                own_command(*words[1:]), cwd=folder, env=environment, capture_output=True, check=False
            )
            try:
                content = {**json.loads(done.stdout)}
            except (ValueError, TypeError):
                last = done.stderr.decode(errors="replace").strip().rpartition("\n")[2]
                content = {"error": f"status {done.returncode}, {last or 'no JSON'}"}
    return content


def _why_not(quotation: Quotation) -> str:
    if quotation.kind is not Kind.QUICK:
        return quotation.kind.value
    return "needs --reference" if FOLDER in quotation.command else "not named"


def _figures(quotations: Sequence[Quotation]) -> int:
    return sum(len(figure.places) for quotation in quotations for figure in quotation.figures)


def _lines(
    chosen: Sequence[Quotation],
    differing: Sequence[Difference],
    left: Sequence[Quotation],
    uncompared: Sequence[Uncompared],
) -> list[str]:
    lines = [f"{one.file}:{one.line}: “{one.figure}”, now {one.printed}: {one.command}" for one in differing]
    commands = len({quotation.command for quotation in chosen})
    lines.append(f"{_figures(chosen)} figures of {commands} commands were compared; {len(differing)} differ.")
    if left:
        lines += ["", "Not run, since it is slow, its figures depend on the machine, or it was not named:"]
        lines += [f"  {one.file}:{one.line}: {_why_not(one)}: {one.command}" for one in left]
    if uncompared:
        lines += ["", "Numbers beside compared figures that are not compared themselves:"]
        lines += [f"  {one.file}:{one.line}: {' '.join(one.numbers)}" for one in uncompared]
    return lines
