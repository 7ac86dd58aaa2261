"""Merging and stop bound on the page: what they cost, and that a change takes check and approval away."""

from __future__ import annotations

import pytest
from playwright.sync_api import Browser, expect

from tests.support.page.opened import opened_page
from tests.support.studio_process import StudioProcess

pytestmark = pytest.mark.heavy


def test_the_stop_bound_says_what_it_costs_and_a_change_takes_the_approval(
    browser: Browser, studio: StudioProcess
) -> None:
    assert studio.ask("POST", "/api/gaits/walk/check").content["passed"]
    assert studio.ask("POST", "/api/gaits/walk/approve", {"by": "Ada", "accept_warnings": True}).status == 200
    before = studio.ask("GET", "/api/gaits/walk/view").content
    with opened_page(browser, studio.url, 1280, 720) as page:
        page.get_by_role("tab", name="Check & approve").click()
        table = page.get_by_role("table", name="Time on the robot")
        expect(table.get_by_role("row")).to_have_count(4)
        expect(table.locator("tr[aria-current] th")).to_have_text("1.0 s ✓")
        expect(page.get_by_role("status", name="Verdict")).to_contain_text("Approved by Ada")
        bound = page.get_by_role("spinbutton", name="Stop bound", exact=True)
        bound.fill("")
        bound.press("Enter")
        sending = page.get_by_role("group", name="How the plan is sent")
        expect(page.get_by_text("so it is no longer approved")).to_be_visible()
        shown = studio.ask("GET", "/api/gaits/walk/view").content
        assert shown["document"]["options"]["stop_bound"] is None
        assert shown["plan"]["waypoints_hash"] != before["plan"]["waypoints_hash"]
        assert shown["plan"]["robot_seconds"] < before["plan"]["robot_seconds"]
        words = f"{shown['plan']['waypoint_count']} waypoints from {len(shown['plan']['times'])} samples"
        expect(sending).to_contain_text(words)
        bound.fill("0.3")
        bound.press("Enter")
        expect(sending).to_contain_text("it must lie between 0.8 and 10 s")
