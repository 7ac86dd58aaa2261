"""Tables of trials for other programs: CSV and LaTeX."""

import csv
import io
from collections.abc import Mapping, Sequence
from typing import Any

from app.common.table_cell import table_cell

COLUMNS = {
    "gait_name": "Gait",
    "step_cm": "Step (cm)",
    "count": "Trials",
    "expected_cm": "Wanted (cm)",
    "net_distance": "Net distance (cm)",
    "net_distance_spread": "± (cm)",
    "net_angle_deg": "Net angle (deg)",
    "net_error_percent": "Net error (%)",
    "distance": "Distance as published (cm)",
    "angle_deg": "Angle as published (deg)",
    "error_percent": "Error as published (%)",
    "extent_distance": "Extent distance (cm)",
    "speed_mm_s": "Speed (mm/s)",
    "slip_cm": "Largest slip (cm)",
}
"""Columns of the table of gaits, in order: net figures from first to last frame, then those of the published
tables (largest excursions in thesis chapter 5, extents in its Tables A.1 to A.4)."""

_LATEX = {
    "\\": r"\textbackslash{}",
    "&": r"\&",
    "%": r"\%",
    "$": r"\$",
    "#": r"\#",
    "_": r"\_",
    "{": r"\{",
    "}": r"\}",
    "~": r"\textasciitilde{}",
    "^": r"\textasciicircum{}",
    "±": r"$\pm$",
}


def table_csv(groups: Sequence[Mapping[str, Any]]) -> str:
    """Gaits compared, a row a gait and step; what is not known is empty, and no name begins a formula.

    Args:
        groups: of `app.trials.service.compared`.
    """
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(COLUMNS.values())
    writer.writerows([table_cell(_cell(group, key)) for key in COLUMNS] for group in groups)
    return text.getvalue()


def table_latex(groups: Sequence[Mapping[str, Any]]) -> str:
    """The same as a LaTeX tabular with rules of booktabs."""
    lines = [
        rf"\begin{{tabular}}{{l{'r' * (len(COLUMNS) - 1)}}}",
        r"\toprule",
        " & ".join(_escaped(title) for title in COLUMNS.values()) + r" \\",
        r"\midrule",
        *(" & ".join(_escaped(_cell(group, key)) for key in COLUMNS) + r" \\" for group in groups),
        r"\bottomrule",
        r"\end{tabular}",
    ]
    return "\n".join(lines) + "\n"


def _cell(group: Mapping[str, Any], key: str) -> str:
    value = len(group["trials"]) if key == "count" else group[key]
    if value is None:
        return ""
    return f"{value:.2f}" if isinstance(value, float) else str(value)


def _escaped(text: str) -> str:
    return "".join(_LATEX.get(character, character) for character in text)
