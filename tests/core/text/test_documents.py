"""JSON and TOML of plain numbers are read as their parsers read them; others name line and column."""

import json
import tomllib
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.errors import InputError
from core.text.documents import NotJsonError, json_content, toml_content

content = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats(allow_nan=False, allow_infinity=False) | st.text(),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text(max_size=8), inner, max_size=4),
    max_leaves=12,
)


@given(content, st.booleans())
def test_json_that_we_write_is_read_as_it_was(value: Any, is_indented: bool) -> None:
    text = json.dumps(value, indent=2 if is_indented else None)
    assert json_content(text, "mine.json") == value
    assert json_content(("\ufeff" + text).encode(), "mine.json") == value


@pytest.mark.parametrize(
    "text",
    [
        '{"note": "NaN, Infinity, 1e999"}',
        '["1e999 \\" 1e999"]',
        f'["{"9" * 400}"]',
        "[1e300]",
        '{"1e999": 1}',
    ],
)
def test_words_in_strings_are_no_numbers(text: str) -> None:
    assert json_content(text, "mine.json") == json.loads(text)


@pytest.mark.parametrize(
    ("number", "words"),
    [
        ("NaN", "NaN is not a finite number"),
        ("Infinity", "Infinity is not a finite number"),
        ("-Infinity", "-Infinity is not a finite number"),
        ("1e999", "1e999 is not a finite number"),
        ("-1E+0400", r"-1E\+0400 is not a finite number"),
        ("9" * 400, "9{40}… is not a finite number"),
        ("9" * 5000, "9{40}… is not a finite number"),
    ],
)
def test_a_json_number_that_is_not_finite_is_refused_by_place(number: str, words: str) -> None:
    with pytest.raises(InputError, match=rf"mine\.json, line 2, column 11 \(time\): {words}") as refusal:
        json_content(f'{{"a": "NaN",\n "time":  {number}}}', "mine.json")
    assert refusal.value.where == "mine.json:2"


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ('{"a": 1_0}', r"is not JSON: .*line 1 column 8.*Write numbers without _"),
        ('{"a": 0,4, "b": 1}', "Write decimal points, not commas"),
        ("a,b\n1,2\n", "It begins “a,b"),
        ("[" * 100_000, "nested too deeply"),
        ('{"a":' * 200_000, "nested too deeply"),
        ("[" * 102 + "]" * 102, "At most 100 lists, tables or objects"),
        ('["a' + '\\"' * 50_000 + " NaN", "Unterminated string"),
        ("", "Expecting value"),
    ],
)
def test_what_is_no_json_says_what_was_found(text: str, words: str) -> None:
    with pytest.raises(NotJsonError, match=words):
        json_content(text, "mine.json")


@pytest.mark.parametrize("number", ["+0.4", ".4", "-.4", "0.", "00.4", "0x1", "0.4.1", "1e"])
@pytest.mark.parametrize("text", ['{{"a": [1, 2],\n "t": {}, "b": 1}}', "[{}]", "{}"])
def test_what_is_no_number_of_json_is_quoted_with_the_way_out(number: str, text: str) -> None:
    with pytest.raises(NotJsonError) as refusal:
        json_content(text.format(number), "mine.json")
    words = f"“{number}” is no number of JSON: write plain decimals such as 0.4."
    assert str(refusal.value).endswith(words)
    assert "(char" not in str(refusal.value)


@pytest.mark.parametrize("text", ['{"t": 0.4, "t": 0.8}', '[{"a": {"b": 1, "t": 0, "t": 0}}]'])
def test_a_json_key_that_is_given_twice_is_named(text: str) -> None:
    with pytest.raises(InputError, match=r"mine\.json has the key “t” twice in one object"):
        json_content(text, "mine.json")


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("seed = 1\nseed = [1,2]\n", "mine.toml, line 2: the key seed is given twice. Keep one of them."),
        ("a.b = 1\na.b = 2,5\n", "mine.toml, line 2: the key a.b is given twice. Keep one of them."),
        ("[a]\nx = 1\n[a]\n", "mine.toml, line 3: the table here is given twice. Keep one of them."),
        ("a = [1,2] x\n", "(at line 1, column 11)."),
        ("a = 0,4\n", "(at line 1, column 6). Write decimal points, not commas."),
    ],
)
def test_what_toml_has_twice_is_named_and_commas_only_where_they_are(text: str, words: str) -> None:
    with pytest.raises(InputError) as refusal:
        toml_content(text, "mine.toml")
    assert str(refusal.value).endswith(words)


