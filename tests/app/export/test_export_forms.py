"""Every form of a gait and its plan: what is in it, what is refused, and that nothing breaks out of it."""

from __future__ import annotations

import io
import json
import re
from dataclasses import replace
from functools import cache
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest
from PIL import Image

from app.documents.gait_json import parse_gait
from app.export.formats import NEED_NO_MOTION, ExportFormat, export
from app.export.import_gait import gait_of_recording
from app.export.source import Exportable, exportable_file, exportable_plan
from app.plans.make_plan import make_plan
from core.errors import FootfallError, InputError
from core.gait.gait import Gait
from core.gait.recording import Recording, RecordingForm
from core.library.library import library
from core.motion.phase_list import parse_phases
from core.motion.trajectory_npz import parse_npz
from core.wire.trajectory_csv import format_companion, parse_trajectory_csv
from core.wire.waypoints import parse_waypoint_csv
from solver_jobs import SolveStatus, solve_live
from tests.support.live_tiers import result_of
from tests.support.reference import reference_path

HOSTILE = "</script><script>alert(1)</script> & “quotes” \x07"
SVG = "{http://www.w3.org/2000/svg}"


@cache
def planned(gait_id: str, **options: Any) -> Exportable:
    gait = library()[gait_id].gait.with_options(**options)
    return exportable_plan(gait_id, gait, make_plan(gait, None, solve_live))


def written(source: Exportable, form: ExportFormat) -> str:
    return export(source, form).content.decode()


@pytest.mark.parametrize("gait_id", ["walk", "walk-manual-0"])
def test_what_is_read_back_is_what_was_planned(gait_id: str) -> None:
    source = planned(gait_id, merge=0.0, stop_bound=None)
    gait, motion = source.need_gait(), source.need_motion()
    assert parse_gait(written(source, ExportFormat.JSON)) == gait
    assert parse_phases(written(source, ExportFormat.PHASES)) == replace(
        gait.timeline, locked=np.zeros_like(gait.timeline.locked)
    )
    text = written(source, ExportFormat.CSV)
    read = parse_trajectory_csv(text, "t.csv", written(source, ExportFormat.COMPANION))
    assert read.assumptions == ()
    assert np.array_equal(read.trajectory.feet_world, motion.trajectory.feet_world)
    assert np.array_equal(read.trajectory.contact, motion.trajectory.contact)
    arrays = parse_npz(export(source, ExportFormat.NPZ).content)
    assert (arrays.name, arrays.feet) == (gait.name, gait.roles)
    assert np.array_equal(arrays.trajectory.body_world, motion.trajectory.body_world)
    waypoints = parse_waypoint_csv(written(source, ExportFormat.WAYPOINTS))
    assert np.abs(waypoints.strokes - arrays.strokes).max() <= 0.5001e-7


def test_names_and_types_say_what_a_file_is() -> None:
    files = {form: export(planned("walk"), form) for form in ExportFormat}
    assert files[ExportFormat.HTML].name == "walk.html"
    assert files[ExportFormat.COMPANION].name == "walk.footfall.json"
    assert files[ExportFormat.WAYPOINTS].name == "walk.waypoints.csv"
    assert files[ExportFormat.PNG].media_type == "image/png"
    assert len({file.name for file in files.values()}) == len(files)


def infeasible() -> Exportable:
    gait = library()["walk"].gait
    return exportable_plan(
        "walk", gait, make_plan(gait, None, lambda problem: result_of(problem, SolveStatus.INFEASIBLE))
    )


@pytest.mark.parametrize("form", sorted(set(ExportFormat) - NEED_NO_MOTION))
def test_a_drawing_that_breaks_what_is_asked_is_not_exported_as_a_motion(form: ExportFormat) -> None:
    with pytest.raises(InputError, match="This gait has no motion to export: There is none"):
        export(infeasible(), form)


@pytest.mark.parametrize("form", sorted(NEED_NO_MOTION))
def test_what_needs_no_motion_is_exported_without_one(form: ExportFormat) -> None:
    assert export(infeasible(), form).content == export(planned("walk"), form).content


def test_a_motion_out_of_reach_has_no_waypoints_but_everything_else() -> None:
    source, _ = exportable_file(reference_path("trajectories/direction1/walk_e.csv"))
    with pytest.raises(FootfallError, match=r"no waypoints: Foot 3 cannot reach"):
        export(source, ExportFormat.WAYPOINTS)
    assert np.isfinite(parse_npz(export(source, ExportFormat.NPZ).content).strokes).all()
    assert "<svg" in written(source, ExportFormat.HTML)


def test_a_recorded_file_is_exported_as_it_stands() -> None:
    path = reference_path("trajectories/direction2/walk_a.csv")
    source, assumptions = exportable_file(path)
    assert len(assumptions) == 2
    ours, theirs = written(source, ExportFormat.CSV), path.read_text()
    numbers = [np.array([float(n) for n in re.split(r"[,\n]", text.strip())]) for text in (ours, theirs)]
    assert numbers[0].tobytes() == numbers[1].tobytes()
    with pytest.raises(InputError, match="only assumed"):
        export(source, ExportFormat.COMPANION)


