"""Gaits by steps compared, as parts of a report: the table, and the trials of each over each other."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

from app.common.json import Json
from app.trials.report.page import NET_HEAD, moment, net_cells, number, plot, table, text
from app.trials.report.plots import band_from_above
from app.trials.service import compared
from core.errors import InputError

MOST_BANDS = 40
"""Gaits whose trials are drawn; the file would be too large to read."""

_KEY = "Each trial thin, their mean solid, the plan dotted; in the robot's frame, cm. Their ends lie apart by"


def compared_parts(
    lines: Sequence[Json],
    band_of: Callable[[Sequence[str]], Json],
    colours: Sequence[str],
) -> Iterator[str]:
    """The parts.

    Args:
        lines: of the list of trials.
        band_of: lays trials over each other.
        colours: a colour a foot.
    """
    by_id, groups = {line["id"]: line for line in lines}, compared(lines)
    yield _compared_table(groups)
    for index, group in enumerate(groups):
        yield f"<h2>{text(_group_name(group))}</h2>"
        if index < MOST_BANDS:
            yield _band(group["trials"], band_of, colours, f"band{index}")
        yield _trials_table([by_id[trial] for trial in group["trials"]])


def _band(
    trials: Sequence[str],
    band_of: Callable[[Sequence[str]], Json],
    colours: Sequence[str],
    name: str,
) -> str:
    try:
        feet = band_of(trials)["feet"]
    except InputError as error:  # of other feet, or too many: the table below still has them
        return f'<p class="quiet">{text(error.sentence)}</p>'
    apart = ", ".join(f"foot {index + 1} {foot['end_spread_cm']:.2f}" for index, foot in enumerate(feet))
    return plot(band_from_above(feet, colours), name, f"{_KEY} {apart} cm.")


def _group_name(group: Mapping[str, Any]) -> str:
    return f"{group['gait_name']}, {number(group['step_cm'], 1)} cm a step"


def _compared_table(groups: Sequence[Mapping[str, Any]]) -> str:
    def spread(group: Mapping[str, Any], key: str, decimals: int) -> str:
        by = group[f"{key}_spread"]
        return number(group[key], decimals) + ("" if by is None else f" ± {number(by, decimals)}")

    rows = [
        (
            text(_group_name(group)),
            [
                str(len(group["trials"])),
                number(group["expected_cm"], 2),
                spread(group, "net_distance", 2),
                spread(group, "net_angle_deg", 1),
                spread(group, "net_error_percent", 0),
                spread(group, "distance", 2),
                spread(group, "extent_distance", 2),
                spread(group, "speed_mm_s", 2),
                spread(group, "slip_cm", 2),
            ],
        )
        for group in groups
    ]
    head = ["", "trials", "wanted cm", *NET_HEAD, "as published cm", "extent cm", "mm/s", "slip cm"]
    return table(
        "Net movement, from first to last frame, angles on the platform; as published: by the largest "
        "excursions; ± is the standard deviation of the trials",
        head,
        rows,
    )


def _trials_table(lines: Sequence[Mapping[str, Any]]) -> str:
    rows = [
        (
            text(line["name"])
            + (f'<br><span class="quiet">{text(line["note"])}</span>' if line["note"] else ""),
            [
                line["by"] or "–",
                moment(line["made"]),
                *net_cells(line),
            ],
        )
        for line in lines
    ]
    return table("Net movement of the trials, angles on the platform", ["", "by", "added", *NET_HEAD], rows)
