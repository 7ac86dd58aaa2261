"""Names that people give themselves and their gaits."""

import unicodedata

_BLANK = frozenset("\u115f\u1160\u2800\u3164\uffa0")
"""Letters and symbols of Unicode that are drawn as nothing."""


def is_visible(name: str) -> bool:
    """Whether a name shows anything: a letter, a digit or a sign, not only spaces and control characters."""
    return any(unicodedata.category(sign)[0] in "LNPS" and sign not in _BLANK for sign in name)
