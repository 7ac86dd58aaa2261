"""Feet held up on the page: said in two fields, drawn in the air, and carried along by operations."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import pytest
from playwright.sync_api import Browser, Page, expect

from app.documents.gait_json import gait_content
from core.gait.held_feet import HeldFeet
from tests.support.held_gaits import lifting, wave
from tests.support.page.opened import opened_page
from tests.support.studio_process import StudioProcess, wait_for

pytestmark = pytest.mark.heavy

LIFTED = replace(lifting("hexapod", (1, 4)), name="Lifted", held=HeldFeet())
FOUR = replace(wave("hexapod", (1, 4), phase_knots=3, closing_knots=3), name="On four feet")


@pytest.fixture(scope="module")
def made(studio: StudioProcess) -> dict[str, str]:
    """Ids of the gaits by their names."""
    answers = [studio.ask("POST", "/api/gaits", gait_content(gait)) for gait in (LIFTED, FOUR)]
    return {answer.content["name"]: answer.content["id"] for answer in answers}


@pytest.fixture
def page(browser: Browser, studio: StudioProcess, made: dict[str, str]) -> Iterator[Page]:
    with opened_page(browser, studio.url, 1280, 720) as opened:
        expect(opened.get_by_label("Gait name")).not_to_have_value("")
        yield opened


def opened_gait(page: Page, name: str) -> None:
    page.get_by_role("list", name="Gaits").get_by_role("button", name=name).click()
    expect(page.get_by_label("Gait name")).to_have_value(name)


def held(studio: StudioProcess, gait_id: str) -> Any:
    return studio.ask("GET", f"/api/gaits/{gait_id}").content.get("held")


def test_holding_feet_up_makes_a_motion_of_a_gait_that_ends_in_the_air(
    page: Page, studio: StudioProcess, made: dict[str, str]
) -> None:
    opened_gait(page, "Lifted")
    expect(page.get_by_text("or hold it up").first).to_be_visible()
    page.get_by_text(re.compile("^More")).click()
    field = page.get_by_label("Held up at end")
    field.fill("1 9")
    field.press("Enter")
    expect(page.get_by_text("“1 9” is not valid. Type feet from 1 to 6")).to_be_visible()
    field.fill("4, 1")
    field.press("Enter")
    wait_for(lambda: held(studio, made["Lifted"]) == {"start": [], "end": [1, 4]}, "held up", 60)
    field.press("Tab")
    expect(field).to_have_value("1 4")
    expect(page.get_by_text("Plan margin")).to_be_visible()
    expect(page.get_by_text("Feet 1 and 4 are held up at the end.").first).to_be_attached()


def test_a_drawn_gait_keeps_its_phases_and_its_held_feet_when_it_is_turned(
    page: Page, studio: StudioProcess, made: dict[str, str]
) -> None:
    opened_gait(page, "On four feet")
    expect(page.get_by_label("Phase length", exact=True)).to_have_value("3")
    page.get_by_text("More: ").first.click()
    page.get_by_label("Direction", exact=True).select_option("2")
    wait_for(lambda: held(studio, made["On four feet"]) == {"start": [2, 5], "end": [2, 5]}, "turned", 60)
    expect(page.get_by_label("Held up at start")).to_have_value("2 5")
    expect(page.get_by_label("Phase length", exact=True)).to_have_value("3")
