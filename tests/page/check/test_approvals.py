"""The check on the page: warnings want a tick, an edit takes the approval away, approvals are compared.

Where an approval lapsed without an edit, the page says whose it was and why.
"""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Page, expect

from app.gaits.approvals import ApprovalRequest
from app.gaits.service import GaitService
from app.store.database import DATABASE, Database
from app.store.gait_files import GaitFiles
from tests.support.page.opened import look, opened_page
from tests.support.simulated_walk import GAIT, no_solver
from tests.support.studio_process import StudioProcess, running_studio

pytestmark = pytest.mark.heavy


def check(page: Page) -> None:
    page.get_by_role("button", name="Check", exact=True).click()
    expect(page.get_by_role("list", name="Findings")).to_be_visible()


def test_warnings_want_a_tick_and_the_approvals_of_a_gait_are_compared(
    browser: Browser, studio: StudioProcess
) -> None:
    with opened_page(browser, studio.url, 1280, 720, gait="walk-manual-0") as page:
        page.get_by_role("button", name=re.compile("Operator")).click()
        page.get_by_role("textbox", name="Your name").fill("Ada")
        page.keyboard.press("Enter")
        page.get_by_role("tab", name="Check & approve").click()
        check(page)
        approve = page.get_by_role("button", name="Approve", exact=True)
        tick = page.get_by_role("checkbox", name=re.compile("I have seen"))
        expect(approve).to_have_attribute("aria-disabled", "true")
        look(page, "warnings")
        tick.check()
        expect(approve).not_to_have_attribute("aria-disabled", "true")
        approve.click()
        expect(page.get_by_role("tab", name="Run", selected=True)).to_be_visible()
        page.get_by_role("tab", name="Check & approve").click()
        approvals = page.get_by_role("list", name="Approvals")
        expect(approvals.get_by_text("valid", exact=True)).to_be_visible()
        expect(tick).to_be_hidden()
        bound = page.get_by_role("spinbutton", name="Stop bound", exact=True)
        bound.fill("0.9")
        bound.press("Enter")
        gone = page.get_by_text(re.compile("the gait changed .*, so it is no longer approved", re.IGNORECASE))
        expect(gone).to_be_visible()
        expect(approvals.get_by_text("no longer valid")).to_be_visible()
        check(page)
        expect(tick).not_to_be_checked()
        tick.check()
        approve.click()
        expect(page.get_by_role("tab", name="Run", selected=True)).to_be_visible()
        page.get_by_role("tab", name="Check & approve").click()
        expect(approvals.get_by_role("listitem")).to_have_count(2)
        approvals.get_by_role("button", name=re.compile("Compare")).last.click()
        changed = page.get_by_role("region", name="What changed")
        expect(changed).to_contain_text("Stop bound 1.0 s → 0.9 s")
        expect(changed).to_contain_text("Other waypoints")
        changed.scroll_into_view_if_needed()
        look(page, "approvals")


def keep_approval_of_other_waypoints(data: Path) -> None:
    """Keeps an approval by Ada as a program kept it that made other waypoints from the gait."""
    database = Database(data / DATABASE)
    service = GaitService(GaitFiles(data), database, lambda gait: no_solver)
    service.check(GAIT)
    approval = service.approve(GAIT, ApprovalRequest("Ada", accept_warnings=True)).approval_text
    assert approval is not None
    other = json.loads(approval) | {"waypoints_hash": "0" * 64, "verdict_hash": "0" * 64}
    with database.writing() as connection:
        connection.execute("UPDATE open_gait SET approval=? WHERE gait=?", (json.dumps(other), GAIT))
    database.close()


def test_the_page_says_whose_approval_an_update_of_the_program_took_away_and_why(
    browser: Browser, tmp_path: Path
) -> None:
    keep_approval_of_other_waypoints(tmp_path)
    with (
        running_studio(tmp_path) as studio,
        opened_page(browser, studio.url, 1280, 720, gait=GAIT) as page,
    ):
        page.get_by_role("tab", name="Check & approve").click()
        said = page.get_by_text(
            re.compile(r"waypoints are not the approved ones .* by Ada of [\d-]+ is no longer")
        )
        expect(said).to_be_visible()
        expect(page.get_by_text("out of date").first).to_be_visible()
        expect(page.get_by_text("before this edit")).to_have_count(0)
        look(page, "lapsed")
