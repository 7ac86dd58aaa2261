"""The published data, where it is at hand; tests that need it are skipped elsewhere, saying so."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
import pytest

from core.arrays import Floats

REFERENCE = Path(__file__).resolve().parents[3] / "shared" / "reference"


def reference_path(name: str) -> Path:
    """A file of the published data; skips the test where it is absent."""
    path = REFERENCE / name
    if not path.exists():
        pytest.skip(f"the published data is not at {REFERENCE}")
    return path


def reference_rows(name: str) -> Floats:
    """Rows of numbers of a published CSV without a header."""
    with reference_path(name).open(newline="") as file:
        return np.array([[float(field) for field in row] for row in csv.reader(file)])
