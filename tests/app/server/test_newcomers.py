"""What a look at a request's head tells."""

from __future__ import annotations

import pytest

from app.server.newcomers import MOST_SHOWN, shows_one

TOKENS = frozenset({b"the-token-of-the-test"})
TOKEN = "the-token-of-the-test"
GUESSES = "".join(f"; footfall_token_{number}=word-{number}" for number in range(MOST_SHOWN))


@pytest.mark.parametrize(
    ("line", "is_shown"),
    [
        (f"GET /?token={TOKEN} HTTP/1.1", True),
        (f"GET /?x=1&token={TOKEN}&y=2 HTTP/1.1", True),
        (f"authorization: Bearer {TOKEN}", True),
        (f"Cookie: a=b; footfall_token_8401=other; footfall_token_8400={TOKEN}", True),
        (f"Cookie: a=b{GUESSES}; footfall_token_8400={TOKEN}", False),
        (f"X-Words: {TOKEN}", False),
        (f"authorization: Bearer {TOKEN}x", False),
        ("GET / HTTP/1.1", False),
    ],
)
def test_a_head_shows_the_token_where_it_belongs_and_not_among_guesses(line: str, is_shown: bool) -> None:
    assert shows_one(f"GET / HTTP/1.1\r\n{line}\r\n\r\n".encode(), TOKENS) is is_shown
