"""Gaits, plans, verdicts and the rest as a script has them, and what is refused in a sentence."""

from __future__ import annotations

import importlib
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import footfall as ff


@pytest.fixture(autouse=True)
def data_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """No gaits of the person who runs the tests."""
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path))
    return tmp_path


def plan_of_walk(**options: Any) -> Any:
    return ff.optimise("walk", method="live", **options)


def test_a_plan_has_the_arrays_that_its_docstring_says() -> None:
    plan = plan_of_walk(iterations=2)
    count = len(plan.times)
    assert (plan.body.shape, plan.feet.shape) == ((count, 3), (count, 4, 3))
    assert (plan.heading.shape, plan.contact.shape) == ((count,), (count, 4))
    assert plan.waypoints.ndim == 3
    assert np.linalg.norm(plan.body[-1, :2] - plan.body[0, :2]) == pytest.approx(0.020, abs=1e-6)
    assert plan.speed == pytest.approx(0.020 / plan.robot_seconds, rel=1e-6)
    assert 0 < plan.stop_seconds < 2.5
    assert "solved" in repr(plan)


def test_an_infeasible_plan_says_why_and_has_no_arrays() -> None:
    plan = plan_of_walk(step=0.05)
    assert plan.status == "infeasible"
    assert "Lengthen its swing or shorten the step." in " ".join(plan.explanation)
    with pytest.raises(ff.InfeasibleError, match="has to travel"):
        _ = plan.body
    with pytest.raises(ff.InfeasibleError, match="has to travel"):
        ff.send(plan, to="emulator", by="Ada")
    assert "has to travel" in plan._repr_html_()


@pytest.mark.parametrize(
    ("act", "kind", "words"),
    [
        (lambda: ff.optimise("wlk"), ff.InputError, "There is no gait “wlk” to optimise"),
        (lambda: ff.gait("fast-c"), ff.InputError, "Did you mean “fast-c-gait”"),
        (lambda: ff.gait("nothing at all"), ff.InputError, "There is no gait “nothing at all”"),
        (lambda: ff.gait("nowhere.json"), ff.FootfallError, "nowhere.json"),
        (lambda: ff.optimise("walk", step=10), ff.InputError, r"it is in m, did you mean 0\.010\?"),
        (lambda: ff.fastest("walk", step=10), ff.InputError, r"it is in m, did you mean 0\.010\?"),
        (lambda: ff.optimise("walk", stepp=0.01), ff.InputError, "Did you mean “step”"),
        (lambda: ff.optimise("walk", method="guess"), ff.InputError, "must be one of live, nlp"),
        (lambda: ff.plan([[0.005] * 3] * 3), ff.InputError, r"shape \(3, 3\); it must be \(n, 4, 3\)"),
        (lambda: ff.plan([[np.nan] * 3] * 4), ff.InputError, "nan or infinity"),
        (lambda: ff.check([["a"] * 3] * 4), ff.InputError, "no number"),
        (lambda: ff.plan(np.full((2, 4, 3), 5.5)), ff.FootfallError, "mm"),
        (lambda: ff.robot("spot"), ff.InputError, "There is no robot “spot”"),
        (lambda: ff.robot().strokes([[0.0, 0.0, 0.0]] * 4), ff.FootfallError, "outside its workspace"),
        (lambda: ff.send("walk-manual-0", to="emulator", by=" "), ff.InputError, "name of the person"),
        (lambda: ff.send("hexapod-wave", to="emulator", by="Ada"), ff.FootfallError, "only the DeltaWalker"),
        (lambda: ff.send("walk-manual-0", to="/dev/nothing", by="Ada"), ff.FootfallError, "/dev/nothing"),
        (lambda: ff.sequence("walk", "hexapod-wave"), ff.InputError, "a sequence moves one robot"),
        (lambda: ff.gait("walk").save("walk.txt"), ff.InputError, "written as .json, .svg, .png, .phases"),
        (lambda: plan_of_walk().save("walk.xls"), ff.InputError, "a plan is written as .csv"),
        (lambda: ff.show(ff.plan(np.full((2, 4, 3), 0.0055))), ff.InputError, "waypoints alone"),
        (lambda: ff.trial("nowhere.csv", expect=5), ff.FootfallError, "nowhere.csv"),
        (lambda: ff.optimise(ff.gait("walk-manual-0")), ff.InputError, "there is nothing to optimise"),
        (lambda: ff.frontier(ff.gait("fast-c-gait")), ff.InputError, "there is nothing to optimise"),
        (lambda: ff.simulate("walk-manual-0", stop_bound=0.5), ff.InputError, "no option “stop_bound”"),
        (lambda: ff.optimise("walk", remedy=1), ff.InputError, "no option “remedy”"),
        (lambda: ff.segments("walk"), ff.InputError, "Foot 1 would step"),
        (lambda: ff.segments("fast-walk"), ff.InputError, "it has no segments"),
        (lambda: ff.segments("walk-manual-0").changed(5, []), ff.InputError, "no foot 5"),
        (lambda: ff.segments("walk-manual-0").changed(1, ["Push A"]), ff.InputError, "given 1 segments"),
        (lambda: ff.transition("walk", "amble", start=99, end=0), ff.InputError, "sample 100"),
        (lambda: ff.transition("walk", "hexapod-wave", start=0, end=0), ff.InputError, "different robots"),
        (lambda: ff.pattern(legs=5, samples=12, periodic=True).gait(), ff.InputError, "No robot has 5"),
        (
            lambda: ff.pattern(legs=6, samples=20, start="111001", end="011011").gait(),
            ff.InputError,
            "footfall.transition joins",
        ),
        (lambda: ff.remedies("walk", remedy=1), ff.InputError, "no option “remedy”"),
        (lambda: ff.remedies("walk-manual-0"), ff.InputError, "walk-manual-0"),
        (lambda: ff.remedies(plan_of_walk(), step=0.01), ff.InputError, "options are for gaits"),
        (lambda: ff.gait(None), ff.InputError, "A gait is named by its id"),
        (lambda: ff.send("walk-manual-0", to="emulator", by=None), ff.InputError, "name of the person"),
    ],
)  # fmt: skip
def test_bad_input_is_refused_in_a_sentence(
    act: Callable[[], object], kind: type[Exception], words: str
) -> None:
    with pytest.raises(kind, match=words) as refusal:
        act()
    assert isinstance(refusal.value, ff.FootfallError)


