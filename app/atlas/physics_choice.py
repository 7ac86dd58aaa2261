"""Which solved gaits of an atlas are simulated: those of the front, all, or a sample."""

import hashlib
from dataclasses import dataclass

from app.atlas.atlas_file import AtlasFile
from app.atlas.front import atlas_front
from core.atlas.row import AtlasRow, RowStatus
from core.errors import InputError

FRONT, ALL = "front", "all"
MOST_SAMPLE = 10_000_000


@dataclass(frozen=True, eq=False)
class PhysicsChoice:
    """Gaits that are to be simulated.

    Args:
        rule: `front`, `all`, or how many gaits a sample has.
        rows: of the gaits, in the order in which they are simulated.
        solved: how many solved gaits the atlas has.
    """

    rule: str | int
    rows: list[AtlasRow]
    solved: int

    @property
    def notice(self) -> str | None:
        """A sentence where the sample is larger than the atlas; None where it is not."""
        if isinstance(self.rule, str) or self.rule <= self.solved:
            return None
        return (
            f"A sample of {self.rule:,} gaits is more than the {self.solved:,} solved gaits of the atlas, so "
            "all of them are simulated."
        )


def physics_rule(value: str | int, where: str) -> str | int:
    """Reads a rule.

    Args:
        value: `front`, `all`, or how many gaits a sample has, as a number or its digits.
        where: the option or argument, for sentences.

    Raises:
        InputError: it is none of them.
    """
    if value in (FRONT, ALL):
        return value
    is_number = isinstance(value, int) and not isinstance(value, bool)
    is_digits = isinstance(value, str) and value.isascii() and value.isdigit() and len(value) < 20
    if (is_number or is_digits) and 1 <= int(value) <= MOST_SAMPLE:
        return int(value)
    raise InputError(
        f"{where} is {value}; it must be {FRONT}, {ALL}, or the size of a sample from 1 to {MOST_SAMPLE:,}.",
        where,
    )


def physics_choice(atlas: AtlasFile, rule: str | int) -> PhysicsChoice:
    """The gaits that a rule names.

    A sample depends on the seed of the space and on the numbers of the solved gaits alone. A larger sample
    begins with a smaller one.

    Args:
        atlas: the file.
        rule: what `physics_rule` has read.
    """
    solved = list(atlas.rows(RowStatus.SOLVED))
    if rule == FRONT:
        return PhysicsChoice(rule, [row for row, _ in atlas_front(atlas)], len(solved))
    if isinstance(rule, int):
        seed = atlas.space.seed
        drawn = sorted(solved, key=lambda row: hashlib.sha256(f"{seed},{row.number}".encode()).digest())
        return PhysicsChoice(rule, drawn[:rule], len(solved))
    return PhysicsChoice(rule, solved, len(solved))