TOML = """# 1_0, nan and 0x10 in a comment
title = "1_0 # nan"
multi = \"\"\"
inf = 1_0
\"\"\"
1_0 = 3
[vary.1_0]
plain = [-1.5, +2, 3e-4, [0.1, 7]]
when = 1979-05-27
yes = true
literal = '1_0'
"""


HEADS = """[inf] # nan
[ 0x10 . "a]" ]
inf . nan = {1_0 = 3, 0b1 = [ 4 ]}
[[1_0]]
rows = [
  [1, 2], # 1_0
  ["[", 3]
]
[[1_0]]
"""


@pytest.mark.parametrize("edit", [str, lambda t: "\ufeff" + t, lambda t: t.replace("\n", "\r\n")])
def test_plain_toml_is_read_as_its_parser_reads_it(edit: Any) -> None:
    for text in (TOML, HEADS):
        assert toml_content(edit(text).encode(), "mine.toml") == tomllib.loads(text)


def test_toml_with_carriage_returns_as_ends_of_lines_is_read() -> None:
    assert toml_content("a = 1\rb = 2\r", "mine.toml") == {"a": 1, "b": 2}


@pytest.mark.parametrize(
    ("number", "words"),
    [
        ("1_000", "“1_000” is not a number; write it without _"),
        ("1_0.0", "“1_0.0” is not a number; write it without _"),
        ("inf", "inf is not a finite number"),
        ("-nan", "-nan is not a finite number"),
        ("0x10", "“0x10” is not a number; write it in decimal digits"),
        ("0b1", "“0b1” is not a number"),
        ("1e999", "1e999 is not a finite number"),
        ("9" * 5000, "9{40}… is not a finite number"),
    ],
)
def test_a_toml_number_that_is_not_plain_is_refused_by_place(number: str, words: str) -> None:
    with pytest.raises(InputError, match=rf"mine\.toml, line 13, column 3 \(more\): {words}"):
        toml_content(f"{TOML}more = [\n  {number}, 1,\n]\n", "mine.toml")


@pytest.mark.parametrize("number", ["1_0.0", "nan", "inf", "0x10", "1e999"])
@pytest.mark.parametrize(
    "rows",
    [
        "[\n [NUMBER, 2.0]\n]",
        "[\n [NUMBER]\n]",
        "[\n  [NUMBER, 2] # last\n]",
        "[ # rows\n[[1], [NUMBER]]]",
        "[\n{a = [\n[NUMBER]\n]}\n]",
    ],
)
def test_a_row_of_an_array_is_not_taken_for_the_head_of_a_table(rows: str, number: str) -> None:
    with pytest.raises(InputError, match=rf"mine\.toml, line 1[3-5], column .*{number} ?”? is not a"):
        toml_content(f"{TOML}more = {rows.replace('NUMBER', number)}\n", "mine.toml")


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("a = [0.01, 0,02]", "Write decimal points, not commas"),
        ("a = ", "is no TOML file"),
        ('{"a": 1}', "It seems to be JSON"),
        ("a,b\n1,2\n", "is no TOML file"),
        ("a = " + "[" * 100_000, "is no TOML file"),
    ],
)
def test_what_is_no_toml_is_refused(text: str, words: str) -> None:
    with pytest.raises(InputError, match=words):
        toml_content(text, "mine.toml")


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("a = " + "[" * 5000 + "]" * 5000, "nested too deeply"),
        ("a = " + "{b = " * 5000 + "1" + "}" * 5000, "nested too deeply"),
        ("a = " + "[" * 101 + "]" * 101, "At most 100 lists, tables or objects"),
        ("a." * 100_000 + "b = 1", "nested too deeply"),
        ("[" + "a." * 100_000 + "b]\nc = 1", "nested too deeply"),
        ("a." * 101 + "b = 1", "nested too deeply"),
        ("a = [" + "1," * 1_000_000 + "]", "at most 1,000,000 of TOML"),
        ("#" + '"\\' * 50_000 + "\na = nan", "nan is not a finite number"),
    ],
    ids=range(8),
)
def test_toml_that_is_too_deep_or_too_long_is_refused_at_once(text: str, words: str) -> None:
    with pytest.raises(InputError, match=words):
        toml_content(text, "mine.toml")


def test_toml_and_json_of_some_depth_are_read() -> None:
    assert toml_content("a = " + "[" * 90 + "]" * 90, "mine.toml")
    assert toml_content("# " + "." * 200 + "\na" + ".a" * 90 + " = 1", "mine.toml")
    assert json_content('{"a":' * 90 + "1" + "}" * 90, "mine.json")