def test_a_recorded_header_that_holds_a_formula_is_exported_as_text_and_its_companion_fits() -> None:
    motion = planned("walk").need_motion()
    text = written(planned("walk"), ExportFormat.CSV).replace("Column1", "=HYPERLINK(A1)", 1)
    companion = format_companion(motion.trajectory, text)
    recording = Recording("walk.csv", RecordingForm.TRAJECTORY, text, companion)
    gait = gait_of_recording(recording, "Recorded").gait
    source = exportable_plan("walk", gait, make_plan(gait, None, solve_live))
    ours = written(source, ExportFormat.CSV)
    assert ours.startswith("'=HYPERLINK(A1),Column2")
    assert ours.partition("\n")[2] == text.partition("\n")[2]
    read = parse_trajectory_csv(ours, "walk.csv", written(source, ExportFormat.COMPANION))
    assert read.assumptions == ()
    assert np.array_equal(read.trajectory.times, motion.trajectory.times)


def locked_gait(name: str = "Walk") -> Gait:
    gait = library()["walk"].gait
    locked = gait.timeline.locked.copy()
    locked[1, 3:9] = True
    return replace(gait, name=name, timeline=replace(gait.timeline, locked=locked))


def diagram_of(gait: Gait) -> ElementTree.Element:
    source = Exportable("gait", gait, InputError("none", "plan"))
    return ElementTree.fromstring(written(source, ExportFormat.SVG))


def test_the_diagram_has_each_swing_in_its_feet_colour_and_hatches_what_is_locked() -> None:
    drawn = diagram_of(locked_gait())
    colours = [box.get("fill") for box in drawn.iter(f"{SVG}rect") if box.get("height") == "30"]
    swings = [colour for colour in colours if colour != "#eceef2"]
    assert swings == ["#2e9e5b", "#d64545", "#e08a1e", "#3b78d8"]
    hatched = [line for line in drawn.iter(f"{SVG}line") if line.get("stroke") == "#8b5cf6"]
    assert hatched
    words = [text.text for text in drawn.iter(f"{SVG}text")]
    assert {"1", "2", "3", "4", "FR", "FL", "BL", "BR", "time, s", "locked", "89 %", "2.00 s"} <= set(words)
    described = drawn.findtext(f"{SVG}desc") or ""
    assert "Foot 3 (BL) swings 2 to 4 s." in described


def test_hatching_stays_within_the_locked_cells() -> None:
    drawn, left, width = diagram_of(locked_gait()), 104.0, 940.0
    ends = [
        (float(line.get(f"x{end}", 0)), float(line.get(f"y{end}", 0)))
        for line in drawn.iter(f"{SVG}line")
        for end in (1, 2)
        if line.get("stroke") == "#8b5cf6"
    ]
    in_rows = np.array([end for end in ends if end[1] < 240])
    first, after = left + width * 3 / 45, left + width * 9 / 45
    assert in_rows.min(axis=0) == pytest.approx([first, 132], abs=0.01)
    assert in_rows.max(axis=0) == pytest.approx([after, 162], abs=0.01)


@pytest.mark.parametrize("gait_id", list(library()))
def test_every_gait_of_the_library_has_a_diagram_as_svg_and_as_png(gait_id: str) -> None:
    gait = library()[gait_id].gait
    source = Exportable("gait", gait, InputError("none", "plan"))
    drawn = ElementTree.fromstring(written(source, ExportFormat.SVG))
    picture = Image.open(io.BytesIO(export(source, ExportFormat.PNG).content))
    wanted = tuple(round(2 * float(drawn.get(side, "0"))) for side in ("width", "height"))
    assert (picture.format, picture.size) == ("PNG", wanted)


def test_the_picture_has_the_colours_of_the_drawing() -> None:
    source = Exportable("gait", library()["walk"].gait, InputError("none", "plan"))
    picture = Image.open(io.BytesIO(export(source, ExportFormat.PNG).content)).convert("RGB")
    swing_of_foot_3 = (round(2 * (104 + 940 * 5.4 / 45)), 2 * (96 + 2 * 36 + 15))
    assert picture.getpixel(swing_of_foot_3) == (0xE0, 0x8A, 0x1E)
    assert picture.getpixel((0, 0)) == (255, 255, 255)


def test_a_name_cannot_break_out_of_svg_or_page() -> None:
    gait = locked_gait(HOSTILE)
    assert HOSTILE[:8] in "".join(diagram_of(gait).itertext())
    source = replace(planned("walk"), gait=gait)
    page = written(source, ExportFormat.HTML)
    assert page.count("<script") == page.count("</script>") == 2
    assert "alert(1)</script>" not in page


def test_the_page_asks_nothing_of_the_network_and_holds_the_motion() -> None:
    source = planned("walk")
    page = written(source, ExportFormat.HTML)
    assert "default-src 'none'" in page
    assert "{{" not in page
    assert re.findall(r"https?://[^\"']+", page) == ["http://www.w3.org/2000/svg"]
    found = re.search(r'<script type="application/json" id="motion">(.*?)</script>', page, re.DOTALL)
    assert found is not None
    data = json.loads(found.group(1))
    trajectory = source.need_motion().trajectory
    assert np.array_equal(data["feet"], trajectory.feet_world)
    assert np.array_equal(data["times"], trajectory.times)


def test_strokes_that_do_not_exist_are_null_in_the_page() -> None:
    source = planned("walk")
    motion = source.need_motion()
    feet = motion.trajectory.feet_world.copy()
    feet[3, 0, 0] += 0.2
    far = replace(motion, trajectory=replace(motion.trajectory, feet_world=feet))
    page = written(replace(source, motion=far), ExportFormat.HTML)
    assert "NaN" not in page
    assert "null" in page
