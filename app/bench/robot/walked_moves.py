"""What a robot does in each message of a walk, as values and as JSON."""

from dataclasses import asdict, dataclass

from app.common.json import Json

DECIMALS = 4
"""Of a second in JSON."""


@dataclass(frozen=True)
class Move:
    """One message.

    Args:
        seconds: from its sending to its end line.
        ramps: when each ramp of its motors begins and ends, s from its sending; empty where none moves.
        feet: that are in the air before or after it, counted from 1.
        body: how far it takes the body, mm.
    """

    seconds: float
    ramps: tuple[tuple[float, float], ...]
    feet: tuple[int, ...]
    body: float

    @property
    def ramp_seconds(self) -> float:
        """Time in which motors move, s."""
        return sum(end - begin for begin, end in self.ramps)


@dataclass(frozen=True)
class WalkedMoves:
    """The messages of one cycle of a walk.

    Args:
        name: of the walk, for a person.
        way: how far the cycle goes, mm.
        moves: its messages.
    """

    name: str
    way: float
    moves: tuple[Move, ...]

    @property
    def seconds(self) -> float:
        """Of all messages, s."""
        return sum(move.seconds for move in self.moves)

    @property
    def ramp_seconds(self) -> float:
        """Time in which motors move, s."""
        return sum(move.ramp_seconds for move in self.moves)

    def with_ramps(self, count: int) -> int:
        """How many messages have so many ramps."""
        return sum(len(move.ramps) == count for move in self.moves)


def walks_content(walks: tuple[WalkedMoves, ...]) -> Json:
    """Walks as JSON content; seconds and mm."""
    return {"walks": [asdict(walk) for walk in walks]}


def walks_of(content: Json) -> tuple[WalkedMoves, ...]:
    """Walks of JSON content (see `walks_content`)."""
    return tuple(
        WalkedMoves(walk["name"], walk["way"], tuple(_move_of(move) for move in walk["moves"]))
        for walk in content["walks"]
    )


def _move_of(content: Json) -> Move:
    ramps = tuple((begin, end) for begin, end in content["ramps"])
    return Move(content["seconds"], ramps, tuple(content["feet"]), content["body"])
