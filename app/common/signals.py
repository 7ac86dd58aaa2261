"""The signals that end the program, for the command line and the server."""

import signal


class Interrupted(Exception):  # noqa: N818 - it is no error
    """SIGTERM or SIGHUP arrived; commands end as by Ctrl-C."""


def ending_signals() -> tuple[signal.Signals, ...]:
    """SIGTERM, and SIGHUP, which a closed terminal sends; without SIGHUP where `nohup` has it ignored."""
    hang_up = getattr(signal, "SIGHUP", None)
    if hang_up is None or signal.getsignal(hang_up) is signal.SIG_IGN:
        return (signal.SIGTERM,)
    return signal.SIGTERM, hang_up


def ignore_endings() -> None:
    """Lets a program that ends do what it has to without being broken off by another of these signals."""
    for number in (signal.SIGINT, *ending_signals()):
        signal.signal(number, signal.SIG_IGN)
