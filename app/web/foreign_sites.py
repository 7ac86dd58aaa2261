"""Whether a browser sends a request for a page of somebody else (Fetch Metadata, `Sec-Fetch-Site`)."""

from collections.abc import Mapping

PAGES = frozenset({"/", "/docs"})
"""What links on other sites may open."""

OWN = frozenset({"same-origin", "none"})
"""Asked for by the studio's own page, or by a person who typed the address."""


def is_foreign(method: str, path: str, headers: Mapping[str, str]) -> bool:
    """Whether another site's page asks, also one on another port of the same computer, and not for a page.

    Programs and older browsers don't send the header; Host, Origin and token hold for them too.

    Args:
        method: of the HTTP request; of a web socket anything but GET.
        path: of the request.
        headers: by their names in small letters.
    """
    site = headers.get("sec-fetch-site")
    if site is None or site in OWN:
        return False
    is_opened = headers.get("sec-fetch-mode") == "navigate" and headers.get("sec-fetch-dest") == "document"
    return not (is_opened and method == "GET" and path in PAGES)


def is_followed_link(headers: Mapping[str, str]) -> bool:
    """Whether a person followed a link on another site."""
    return headers.get("sec-fetch-site", "none") not in OWN
