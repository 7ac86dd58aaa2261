"""What tests of trials share."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from app.vision.services import Eyes, open_eyes


@pytest.fixture(scope="module")
def eyes() -> Iterator[Eyes]:
    """The processes that look at pictures."""
    opened = open_eyes()
    yield opened
    opened.close()
