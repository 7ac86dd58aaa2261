"""Bytes become text where they are UTF-8; everything else is named, with the way out."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.errors import InputError
from core.text.decoding import text_of

TEXT = "a,b\n1,2\n"


@given(st.text(alphabet=st.characters(exclude_characters="\0", exclude_categories=["Cs"])))
def test_text_in_utf_8_stays_as_it_is(text: str) -> None:
    assert text_of(text.encode(), "mine.csv") == text


@pytest.mark.parametrize("text", [TEXT, "\ufeff" + TEXT, TEXT.replace("\n", "\r\n"), "", "Länge\n"])
def test_marks_and_line_ends_stay(text: str) -> None:
    assert text_of(text.encode(), "mine.csv") == text


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (TEXT.encode("utf-16"), r"it is text in UTF-16\. Save it as UTF-8"),
        (TEXT.encode("utf-16-be"), r"it is text in UTF-16\. Save"),
        (TEXT.encode("utf-16-le"), r"it is text in UTF-16\. Save"),
        (TEXT.encode("utf-32"), r"it is text in UTF-32\. Save"),
        (b"a\nL\xe4nge\n", r"line 2, column 2 has the byte 0xE4 \(“ä” in Latin-1 or Windows-1252\)\. Save"),
        (b"a\n\x80", r"line 2, column 1 has the byte 0x80\. Save"),
        (b"1,2\n3,\x004\n", "line 2 has a zero byte"),
        (b"PK\x03\x04\x14\0", r"it is a spreadsheet or a ZIP file\. Save the table as CSV"),
        (b"\x1f\x8b\x08\0", "it is compressed by gzip"),
    ],
)
def test_what_is_no_text_in_utf_8_is_named(content: bytes, words: str) -> None:
    with pytest.raises(InputError, match=f"mine.csv is not text in UTF-8: {words}"):
        text_of(content, "mine.csv")


def test_a_file_that_is_too_large_is_refused() -> None:
    with pytest.raises(InputError, match=r"mine\.csv has 0\.0 MB; at most 1e-05 MB are read"):
        text_of(b"1" * 11, "mine.csv", most=10)
