"""JSON and TOML of people, whose numbers are plain decimals: no NaN, Infinity, 1e999, 1_000 or 0x10."""

import json
import re
import tomllib
from collections import Counter
from collections.abc import Iterator, Mapping
from datetime import date, time
from typing import Any

import numpy as np

from core.arrays import Bools, Floats
from core.errors import InputError
from core.text.decoding import place_in, text_of, without_mark
from core.text.numbers import MOST_DIGITS, number_fault, plain_number, shortened

MOST_DEPTH = 100
"""Objects, tables and lists within each other."""
MOST_TOML = 1_000_000
"""Characters of a TOML text."""
_SUSPECT = re.compile(r"NaN|Infinity|[eE]\+?[0-9]{3}|[0-9]{300}")
"""What every JSON text has whose numbers are not all finite doubles."""
_PIECE, _OVERLAP = 65_536, 300
"""A text is searched in pieces, between which other threads have their turn: no Stop waits for a long one."""
_JSON_WORD = re.compile(r'"(?:[^"\\]|\\.)*"|([-+.\w]+)', re.DOTALL)
_NUMBER_LIKE = re.compile(r"[-+]?\.?[0-9][\w.+-]*", re.ASCII)
_IN_NUMBERS = "+-.0123456789eE"
_JSON_NUMBER = re.compile(r"-?(?:0|[1-9][0-9]*)(?:\.[0-9]+)?(?:[eE][-+]?[0-9]+)?", re.ASCII)
_PLACE = re.compile(r"line ([0-9]+), column ([0-9]+)")
_KEY = re.compile(r'"((?:[^"\\]|\\.)*)"\s*:|(?m:^)[ \t]*([\w.-]+)[ \t]*=')
_TOML_WORD = re.compile(
    r'"""(?:[^\\]|\\.)*?"""|\'\'\'.*?\'\'\'|"(?:[^"\\\n]|\\.)*"|\'[^\'\n]*\'|#[^\n]*'
    r"|[-+.\w]+(?:[ \t]*=|[ \t]+\.)|([-+.:\w]+)|[\[\]]",
    re.DOTALL,
)
"""Strings, comments, keys and brackets; what is caught is a bare value, or a name in a table's head."""
_MOST_WAY = 2_000
"""Characters from a number back to its key, within which a message looks for it."""
_TOML_BETWEEN = re.compile(r"[\n,=\[\]{}#]")
"""Ends a key."""
_ONE_DOT = re.compile(r"(?<!\.)\.(?!\.)")
_TOML_NUMBER = re.compile(
    r"[+-]?(?:inf|nan|0[xob][0-9A-Fa-f_]+|[0-9][0-9_]*(?:\.[0-9_]+)?(?:[eE][+-]?[0-9_]+)?)", re.ASCII
)


class NotJsonError(InputError):
    """A text is no JSON at all."""


def json_content(source: str | bytes, name: str) -> Any:
    """Reads JSON.

    Args:
        source: the text, or the bytes of its file.
        name: of the file, for messages.

    Raises:
        NotJsonError: it is no JSON.
        InputError: it is no text in UTF-8, a number in it is not finite, or an object has a key twice.
    """
    text = without_mark(text_of(source, name) if isinstance(source, bytes) else source)
    try:
        if _is_suspect(text):
            json.loads(text, parse_int=len)  # only in JSON do the words below take a time like its length
            words = (match for match in _JSON_WORD.finditer(text) if _is_json_number(match[1]))
            _require_plain(words, name, text)
        content = json.loads(text, object_pairs_hook=_object)
        if text.count("[") + text.count("{") > MOST_DEPTH:
            _require_shallow(content)
        return content
    except _TwiceError as error:
        twice = str(error)
        raise InputError(
            f"{name} has the key “{shortened(twice)}” twice in one object. Keep one of them.", name
        ) from None
    except RecursionError as error:
        raise NotJsonError(f"{name} is not JSON that can be read: {_TOO_DEEP}", name) from error
    except json.JSONDecodeError as error:
        place = f"line {error.lineno} column {error.colno}"
        raise NotJsonError(
            f"{name} is not JSON: {error.msg}: {place}.{_json_slip(text, error)}", name
        ) from error