@pytest.mark.heavy
def test_strokes_of_ones_own_are_checked_and_simulated() -> None:
    plan = plan_of_walk()
    again = ff.plan(plan.waypoints)
    assert np.allclose(again.waypoints, plan.waypoints)
    assert ff.check(plan.waypoints).passed
    assert not ff.simulate(plan.waypoints).fell


def test_files_lead_back_to_the_same_plan(tmp_path: Path) -> None:
    plan = plan_of_walk()
    assert ff.plan(plan.save(tmp_path / "walk.waypoints.csv")).waypoints == pytest.approx(
        plan.waypoints, abs=1e-7
    )
    trajectory = ff.plan(plan.save(tmp_path / "walk.csv"))
    assert trajectory.status == "given"
    assert trajectory.feet == pytest.approx(plan.feet, abs=1e-9)
    assert ff.gait(plan.save(tmp_path / "walk.json")).document == plan.gait.document
    for name in ("walk.npz", "walk.html", "walk.svg", "walk.png"):
        assert plan.save(tmp_path / name).stat().st_size > 500


def test_a_verdict_has_findings_and_margins_of_the_command() -> None:
    verdict = ff.check("walk-manual-0")
    assert verdict.passed
    assert {one["rule"] for one in verdict.findings} >= {"slip"}
    assert all(one["severity"] in ("error", "warning") for one in verdict.findings)
    assert verdict.margins["stroke"] is not None
    assert "Fit to send." in verdict._repr_html_()


@pytest.mark.heavy
def test_variations_say_which_share_walks() -> None:
    result = ff.simulate("fast-c-gait", variations=2)
    assert result.walks
    assert result.share == 1.0
    assert "100 % of the variations walk" in repr(result)
    assert result.feet.shape == (len(result.times), 4, 3)


def test_a_gait_is_changed_and_stays_as_it_is() -> None:
    walk = ff.gait("walk")
    longer = walk.changed(step=0.012, name="Longer")
    assert [np.hypot(*one.step[:2]) for one in (walk, longer)] == pytest.approx([0.010, 0.012])
    assert (longer.name, longer.id) == ("Longer", None)
    assert longer.content["name"] == "Longer"
    assert "<svg" in walk._repr_html_()
    assert ff.optimise(longer, method="live").status == "solved"


def test_the_lists_show_themselves_as_tables() -> None:
    gaits = ff.gaits()
    assert len(gaits) > 50
    assert "fast-c-gait" in gaits._repr_html_()
    assert "strokes 0.5 to 19.5 mm" in repr(ff.robot())
    assert "motor" in ff.robot()._repr_html_()


def test_a_cycle_becomes_a_gait_of_a_robot_with_as_many_legs() -> None:
    found = ff.pattern(legs=6, samples=18, periodic=True, locked="3:swing")
    five = found.gait("Five limbs", step=0.008)
    assert (five.name, five.robot) == ("Five limbs", "hexapod")
    assert not five.stance[2].any()
    assert ff.optimise(five, method="live").status == "solved"
    assert found.gait(robot="hexapod").step[:2] == pytest.approx([0.010 / np.sqrt(2)] * 2)


def test_a_transition_joins_two_gaits() -> None:
    walk, amble = ff.gait("walk"), ff.gait("amble")
    found = ff.transition("walk", amble, start=22, end=22)
    assert found.status == "optimal"
    assert (found.stance[:, 0] == walk.stance[:, 22]).all()
    assert (found.stance[:, -1] == amble.stance[:, 22]).all()
    joined = found.gait("Both")
    assert joined.name == "Both"
    assert joined.stance[:, 22 : 22 + found.stance.shape[1]].tolist() == found.stance.tolist()
    assert ff.optimise(joined, method="live").status == "solved"


