"""The one grammar of numbers in files and arguments of people: plain ASCII decimals.

A number has digits, and may have a sign, a decimal point and an exponent; blanks may stand around it. Python
alone reads `1_000`, digits of other scripts, `nan` and `inf` as numbers too.
"""

import math
import re
import unicodedata

MOST_QUOTED = 40
"""Characters of a file that a message repeats."""
MOST_DIGITS = 400
"""Characters of the longest whole number that is read."""
_PLAIN = re.compile(r"[ \t]*[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?[ \t]*")
_WHOLE = re.compile(r"[ \t]*[+-]?[0-9]+[ \t]*")
_NOT_FINITE = re.compile(r"[+-]?(?:nan|inf|infinity)", re.ASCII | re.IGNORECASE)
_DASHES = frozenset("\u2010\u2011\u2012\u2013\u2014\u2212\ufe63\uff0d")
_OTHER_THAN_NUMBERS = "_nN\x0b\x0c\x1c\x1d\x1e\x1f"
"""ASCII characters with which `float` reads what is no plain number."""


def plain_number(text: str) -> float:
    """Reads a number.

    Raises:
        ValueError: it is no plain finite number; its text is a clause that says why.
    """
    if _PLAIN.fullmatch(text):
        value = float(text)
        if math.isfinite(value):
            return value
    raise ValueError(number_fault(text))


def plain_whole(text: str) -> int:
    """Reads a whole number.

    Raises:
        ValueError: it is none; its text is a clause that says why.
    """
    if len(text) <= MOST_DIGITS and _WHOLE.fullmatch(text):
        return int(text)
    raise ValueError(f"“{shortened(text)}” is not a whole number{_hint(text)}")


def number_fault(text: str) -> str:
    """Why a text is no plain finite number, as a clause."""
    stripped = text.strip(" \t")
    if _NOT_FINITE.fullmatch(stripped) or _PLAIN.fullmatch(stripped):
        return f"{shortened(stripped)} is not a finite number"
    return f"“{shortened(text)}” is not a number{_hint(text)}"


def reads_plainly(text: str) -> bool:
    """Whether `float` reads each part of a text only where that is a plain number, if also 1e999."""
    return text.isascii() and not any(sign in text for sign in _OTHER_THAN_NUMBERS)


def shortened(text: str) -> str:
    """A text as a message repeats it: not longer than a line."""
    return text if len(text) <= MOST_QUOTED else f"{text[:MOST_QUOTED]}…"


def _hint(text: str) -> str:
    """What to write instead; empty where nothing can be said."""
    foreign = next((sign for sign in text if not sign.isascii()), None)
    if foreign in _DASHES:
        return "; write the minus sign as -"
    if foreign is not None:
        name = unicodedata.name(foreign, f"U+{ord(foreign):04X}").lower()
        return f"; it has the character {name}, write only 0 to 9, sign, point and exponent"
    if "_" in text and _PLAIN.fullmatch(text.replace("_", "")):
        return "; write it without _"
    if "," in text and _PLAIN.fullmatch(text.replace(",", ".", 1)):
        return "; write a decimal point, not a comma"
    if text.lstrip("+-")[:2].lower() in ("0x", "0o", "0b"):
        return "; write it in decimal digits"
    if "'" in text and _PLAIN.fullmatch(text.replace("'", "")):
        return "; write it without '"
    return ""