_TOO_DEEP = (
    f"it is nested too deeply. At most {MOST_DEPTH} lists, tables or objects may stand within each other."
)


def _require_shallow(content: Any) -> None:
    """Raises RecursionError, as parsers do, where content is nested too deeply."""
    level = [content]
    for _ in range(MOST_DEPTH + 1):
        parts = (part.values() if isinstance(part, dict) else part for part in level)
        level = [one for part in parts for one in part if isinstance(one, dict | list)]
        if not level:
            return
    raise RecursionError


def _is_suspect(text: str) -> bool:
    begins = range(0, len(text), _PIECE)
    return any(_SUSPECT.search(text, begin, begin + _PIECE + _OVERLAP) for begin in begins)


class _TwiceError(Exception):
    """An object has a key twice."""


def _object(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    content = dict(pairs)
    if len(content) < len(pairs):
        raise _TwiceError(Counter(key for key, _ in pairs).most_common(1)[0][0])
    return content


def _json_slip(text: str, error: json.JSONDecodeError) -> str:
    """What may have spoilt a text that is no JSON; empty where nothing can be said."""
    if not text[: error.pos].strip() and text.strip() and text.strip()[0] not in "+.0123456789-":
        return f" It begins “{shortened(text.strip())}”."
    # The parser stops within a number that it cannot read.
    before = text[max(error.pos - MOST_DIGITS, 0) : error.pos]
    word = _NUMBER_LIKE.match(text, error.pos - len(before) + len(before.rstrip(_IN_NUMBERS)))
    if word is not None and not _JSON_NUMBER.fullmatch(word[0]) and "_" not in word[0]:
        return f" “{shortened(word[0])}” is no number of JSON: write plain decimals such as 0.4."
    return _slip(text, error.lineno, error.colno)


def json_numbers(content: Mapping[str, Any], key: str) -> Floats:
    """The numbers of a key of JSON content as an array.

    Raises:
        ValueError: the key is missing, or has texts, such as numbers in quotes, or lists of other lengths.
    """
    if key not in content:
        raise ValueError(f"“{key}” is missing")
    try:
        array = np.array(content[key])
    except ValueError:
        raise ValueError(f"the lists of “{key}” differ in length") from None
    if array.size and array.dtype.kind not in "biuf":
        raise ValueError(f"“{key}” must have numbers and has other values, such as numbers in quotes")
    return array.astype(np.float64)


def json_truths(content: Mapping[str, Any], key: str) -> Bools:
    """The same for true and false, which may be written as 1 and 0.

    Raises:
        ValueError: as in `json_numbers`, or a value is another number.
    """
    numbers = json_numbers(content, key)
    for value in numbers[(numbers != 0) & (numbers != 1)][:1]:
        raise ValueError(f"“{key}” has {value:g}; it may have 0 and 1, or true and false")
    return numbers.astype(np.bool_)


def as_written(value: Any) -> str:
    """A value of JSON or TOML as a person wrote it."""
    if isinstance(value, date | time):
        return f"a date or time ({value.isoformat()})"
    try:
        return shortened(json.dumps(value, ensure_ascii=False, default=str))
    except (RecursionError, ValueError):  # lists within lists without end, or a number of thousands of digits
        return f"a {type(value).__name__} that is too long to be shown"


def toml_content(source: str | bytes, name: str) -> dict[str, Any]:
    """Reads TOML.

    Args:
        source: the text, or the bytes of its file.
        name: of the file, for messages.

    Raises:
        InputError: it is no text in UTF-8 or no TOML, is too long or nested too deeply, or a number in it is
            no plain decimal.
    """
    text = without_mark(text_of(source, name) if isinstance(source, bytes) else source)
    if len(text) > MOST_TOML:
        raise InputError(
            f"{name} has {len(text):,} characters; at most {MOST_TOML:,} of TOML are read. Write less.", name
        )
    if "\n" not in text:
        text = text.replace("\r", "\n")
    try:
        _require_short_keys(text)
        content = tomllib.loads(text)
        _require_shallow(content)
    except tomllib.TOMLDecodeError as error:
        place = _PLACE.search(str(error))
        if place is not None and (key := _given_twice(text, str(error), int(place[1]))):
            raise InputError(
                f"{name}, line {place[1]}: {key} is given twice. Keep one of them.", f"{name}:{place[1]}"
            ) from error
        slip = "" if place is None else _slip(text, int(place[1]), int(place[2]))
        hint = " It seems to be JSON." if text.lstrip().startswith("{") else slip
        raise InputError(f"{name} is no TOML file: {error}.{hint}", name) from error
    except RecursionError as error:
        raise InputError(f"{name} is no TOML file that can be read: {_TOO_DEEP}", name) from error
    except ValueError as error:
        _require_plain(_toml_numbers(text), name, text)
        raise InputError(f"{name} is no TOML file: {error}.", name) from error
    _require_plain(_toml_numbers(text), name, text)
    return content


def _require_short_keys(text: str) -> None:
    """Raises RecursionError for a key of too many parts, with which the parser would take hours."""
    for part in _TOML_BETWEEN.split(text):
        if part.count(".") > MOST_DEPTH and len(_ONE_DOT.findall(part)) > MOST_DEPTH:
            raise RecursionError


def _given_twice(text: str, fault: str, line: int) -> str:
    """What a TOML text has a second time by its parser's message; empty where that says something else."""
    if fault.startswith("Cannot overwrite"):
        key = re.match(r"[ \t]*([\w.\"'-]+)[ \t]*=", text.split("\n")[line - 1])
        return "the key here" if key is None else f"the key {shortened(key[1])}"
    return "the table here" if re.match(r"Cannot declare .* twice", fault) else ""


def _toml_numbers(text: str) -> Iterator[re.Match[str]]:
    """The numbers among the values of a TOML text."""
    depth, is_head = 0, False
    for match in _TOML_WORD.finditer(text):
        if match[0] == "[":
            if depth == 0:
                is_head = not text[text.rfind("\n", 0, match.start()) + 1 : match.start()].strip()
            depth += 1
        elif match[0] == "]":
            depth -= 1
        elif match[1] is not None and not (is_head and depth) and _TOML_NUMBER.fullmatch(match[1]):
            yield match


def _is_json_number(word: str | None) -> bool:
    return word is not None and (word.lstrip("-") in ("NaN", "Infinity") or word.lstrip("-")[:1].isdigit())


def _slip(text: str, line: int, column: int) -> str:
    """What may have spoilt the place that cannot be read; empty where it has nothing of the kind."""
    found = text.split("\n")[line - 1]
    if re.search(r"[0-9]_[0-9]", found):
        return " Write numbers without _."
    # The parser stops at the comma or in the digits behind it.
    is_comma = re.search(r"[0-9],[0-9]*\Z", found[:column], re.ASCII) and re.match(
        "[0-9,]", found[column - 1 :]
    )
    return " Write decimal points, not commas." if is_comma else ""


def _require_plain(words: Iterator[re.Match[str]], name: str, text: str) -> None:
    """Raises InputError for the first word that is no plain finite number."""
    for match in words:
        fault = _fault(match[1])
        if fault is not None:
            line, column = place_in(text, match.start(1))
            start = match.start(1)
            keys = ["".join(found) for found in _KEY.findall(text, max(start - _MOST_WAY, 0), start)]
            key = f" ({shortened(keys[-1])})" if keys else ""
            raise InputError(f"{name}, line {line}, column {column}{key}: {fault}.", f"{name}:{line}")


def _fault(word: str) -> str | None:
    try:
        plain_number(word)
    except ValueError as fault:
        return str(fault)
    return None if len(word) <= MOST_DIGITS else number_fault(word)
