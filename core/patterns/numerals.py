"""Lists, ranges and numbers as sentences about patterns write them; counting from 1."""

from collections.abc import Sequence

_PLURALS = {"foot": "feet"}
_WORDS = (
    *("no", "one", "two", "three", "four", "five", "six"),
    *("seven", "eight", "nine", "ten", "eleven", "twelve"),
)


def plural(noun: str, count: int) -> str:
    """A noun for so many: "foot", "feet"."""
    return noun if count == 1 else _PLURALS.get(noun, f"{noun}s")


def counted(count: int, noun: str) -> str:
    """A number and its noun: "1 sample", "3 samples"."""
    return f"{count} {plural(noun, count)}"


def only(count: int, noun: str) -> str:
    """How few there are: "no foot is", "only one foot is", "only two feet are"."""
    word = _WORDS[count] if count < len(_WORDS) else str(count)
    if count == 0:
        return f"no {noun} is"
    return f"only {word} {plural(noun, count)} {'is' if count == 1 else 'are'}"


def times(count: int) -> str:
    """How often: "never", "once", "twice", "3 times"."""
    return {0: "never", 1: "once", 2: "twice"}.get(count, f"{count} times")


def listed(parts: Sequence[str], joint: str = " and ") -> str:
    """Parts in one sentence: "a", "a and b", "a, b and c"; the joint stands before the last one."""
    return joint.join(filter(None, (", ".join(parts[:-1]), parts[-1])))


def ranges(indices: Sequence[int]) -> str:
    """Indices as a person counts them, three or more in a row as a range: "1, 2 and 4–6"."""
    runs: list[list[int]] = []
    for index in sorted(indices):
        if runs and index == runs[-1][-1] + 1:
            runs[-1].append(index)
        else:
            runs.append([index])
    parts: list[str] = []
    for run in runs:
        parts += [f"{run[0] + 1}–{run[-1] + 1}"] if len(run) > 2 else [str(index + 1) for index in run]
    return listed(parts)


def named(noun: str, indices: Sequence[int]) -> str:
    """Things by their numbers: "limb 3", "limbs 1 and 4", "samples 4–6"."""
    return f"{plural(noun, len(indices))} {ranges(indices)}"
