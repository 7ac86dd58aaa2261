"""The one exception tree: every refusal names what happened, the limit and the remedy."""

MOST_LETTERS = 4000
"""Characters of a sentence; what it repeats of a file may have millions."""


class FootfallError(Exception):
    """An expected refusal with a sentence for the user.

    Args:
        sentence: what happened, the number with its unit, the limit, and what to do.
        where: the file, line, field, foot or sample that it is about.
    """

    def __init__(self, sentence: str, where: str | None = None) -> None:
        self.sentence = _readable(sentence)
        self.where = None if where is None else _readable(where)
        super().__init__(self.sentence)


class InputError(FootfallError):
    """Bad usage or bad input: a file, a field or an option that cannot be used."""


class DamagedRowError(InputError):
    """An entry of the database that cannot be read; all others can."""


class NotFoundError(InputError):
    """What an id or a name asks for does not exist."""


class InfeasibleError(FootfallError):
    """The robot cannot do what was asked."""


class CheckError(FootfallError):
    """A check failed: the plan is not fit to send, or a result was not confirmed."""


class RobotError(FootfallError):
    """The robot or its cable did not do what was expected."""


class StateError(FootfallError):
    """The request does not fit the present state (not approved, not armed, already running)."""


class SimulationCancelledError(StateError):
    """A simulation was ended by whoever asked for it."""


class StorageError(FootfallError):
    """The disk or the database does not do what it should; nothing is half-stored."""


class StorageFullError(StorageError):
    """There is no room for what is to be stored."""


class StorageDamagedError(StorageError):
    """What was stored cannot be read any more."""


def _readable(text: str) -> str:
    """A text without its middle where it is longer than anybody reads; the remedy stands at its end."""
    half = MOST_LETTERS // 2
    return text if len(text) <= MOST_LETTERS else f"{text[:half]} … {text[-half:]}"
