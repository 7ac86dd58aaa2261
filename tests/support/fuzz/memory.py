"""Memory of a process and of all that it has started."""

from __future__ import annotations

from pathlib import Path


def resident_bytes(process: int) -> dict[int, int]:
    """Resident bytes of a process and its descendants, by their numbers (Linux).

    Args:
        process: its number.
    """
    children: dict[int, list[int]] = {}
    sizes: dict[int, int] = {}
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            fields = (folder / "stat").read_text().rpartition(")")[2].split()
        except OSError:
            continue  # it has ended
        number = int(folder.name)
        children.setdefault(int(fields[1]), []).append(number)
        sizes[number] = int(fields[21]) * 4096
    found, left = {}, [process]
    while left:
        number = left.pop()
        found[number] = sizes.get(number, 0)
        left += children.get(number, [])
    return found
