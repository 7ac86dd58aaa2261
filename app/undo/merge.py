"""Taking one edit of a document back, or doing it again, while everybody else's edits stay.

A three-way merge of JSON content: what lies between `base` and `want` is one edit; it is carried over to the
present content wherever that still says what `base` says. Rows of timelines and locks are merged by cell;
they must still say what `base` says all along the span of an edit: half a moved swing is no swing.
"""

from dataclasses import dataclass
from itertools import groupby
from typing import Any, Final

from app.common.json import Json
from core.gait.gait_difference import OPTION_WORDS
from core.library.sequence import DERIVED

Path = tuple[str | int, ...]
"""Keys and indices from the root of a document to a value in it."""

MISSING: Final = object()
"""Stands for a key that is not there."""

_CELLS = (("timeline", "feet"), ("timeline", "locked"))
"""Where a string holds a cell a character."""

_WHOLE: tuple[Path, ...] = (("order",), ("held", "start"), ("held", "end"), ("poses", "pinned"))
"""Lists that make sense as a whole only."""

RESULT: Final = ("provenance",)
"""Which result a document has; an edit that brought one is undone where no other has come since."""

_BESIDE: tuple[Path, ...] = (RESULT, ("poses", "found"))
"""Results in a document; others that came since are in no undo's way."""

MOST_PLACES = 3
"""Places that a sentence names."""


@dataclass(frozen=True)
class Merge:
    """What became of a merge.

    Args:
        content: the merged document; where there is a conflict, the present value stays.
        changed: places at which it differs from the present document.
        conflicts: places that no longer say what the change starts from, nor what it leads to; of rows, cells
            in the span of the change that no longer say what it starts from.
        spans: cells of rows from the first that the change alters to the last, and one on either side.
    """

    content: Any
    changed: tuple[Path, ...]
    conflicts: tuple[Path, ...]
    spans: tuple[Path, ...] = ()


def merge(base: Any, want: Any, present: Any) -> Merge:
    """Carries the change from `base` to `want` over to `present`.

    Args:
        base: what the change starts from.
        want: what it leads to.
        present: the document as it is now.
    """
    derived = _derived_of(base, want, present)
    merging = _Merging(derived)
    content = merging.merged(base, want, present, ())
    spans = () if derived else _spans(base, want)
    return Merge(content, tuple(merging.changed), tuple(merging.conflicts), spans)


def _spans(base: Any, want: Any) -> tuple[Path, ...]:
    found: list[Path] = []
    for layer in _CELLS:
        rows = [value_at(content, layer) for content in (base, want)]
        if all(isinstance(feet, list) for feet in rows):
            pairs = enumerate(zip(*rows, strict=False))
            found += [(*layer, foot, at) for foot, (old, new) in pairs for at in _span(old, new)]
    return tuple(found)


def _span(old: str, new: str) -> range:
    """The cells that a change of a row lies across; none where it is another length altogether."""
    altered = [at for at, (one, other) in enumerate(zip(old, new, strict=False)) if one != other]
    if not altered or len(old) != len(new):
        return range(0)
    return range(max(altered[0] - 1, 0), min(altered[-1] + 2, len(old)))


def _derived_of(*contents: Any) -> tuple[Path, ...]:
    """What follows from the parts of a sequence, and is made anew once those are merged."""
    is_sequence = all(isinstance(content, dict) and content.get("sequence") for content in contents)
    return tuple((field,) for field in DERIVED) if is_sequence else ()


