"""Plain decimals are read to the last bit; everything else is refused with a clause that says why."""

import math
import struct
from collections.abc import Callable

import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.text.numbers import plain_number, plain_whole, reads_plainly

finite = st.floats(allow_nan=False, allow_infinity=False)


@given(finite, st.sampled_from(["{!r}", "{:.17g}", "{:+.17e}", "{:.17E}", " {!r}\t"]))
def test_every_printed_double_is_read_to_the_last_bit(value: float, form: str) -> None:
    assert struct.pack("d", plain_number(form.format(value))) == struct.pack("d", value)


@given(st.integers(-(10**30), 10**30))
def test_every_whole_number_is_read(value: int) -> None:
    assert plain_whole(str(value)) == value
    assert plain_number(str(value)) == float(value)


def read_by(read: Callable[[str], float], text: str) -> float | None:
    try:
        return read(text)
    except ValueError:
        return None


@given(st.text(alphabet="0123456789+-.eE_ \tnaif\x0b\x1c\u00a0１٣", max_size=8))
def test_a_text_is_a_number_here_only_where_python_reads_the_same_one(text: str) -> None:
    value = read_by(plain_number, text)
    if value is not None:
        assert value == float(text)
        assert text.isascii()
        assert "_" not in text
    elif reads_plainly(text):
        assert read_by(float, text) in (None, math.inf, -math.inf)


@pytest.mark.parametrize("text", ["1", "-1", "+1.", ".5", "1e-3", "1.5E+07", " 2 ", "\t2", "007", "-0.0"])
def test_plain_decimals_are_numbers(text: str) -> None:
    assert plain_number(text) == float(text)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("1_0.0", "“1_0.0” is not a number; write it without _"),
        ("１0", "“１0” is not a number; it has the character fullwidth digit one"),
        ("٣", "it has the character arabic-indic digit three"),
        ("\u00a01", "it has the character no-break space"),
        ("−1", "write the minus sign as -"),
        ("1,5", "write a decimal point, not a comma"),
        ("1'000", "write it without '"),
        ("0x10", "write it in decimal digits"),
        ("nan", "^nan is not a finite number"),
        ("-Infinity", "^-Infinity is not a finite number"),
        ("1e999", "^1e999 is not a finite number"),
        ("9" * 5000, "^9{40}… is not a finite number"),
        ("", "“” is not a number"),
        ("1 2", "“1 2” is not a number"),
        ("1\n", "is not a number"),
        ("\x0b1", "is not a number"),
        ("1d3", "is not a number"),
        ("--1", "is not a number"),
    ],
)
def test_everything_else_is_refused(text: str, words: str) -> None:
    with pytest.raises(ValueError, match=words):
        plain_number(text)


@pytest.mark.parametrize("text", ["1_0", "１", "1.0", "1e3", "", "nan", "\u00a01", "9" * 5000])
def test_what_is_no_whole_number_is_refused(text: str) -> None:
    with pytest.raises(ValueError, match="is not a whole number"):
        plain_whole(text)
