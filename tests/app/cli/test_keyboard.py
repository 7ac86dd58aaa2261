"""Whether a person can be asked at the keyboard."""

from __future__ import annotations

import os
import sys
from pathlib import Path

import pytest

from app.cli.common.keyboard import forget_typed, has_keyboard, has_typed_line


def test_a_terminal_of_another_program_has_a_keyboard_but_nobody_to_ask(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    ours, theirs = os.openpty()
    with os.fdopen(theirs) as terminal:
        monkeypatch.setattr(sys, "stdin", terminal)
        os.write(ours, b"\n")
        assert has_keyboard()
        assert not forget_typed()
        assert not has_typed_line()
    os.close(ours)


@pytest.mark.parametrize("is_missing", [True, False])
def test_without_a_terminal_there_is_nobody(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, is_missing: bool
) -> None:
    (tmp_path / "input").write_text("\n")
    with (tmp_path / "input").open() as file:
        monkeypatch.setattr(sys, "stdin", None if is_missing else file)
        assert not has_keyboard()
        assert not forget_typed()
        assert not has_typed_line()
