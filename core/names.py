"""Names that people give themselves and their gaits, and other words of theirs that are kept."""

import unicodedata

from core.errors import InputError

_BLANK = frozenset("\u115f\u1160\u2800\u3164\uffa0")
"""Letters and symbols of Unicode that are drawn as nothing."""


def is_visible(name: str) -> bool:
    """Whether a name shows anything: a letter, a digit or a sign, not only spaces and control characters."""
    return any(unicodedata.category(sign)[0] in "LNPS" and sign not in _BLANK for sign in name)


def require_kept(text: str, what: str, where: str) -> None:
    """A person's words can be kept and shown: no half characters, no control characters but line breaks.

    Args:
        text: the words.
        what: what they are, as the beginning of a sentence.
        where: the field that they came in.

    Raises:
        InputError: they cannot.
    """
    bad = next(
        (one for one in text if unicodedata.category(one) in ("Cc", "Cs") and one not in "\n\r\t"), None
    )
    if bad is not None:
        raise InputError(
            f"{what} has the character U+{ord(bad):04X}, which cannot be kept; leave it out.", where
        )
