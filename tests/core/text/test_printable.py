"""Control characters become escapes; everything else stays."""

from __future__ import annotations

import json
import unicodedata

import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.text.printable import printable_line, printable_text

BIDIRECTIONAL = {"LRE", "RLE", "LRO", "RLO", "PDF", "LRI", "RLI", "FSI", "PDI"}


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("\x1b[31mred\x1b[0m", r"\u001b[31mred\u001b[0m"),
        ("\x9b2J", r"\u009b2J"),
        ("back\x08\x7f\x07", r"back\u0008\u007f\u0007"),
        ("gnp.\u202egif", r"gnp.\u202egif"),
        ("\u2066isolated\u2069\u200f", r"\u2066isolated\u2069\u200f"),
        ("over\rwritten", r"over\u000dwritten"),
        ("a\u2028b\x85c", r"a\u2028b\u0085c"),
        ("Läufer “3” – 4,5° ✓ 步态 مشي 👩‍🔬\t.", "Läufer “3” – 4,5° ✓ 步态 مشي 👩‍🔬\t."),
    ],
)
def test_what_controls_a_terminal_is_escaped_and_letters_stay(text: str, shown: str) -> None:
    assert printable_text(text) == printable_line(text) == shown


def test_a_text_keeps_its_lines_and_a_line_stays_one() -> None:
    assert printable_text("a\nb\r\nc\rd") == "a\nb\r\nc\\u000dd"
    assert printable_line("a\nb\r\n") == r"a\u000ab\u000d\u000a"


@given(st.text())
def test_nothing_that_controls_a_terminal_is_left(text: str) -> None:
    for sign in printable_line(text):
        assert sign == "\t" or unicodedata.category(sign) not in ("Cc", "Zl", "Zp")
        assert unicodedata.bidirectional(sign) not in BIDIRECTIONAL


@given(st.dictionaries(st.text(), st.text()))
def test_json_stays_the_same_json(content: dict[str, str]) -> None:
    for text in (json.dumps(content), json.dumps(content, ensure_ascii=False, indent=1)):
        assert json.loads(printable_text(text)) == content
