"""The table of rules in the documentation against the rules in the code."""

from __future__ import annotations

import re

import numpy as np
import pytest

from core.checks import arms as arm_check
from core.checks import balance, made_plan
from core.checks import coupling as coupling_check
from core.checks import document as document_check
from core.checks import ground as ground_check
from core.checks import motors as motor_check
from core.checks import path as path_check
from core.checks import shoes as shoe_check
from core.motion.balance import BALANCE_RESERVE
from core.motion.way_made import WARNED_SHARE
from core.overrides import FINAL, OVERRIDABLE
from core.physics import findings as physics
from core.robot.arms import ARM_GAP
from core.robot.model import load_robot
from core.robot.shoes import SHOE_GAP
from core.wire.messages import LONGEST_DURATION, SHORTEST_DURATION
from core.wire.robot_time import ARRIVAL_THRESHOLD
from tests.support.studio_process import PROJECT

TEXT = (PROJECT / "docs" / "checks.md").read_text()
ROWS = re.findall(r"^\| `(\w+)` \| (.*?) \| (.*?) \| (.*?) \| (.*?) \|$", TEXT, re.MULTILINE)
STROKE = load_robot("deltawalker").stroke
SHARE = f"{WARNED_SHARE * 100:.0f} %"
PART = f"{physics.TRAVEL_SHARE * 100:.0f} %"
SHOE = load_robot("deltawalker").shoe_diameter or 0.0
MODULES = (
    arm_check,
    balance,
    coupling_check,
    document_check,
    ground_check,
    made_plan,
    motor_check,
    path_check,
    shoe_check,
    physics,
)


def limits(rule: str) -> list[str]:
    return [row[2] for row in ROWS if row[0] == rule]


def test_every_rule_that_the_code_names_stands_in_the_table_and_no_other() -> None:
    named: set[str] = set()
    for module in MODULES:
        text = (PROJECT / (module.__name__.replace(".", "/") + ".py")).read_text()
        named |= set(re.findall(r'(?:RuleMargin|found|Finding)\(\s*"(\w+)"', text))
        named |= set(re.findall(r'^RULE = "(\w+)"', text, re.MULTILINE))
        named |= set(re.findall(r'^ +"((?:path|made)_\w+)": ', text, re.MULTILINE))
        named |= set(re.findall(r'(?:travel|heading)_outcome\(\s*"(\w+)"', text))
    assert {row[0] for row in ROWS} == named


@pytest.mark.parametrize(("name", "table"), [("may", OVERRIDABLE), ("may not", FINAL)])
def test_the_documentation_lists_the_rules_that_may_be_overridden(name: str, table: dict[str, str]) -> None:
    (line,) = re.findall(rf"^- Errors of these rules {name} be overridden: (.*)$", TEXT, re.MULTILINE)
    assert re.findall(r"`(\w+)`", line) == list(table)


def test_every_rule_in_the_table_is_classified_once() -> None:
    rules = {row[0] for row in ROWS}
    assert rules <= OVERRIDABLE.keys() | FINAL.keys()
    assert OVERRIDABLE.keys() <= rules


@pytest.mark.parametrize(
    ("rule", "said"),
    [
        ("stroke", [f"{STROKE.lower * 1000:.1f} to {STROKE.upper * 1000:.1f} mm"]),
        ("motor_speed", [f"{STROKE.speed * 1000:.0f} mm/s, or the gait's own"]),
        ("move_size", [f"{ARRIVAL_THRESHOLD * 1000:.1f} mm"]),
        ("deafness", [f"{motor_check.DEAF_LIMIT} s"]),
        ("duration", [f"{SHORTEST_DURATION:g} to {LONGEST_DURATION:g} s"]),
        ("balance", ["0 mm", f"{BALANCE_RESERVE * 1000:.1f} mm, or the gait's own margin"]),
        ("contact", [f"{ground_check.CONTACT_LIMIT * 1000:.2f} mm"]),
        ("slip", [f"{ground_check.SLIP_LIMIT * 1000:.1f} mm"]),
        ("clearance", [f"{ground_check.CLEARANCE_LIMIT * 1000:.1f} mm"]),
        (
            "shoe_distance",
            [f"the shoes' diameter, {SHOE * 1000:.1f} mm", f"{SHOE_GAP * 1000:.1f} mm"],
        ),
        ("arm_distance", [f"{ARM_GAP * 1000:.1f} mm"]),
        ("start_pose", [f"{document_check.START_FEET} feet", "none"]),
        ("travel", [f"{document_check.TRAVEL_LIMIT * 1000:.1f} mm"]),
        ("turn", [f"{np.degrees(document_check.TURN_LIMIT):.0f}°"]),
        ("height", [f"{document_check.HEIGHT_LIMIT * 1000:.1f} mm"]),
        ("coupling", [f"{coupling_check.RESIDUAL_LIMIT * 1000:.1f} mm"]),
        ("path_balance", [f"{path_check.BALANCE_SLACK * 1000:.1f} mm"]),
        ("path_ground", [f"{path_check.GROUND_LIMIT * 1000:.1f} mm"]),
        ("path_clearance", [f"{path_check.RISE_LIMIT * 1000:.1f} mm"]),
        ("simulated_tilt", [f"{np.degrees(physics.TILT_LIMIT):.0f}°"]),
        ("simulated_swing", [f"{physics.SWING_LIMIT * 100:.0f} %"]),
        ("simulated_slip", [f"{physics.SLIP_LIMIT * 1000:.1f} mm"]),
        ("simulated_balance", [f"{physics.BALANCE_LIMIT * 1000:.0f} mm"]),
        ("lean", [f"{np.degrees(physics.TILT_LIMIT):.0f}°"]),
        ("made_travel", [SHARE]),
        ("made_heading", [SHARE]),
        (
            "simulated_travel",
            [
                SHARE,
                f"{physics.TRAVEL_LIMIT * 1000:.1f} mm, or {physics.TRAVEL_SHARE * 100:.0f} % of the way",
            ],
        ),
        (
            "simulated_heading",
            [SHARE, f"{np.degrees(physics.HEADING_LIMIT):.0f}°, or {PART} of the turn"],
        ),
        ("simulated_motors", [f"{physics.TRACK_LIMIT * 1000:.1f} mm"]),
        ("simulated_force", [f"{physics.SATURATION_LIMIT * 100:.0f} %"]),
    ],
)
def test_limits_in_the_table_are_those_of_the_code(rule: str, said: list[str]) -> None:
    assert limits(rule) == said
