"""Running the command line within a test."""

from __future__ import annotations

import json
from typing import Any

import pytest

from app.cli import main


def run(capsys: pytest.CaptureFixture[str], *words: str) -> tuple[int, str, str]:
    """Exit status, standard output and standard error."""
    status = main(words)
    captured = capsys.readouterr()
    return status, captured.out, captured.err


def run_json(capsys: pytest.CaptureFixture[str], *words: str) -> tuple[int, Any]:
    """Exit status and the one JSON object."""
    status, out, _ = run(capsys, *words, "--json")
    return status, json.loads(out)