class _Merging:
    """One walk through three documents at once, down to the places where they can be told apart."""

    def __init__(self, derived: tuple[Path, ...]) -> None:
        self.left = (*_BESIDE, *derived)
        self.changed: list[Path] = []
        self.conflicts: list[Path] = []

    def merged(self, base: Any, want: Any, present: Any, path: Path) -> Any:
        if path == RESULT and base != want and present == base:
            return want
        if base == want or present == want or path in self.left:
            return present
        values = (base, want, present)
        if all(isinstance(value, dict) for value in values) and not _is_replaced(path, base, want):
            return self._keys(base, want, present, path)
        if path not in _WHOLE and _alike(list, values):
            parts = zip(*values, strict=True)
            return [self.merged(*three, (*path, at)) for at, three in enumerate(parts)]
        if len(path) == 3 and path[:2] in _CELLS and _alike(str, values):
            return self._row(base, want, present, path)
        if present != base:
            self.conflicts.append(path)
            return present
        self.changed.append(path)
        return want

    def _row(self, base: str, want: str, present: str, path: Path) -> str:
        torn = [at for at in _span(base, want) if present[at] != base[at]]
        if torn:
            self.conflicts += [(*path, at) for at in torn]
            return present
        cells = zip(base, want, present, strict=True)
        return "".join(self.merged(*three, (*path, at)) for at, three in enumerate(cells))

    def _keys(self, base: Json, want: Json, present: Json, path: Path) -> Json:
        merged: Json = {}
        for key in [*present, *(key for key in want if key not in present)]:
            old, new, now = (content.get(key, MISSING) for content in (base, want, present))
            value = self.merged(old, new, now, (*path, key))
            if value is not MISSING:
                merged[key] = value
        return merged


def _is_replaced(path: Path, base: Json, want: Json) -> bool:
    """Whether another gait takes a place in a sequence, as where two parts change places."""
    if len(path) != 2 or path[0] != "sequence":
        return False
    old, new = ((part.get("source"), part.get("gait", {}).get("name")) for part in (base, want))
    return old != new


def _alike(kind: type[list[Any]] | type[str], values: tuple[Any, Any, Any]) -> bool:
    """Whether three values are of a kind and equally long."""
    return all(isinstance(value, kind) for value in values) and len({len(value) for value in values}) == 1


def say_the_same(one: Json, other: Json) -> bool:
    """Whether two documents agree in all that is edited."""
    return bool(_edited(one, ()) == _edited(other, ()))


def _edited(content: Any, path: Path) -> Any:
    """A value without what stands in it without being edited."""
    if not isinstance(content, dict):
        return content
    return {
        key: _edited(value, (*path, key)) for key, value in content.items() if (*path, key) not in _BESIDE
    }


def value_at(content: Any, path: Path) -> Any:
    """The value at a place of a document; MISSING where there is none."""
    for key in path:
        try:
            content = content[key]
        except (KeyError, IndexError, TypeError):
            return MISSING
    return content


def place_words(paths: tuple[Path, ...]) -> str:
    """Places as a person calls them: "foot 3, samples 9–11 and the clearance"."""
    words = list(dict.fromkeys(word for key, run in groupby(paths, _row) for word in _words(key, list(run))))
    if len(words) > MOST_PLACES:
        words = [*words[: MOST_PLACES - 1], f"{len(words) - MOST_PLACES + 1} more places"]
    return " and ".join(filter(None, (", ".join(words[:-1]), words[-1])))


def _row(path: Path) -> Path:
    return path[:3] if path[:2] in _CELLS else path


def _words(row: Path, paths: list[Path]) -> list[str]:
    match row:
        case ("timeline", "feet" | "locked" as layer, int(foot)):
            what = f"foot {foot + 1}" if layer == "feet" else f"the locks of foot {foot + 1}"
            samples = [path[3] for path in paths if len(path) > 3 and isinstance(path[3], int)]
            return [f"{what}, {_samples(samples)}"] if samples else [f"the timeline of foot {foot + 1}"]
        case ("segment_table", "feet", int(foot), int(segment)):
            return [f"segment {segment + 1} of foot {foot + 1}"]
        case ("segment_table", *_):
            return ["the segment table"]
        case ("held", "start" | "end" as end):
            return [f"the feet held at the {end}"]
        case ("poses", "pinned"):
            return ["the pinned poses"]
        case ("held",):
            return ["the held feet"]
        case ("step", int(axis)):
            return ["the turn" if axis == 2 else "the step"]
        case ("options", str(option)) if option in OPTION_WORDS:
            return [f"the {OPTION_WORDS[option][0].lower()}"]
        case _:
            return ["the " + str(row[-1] if row else "document").replace("_", " ")]


def _samples(samples: list[int]) -> str:
    first, last = min(samples) + 1, max(samples) + 1
    return f"sample {first}" if first == last else f"samples {first}–{last}"
