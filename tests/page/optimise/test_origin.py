"""Where a motion comes from, as the page says it: imported files, results, and results of old versions."""

from __future__ import annotations

import re
from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, FilePayload, Locator, Page, expect

from tests.support.page.opened import opened_page
from tests.support.studio_process import StudioProcess

pytestmark = pytest.mark.heavy


@pytest.fixture
def page(browser: Browser, studio: StudioProcess) -> Iterator[Page]:
    with opened_page(browser, studio.url, 1280, 800) as opened:
        expect(opened.get_by_role("status", name="Verdict")).to_contain_text("Plan margin")
        yield opened


def origin(page: Page) -> Locator:
    return page.get_by_role("note", name="Origin of the motion")


def files_of(studio: StudioProcess, gait: str, stem: str) -> list[FilePayload]:
    """A gait's trajectory and companion, as a person chooses them."""
    forms = {"csv": (".csv", "text/csv"), "companion": (".footfall.json", "application/json")}
    return [
        {"name": stem + suffix, "mimeType": kind, "buffer": studio.blob(f"/api/gaits/{gait}/export/{form}")}
        for form, (suffix, kind) in forms.items()
    ]


def choose_files(page: Page, files: list[FilePayload]) -> None:
    with page.expect_file_chooser() as choosing:
        page.get_by_role("button", name="New", exact=True).click()
        page.get_by_role("menuitem", name="Import…").click()
    choosing.value.set_files(files)


def test_a_trajectory_is_chosen_with_its_companion_and_optimise_replaces_it(
    page: Page, studio: StudioProcess
) -> None:
    files = files_of(studio, "walk", "tuesday")
    choose_files(page, files)
    expect(page.get_by_label("Gait name")).to_have_value("tuesday")
    expect(origin(page)).to_have_text(
        "This motion was recorded in tuesday.csv. Optimise replaces the motion."
    )
    expect(page.get_by_role("status", name="Verdict")).to_contain_text("Plan recorded")
    assert studio.blob("/api/gaits/tuesday/export/csv") == files[0]["buffer"]
    assert studio.blob("/api/gaits/tuesday/export/companion") == files[1]["buffer"]
    page.get_by_role("button", name="Optimise", exact=True).click()
    expect(page.get_by_title("The recorded motion of tuesday.csv was set aside")).to_be_visible()
    expect(origin(page)).not_to_contain_text("Plan recorded")
    page.get_by_role("button", name=re.compile("^Undo")).click()
    expect(origin(page)).to_have_text(
        "This motion was recorded in tuesday.csv. Optimise replaces the motion."
    )


def test_a_result_is_named_until_the_gait_is_another_one(page: Page) -> None:
    page.get_by_role("list", name="Gaits").get_by_role(
        "button", name=re.compile(r"^Amble 10 mm(?!,)")
    ).click()
    expect(page.get_by_label("Gait name")).to_have_value("Amble 10 mm")
    expect(origin(page)).to_be_hidden()
    page.get_by_role("button", name="Optimise", exact=True).click()
    expect(origin(page)).to_have_text(re.compile(r"^Optimised \d\d:\d\d in \d+ ms\.$"))
    step = page.get_by_role("spinbutton", name="Step", exact=True)
    step.fill("9")
    step.press("Enter")
    expect(origin(page)).to_have_text(
        re.compile(r"for another version of this gait\. The result is out of date\.$")
    )
    page.get_by_role("button", name=re.compile("^Undo")).click()
    expect(origin(page)).to_have_text(re.compile(r"^Optimised \d\d:\d\d in \d+ ms\.$"))


def test_a_companion_alone_is_refused_with_what_is_missing(page: Page, studio: StudioProcess) -> None:
    choose_files(page, files_of(studio, "walk-manual-0", "alone")[1:])
    alert = page.get_by_role("alert").filter(
        has_text="“alone.footfall.json” has only the metadata of a trajectory"
    )
    expect(alert).to_contain_text("Also choose the CSV file of the trajectory.")
