"""The x–y plots of thesis Figures 4.2 to 4.8 beside ours, as one page to print."""

from collections.abc import Iterator, Sequence
from html import escape

import numpy as np

from app.bench.physics.runs import ManualCase, OptimisedCase
from app.common.version import VERSION
from app.export.path_plot import Ways, way_plot
from app.export.svg import svg
from app.published.plots import FIGURES, ROOM
from app.published.reference import PublishedRun
from app.published.walked import Walked

_STYLE = """
:root { color-scheme: light; }
body { margin: 24px auto; max-width: 1080px; padding: 0 16px; color: #1b2430; background: #ffffff;
  font: 13px/1.45 system-ui, -apple-system, "Segoe UI", Roboto, "DejaVu Sans", sans-serif; }
h1 { font-size: 20px; font-weight: 650; margin: 0 0 8px; }
h2 { font-size: 16px; font-weight: 650; margin: 32px 0 8px; break-after: avoid; }
p { margin: 0 0 8px; max-width: 80ch; color: #667085; }
.case { display: grid; grid-template-columns: repeat(3, minmax(0, 1fr)); gap: 16px; margin: 0 0 16px;
  break-inside: avoid; }
figure { margin: 0; }
figure svg { width: 100%; height: auto; }
figcaption { color: #667085; font-size: 12px; font-variant-numeric: tabular-nums; }
.absent { align-self: center; color: #667085; }
@page { size: A4 portrait; margin: 12mm; }
@media print {
  body { margin: 0; padding: 0; max-width: none; font-size: 11px; }
  h2 { margin: 0 0 2mm; break-before: page; }
  .intro + h2 { break-before: avoid; margin-top: 4mm; }
  .case { grid-template-columns: repeat(3, 50mm); gap: 0 12mm; margin: 0 0 2mm; }
  figcaption { font-size: 9px; }
}
"""

_WORDS = (
    "Ways of the body (black) and the feet (in their colours) from above, one iteration, mm. Wide and pale "
    "is the plan, thin the simulation at each waypoint's arrival. Every plot of a figure has the same scale. "
    "“Thesis” is the published simulation; in the gaits made by hand its plan is that of a robot that stands "
    "still, as its Table 4.1 has it. Leans of published runs are those of their feet, since no attitude was "
    "published."
)


def physics_page(optimised: Sequence[OptimisedCase], manual: Sequence[ManualCase]) -> str:
    """One HTML page that needs nothing else.

    Args:
        optimised: the cases of Figures 4.5 to 4.8.
        manual: the cases of Figures 4.2 to 4.4.
    """
    figures = [
        _figure(gait, True, [case for case in optimised if case.gait == gait]) for gait in _gaits(optimised)
    ]
    by_hand = [
        _figure(family, False, [case for case in manual if case.family == family])
        for family in _families(manual)
    ]
    title = "Simulated gaits beside the thesis's Figures 4.2 to 4.8"
    return "\n".join(
        [
            '<!doctype html>\n<html lang="en">\n<head>\n<meta charset="utf-8">',
            '<meta name="viewport" content="width=device-width, initial-scale=1">',
            f"<title>{title} · Footfall Studio</title>\n<style>{_STYLE}</style>\n</head>\n<body>",
            f'<h1>{title}</h1>\n<p class="intro">{escape(_WORDS)} Footfall Studio {escape(VERSION)}.</p>',
            *by_hand,
            *figures,
            "</body>\n</html>\n",
        ]
    )


def _gaits(cases: Sequence[OptimisedCase]) -> list[str]:
    return list(dict.fromkeys(case.gait for case in cases))


def _families(cases: Sequence[ManualCase]) -> list[str]:
    return list(dict.fromkeys(case.family for case in cases))


def _figure(gait: str, is_optimised: bool, cases: Sequence[OptimisedCase] | Sequence[ManualCase]) -> str:
    number = FIGURES[gait, is_optimised]
    kind = "optimised" if is_optimised else "made by hand"
    rows = [_plots(case) for case in cases]
    reach = max(ways.reach for row in rows for ways, _ in row if ways is not None) + ROOM
    name = number.replace(".", "-")
    drawn = [_case(row, reach, f"figure-{name}-{index}", _colours(cases)) for index, row in enumerate(rows)]
    return f"<h2>Figure {number}: {escape(gait)}, {kind}</h2>\n" + "\n".join(drawn)


def _colours(cases: Sequence[OptimisedCase] | Sequence[ManualCase]) -> tuple[str, ...]:
    return cases[0].own.problem.model.colours


_Plot = tuple[Ways | None, str]


def _plots(case: OptimisedCase | ManualCase) -> list[_Plot]:
    if isinstance(case, ManualCase):
        name = f"Version {case.version}"
        return [_published(case.theirs, name), _simulated(case.own, f"{name}, our physics")]
    name = f"{case.step * 1000:.0f} mm"
    own = f"{name}, our own gait, margin {case.margin * 1000:g} mm"
    return [
        _published(case.theirs, name),
        _simulated(case.again, f"{name}, published gait, our physics"),
        _simulated(case.own, own),
    ]


def _published(run: PublishedRun | None, name: str) -> _Plot:
    if run is None:
        return None, f"{name}: no published run is at hand."
    ways = Ways(
        f"{name}, thesis",
        run.wanted_body[:, :2],
        run.wanted_feet[..., :2],
        run.body[:, :2],
        run.feet[..., :2],
    )
    return ways, _words(float(run.feet_error.mean()), run.body_error, float(run.tilts.max()))


def _simulated(run: Walked | None, name: str) -> _Plot:
    if run is None:
        return None, f"{name}: the published trajectory is not at hand."
    body, feet = run.planned
    ways = Ways(name, body[:, :2], feet[..., :2], run.body[:, :2], run.feet[..., :2])
    figures = run.report
    end = f"; falls at {figures.fell_time:.1f} s" if figures.fell_time is not None else ""
    return ways, _words(figures.feet_mean_error, figures.body_error, figures.max_tilt) + end


def _words(feet: float, body: float, lean: float) -> str:
    return (
        f"feet {feet * 1000:.2f} mm, body {body * 1000:.2f} mm from the plan; "
        f"leans {np.degrees(lean):.1f}° at most"
    )


def _case(row: Sequence[_Plot], reach: float, name: str, colours: tuple[str, ...]) -> str:
    return '<div class="case">\n' + "\n".join(_panels(row, reach, name, colours)) + "\n</div>"


def _panels(row: Sequence[_Plot], reach: float, name: str, colours: tuple[str, ...]) -> Iterator[str]:
    for index, (ways, words) in enumerate(row):
        if ways is None:
            yield f'<p class="absent">{escape(words)}</p>'
            continue
        drawing = svg(way_plot(ways, colours, reach), f"{name}-{index}")
        yield f"<figure>\n{drawing}<figcaption>{escape(words)}</figcaption>\n</figure>"
