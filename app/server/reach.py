"""Who can reach the studio, in words for the person who starts it."""

import socket

from app.web.access import LOOPBACK_NAMES

EVERYWHERE = frozenset({"0.0.0.0", "::"})
"""Addresses that stand for all addresses of this computer."""


def who_can_reach(host: str, has_token: bool) -> str:
    """A sentence on who can open the studio.

    Args:
        host: the address that it listens on.
        has_token: whether it demands a token.
    """
    if host in LOOPBACK_NAMES:
        if has_token:
            return "Only programs on this computer can reach it, and only with the token in the address."
        return (
            "Only this computer can reach it, but everybody who has an account on it; "
            "on a shared computer start it with --token."
        )
    place = host
    if host in EVERYWHERE:
        own = network_address()
        place = "any address of this computer" + (f" (such as {own})" if own else "")
    return (
        f"Every computer that reaches {place} can open it with the token in the address. "
        "The connection is not encrypted: use it on a network that you trust."
    )


def network_address() -> str | None:
    """This computer's address on the network that leads out; None without a network."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        try:
            probe.connect(("192.0.2.1", 9))  # An address for documentation; nothing is sent.
            return str(probe.getsockname()[0])
        except OSError:
            return None
