"""What a campaign found, in words, with requests that can be sent again."""

from __future__ import annotations

import re
from collections import Counter
from pathlib import Path
from urllib.parse import urlsplit

from tests.support.fuzz.campaign import Memory, Outcome
from tests.support.fuzz.requests import Asked

SHOWN = 160
"""Characters of a body or an answer that are printed."""


def report(outcome: Outcome, seed: int, url: str, folder: Path) -> str:
    """Figures first, then every kind of failure; requests are kept in a folder as they were sent."""
    count = sum(outcome.statuses.values())
    classes = Counter(
        f"{status // 100}xx" if status else "no answer" for status in outcome.statuses.elements()
    )
    lines = [
        f"seed {seed}: {count} requests in {outcome.seconds:.0f} s; {dict(sorted(classes.items()))}",
        f"statuses: {dict(sorted(outcome.statuses.items()))}",
        "slowest:",
        *(
            f"  {seconds:6.2f} s  {status}  {asked.operation} ({asked.way}, {asked.number})"
            for seconds, asked, status in outcome.slowest
        ),
        "memory in MB (all, studio): " + curve(outcome.memory),
    ]
    for key, kept in sorted(outcome.failures.items()):
        answered = kept[0][1]
        lines.append(f"{outcome.counts[key]} × {key[1]}: {key[0]} ({answered.seconds:.1f} s)")
        lines += [f"    {_again(one, url, folder)}" for one, _ in kept]
        lines.append(f"    answer: {answered.body[:SHOWN]!r}")
    return "\n".join(lines)


def curve(memory: list[Memory], points: int = 12) -> str:
    """Some points of the memory over the requests."""
    step = max(1, len(memory) // points)
    return ", ".join(
        f"{one.requests}: {one.everything / 1e6:.0f} {one.studio / 1e6:.0f}" for one in memory[::step]
    )


def tracebacks(text: str) -> Counter[str]:
    """The last lines of the tracebacks in a log, and how often each is there."""
    found = re.findall(r"^Traceback .*\n(?:[ +|].*\n|\n)*(\S.*)$", text, re.MULTILINE)
    return Counter(line[:200] for line in found)


def _again(asked: Asked, url: str, folder: Path) -> str:
    """How to send a request again."""
    parts = urlsplit(url)
    file = folder / f"{asked.number}.http"
    file.write_bytes(asked.wire(parts.netloc))
    shown = f"{asked.method} {asked.target[:SHOWN]} {asked.body[:SHOWN]!r}"
    return f"{shown}; again: nc {parts.hostname} {parts.port} < {file}"
