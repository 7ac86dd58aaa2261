"""The values of a JSON text are counted without reading it, in whatever pieces it comes."""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.errors import InputError
from core.text.json_size import MOST_VALUES, JsonSize, require_few_values

JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.text(st.sampled_from('\\"a,[{é')),
    lambda inner: st.lists(inner) | st.dictionaries(st.text(st.sampled_from('\\",x')), inner),
)


def marks_of(content: Any) -> int:
    """Commas and opening brackets that the JSON of a content has outside its texts."""
    if not isinstance(content, list | dict):
        return 0
    inner = content.values() if isinstance(content, dict) else content
    return 1 + max(len(content) - 1, 0) + sum(map(marks_of, inner))


@given(JSON, st.integers(1, 9), st.booleans())
def test_texts_do_not_count_wherever_the_pieces_end(content: Any, step: int, is_ascii: bool) -> None:
    text, size = json.dumps(content, ensure_ascii=is_ascii).encode(), JsonSize()
    for begin in range(0, len(text), step):
        size.add(text[begin : begin + step])
    assert size.values == marks_of(content)


MANY = MOST_VALUES + 1


@pytest.mark.parametrize(
    "make",
    [
        lambda: b"[" + b"0," * MANY + b"0]",
        lambda: b"[" * MANY,
        lambda: b'{"a":{' * MANY,
        lambda: b'"",' * MANY,
        lambda: "0,".encode("utf-16-le") * MANY,
        lambda: '"\\"",'.encode("utf-16-le") + "0,".encode("utf-16-le") * MANY,
        lambda: ("0," * MANY).join(["[", "\ud800]"]),
    ],
    ids=["numbers", "brackets", "objects", "texts", "UTF-16", "UTF-16 with a text", "half a character"],
)
def test_too_many_values_are_refused_by_name(make: Callable[[], str | bytes]) -> None:
    with pytest.raises(InputError, match=r"gait\.json has more than 500,000 values\. Send less"):
        require_few_values(make(), "gait.json")


def test_a_long_text_is_one_value() -> None:
    require_few_values(json.dumps({"csv": '1,2,"3",[{\n' * 1_000_000}), "track.json")