def test_a_transition_that_is_too_short_says_what_would_do() -> None:
    found = ff.transition("walk", "amble", start=8, end=8, samples=4)
    assert (found.status, found.pattern) == ("infeasible", [])
    assert "It works with" in " ".join(found.explanation)
    with pytest.raises(ff.InfeasibleError, match="There is no pattern"):
        found.gait()


def test_a_segment_table_is_changed_and_becomes_a_gait() -> None:
    table = ff.segments("walk-manual-0")
    assert (len(table.rows), table.count, table.samples) == (4, 11, 5)
    assert table.vocabulary["Step A"] == ("Home-None", "Step-Base")
    assert ff.plan(table.gait()).waypoints == pytest.approx(ff.plan("walk-manual-0").waypoints)
    swapped = table.changed(2, table.rows[2]).changed(3, table.rows[1]).gait("Swapped")
    assert (swapped.name, swapped.order) == ("Swapped", (2, 3, 4, 1))
    assert ff.plan(swapped).status == "given"
    assert "Push A" in table._repr_html_()


def test_a_drawn_gait_has_the_table_that_implies_its_footfalls() -> None:
    drawn = ff.gait("walk", phase_knots=6, closing_knots=6)
    assert (ff.segments(drawn).gait().stance == drawn.stance).all()


def test_a_phase_list_leads_back_to_the_same_footfalls(tmp_path: Path) -> None:
    walk = ff.gait("walk")
    assert (ff.gait(walk.save(tmp_path / "walk.phases.json")).stance == walk.stance).all()


def test_remedies_are_gaits_that_walk() -> None:
    plan = ff.plan("textbook-trot", method="live")
    found = ff.remedies(plan)
    assert len(found) > 1
    assert ff.optimise(found[0].gait, method="live").status == "solved"
    assert "<table>" in found._repr_html_()
    assert repr(found).startswith("1. ")
    assert ff.remedies("walk", step=0.05)[0].kind == "step"


def test_a_gait_with_a_motion_needs_no_remedy() -> None:
    found = ff.remedies("walk")
    assert (len(found), found.explanation) == (0, "This gait has a motion; it needs no remedy.")
    assert ff.remedies(plan_of_walk()).explanation == found.explanation == repr(found)
    assert found.explanation in found._repr_html_()


def test_a_sequence_is_planned() -> None:
    tour = ff.sequence(("walk", 2), "rotate", name="Tour")
    plan = ff.plan(tour, method="live")
    assert plan.status == "solved"
    assert plan.heading[-1] == pytest.approx(np.radians(15), abs=1e-6)


def test_a_pattern_is_drawn_or_says_why_there_is_none() -> None:
    found = ff.pattern(legs=6, samples=20, start="111001", end="011011")
    assert (found.status, found.stance.shape) == ("optimal", (6, 20))
    none = ff.pattern(legs=4, samples=3, start="1111", end="0111")
    assert (none.status, none.pattern) == ("infeasible", [])
    with pytest.raises(ff.InfeasibleError, match="There is no pattern"):
        _ = none.stance


def test_plots_need_matplotlib_and_say_so() -> None:
    plan = plan_of_walk()
    try:
        import matplotlib  # type: ignore[import-not-found, unused-ignore]  # noqa: F401
    except ImportError:
        with pytest.raises(ff.InputError, match="needs matplotlib"):
            plan.plot()
    else:
        figure = plan.plot()
        assert len(figure.axes) == 3
        assert figure._repr_png_().startswith(b"\x89PNG"), "a notebook shows it without pyplot"


def test_a_solver_that_gives_up_is_not_called_solved(monkeypatch: pytest.MonkeyPatch) -> None:
    planning = importlib.import_module("footfall.app.scripting.planning")
    gaits = importlib.import_module("footfall.core.gait.gait")
    tiers = importlib.import_module("footfall.solver_jobs")
    verify = importlib.import_module("footfall.app.plans.verified_result").verify

    def fails(document: Any, method: Any) -> Any:
        problem = gaits.motion_problem(document, planning.load_robot(document.robot))
        return verify(problem, replace(tiers.solve_live(problem), status=tiers.SolveStatus.FAILED))

    monkeypatch.setattr(planning, "solve", fails)
    plan = ff.plan("walk")
    assert plan.status == "failed"
    with pytest.raises(ff.CheckError, match="has no motion"):
        _ = plan.body


def test_a_recorded_motion_is_optimised_anew(tmp_path: Path) -> None:
    recorded = ff.gait(plan_of_walk().save(tmp_path / "walk.csv"))
    assert ff.plan(recorded).status == "given"
    plan = ff.optimise(recorded, method="live")
    assert plan.status == "solved"
    assert plan.gait.document.recorded is None
    assert recorded.changed(step=0.008).document.recorded is None


def test_waypoints_name_their_robot(tmp_path: Path) -> None:
    plan = ff.plan("hexapod-wave", method="live")
    again = ff.plan(plan.save(tmp_path / "wave.waypoints.csv"))
    assert again.robot.name == "hexapod"
    assert again.waypoints == pytest.approx(plan.waypoints, abs=1e-7)
