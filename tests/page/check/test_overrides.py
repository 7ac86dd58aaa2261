"""Approving in spite of errors on the page: offered where it may be, asked for with a reason, and shown."""

from __future__ import annotations

import re

import pytest
from playwright.sync_api import Browser, expect

from tests.support.page.opened import look, opened_page
from tests.support.studio_process import StudioProcess

pytestmark = pytest.mark.heavy

GAIT = "s-gait-manual-1"
REASON = "It walked on the real robot."
NOTE = f"Approved in spite of: balance, contact, path balance, travel, by Ada: {REASON}"


def test_errors_are_overridden_by_keyboard_and_the_page_shows_it_as_long_as_it_stands(
    browser: Browser, studio: StudioProcess
) -> None:
    with opened_page(browser, studio.url, 1280, 720, gait=GAIT) as page:
        page.get_by_role("button", name=re.compile("Operator")).click()
        page.get_by_role("textbox", name="Your name").fill("Ada")
        page.keyboard.press("Enter")
        page.get_by_role("tab", name="Check & approve").click()
        page.get_by_role("button", name="Check", exact=True).click()
        findings = page.get_by_role("list", name="Findings").get_by_role("listitem")
        errors = findings.filter(has_text="Error: ")
        expect(errors.first).to_be_visible()
        expect(errors.filter(has_text="may be overridden")).to_have_count(errors.count())
        expect(findings.filter(has_text="Warning: ").filter(has_text="may be overridden")).to_have_count(0)
        page.get_by_role("checkbox", name=re.compile("I have seen")).check()
        approve = page.get_by_role("button", name="Approve", exact=True)
        approve.focus()
        page.keyboard.press("Enter")
        dialog = page.get_by_role("dialog", name="Approve in spite of these errors?")
        reason = dialog.get_by_role("textbox", name="Reason")
        expect(reason).to_be_focused()
        expect(dialog.get_by_role("listitem")).to_have_count(errors.count())
        page.keyboard.press("Escape")
        expect(dialog).to_be_hidden()
        expect(approve).to_be_focused()
        page.keyboard.press("Enter")
        page.keyboard.type("  ")
        page.keyboard.press("Enter")
        expect(dialog).to_be_visible()
        reason.fill(REASON)
        look(page, "override")
        page.keyboard.press("Enter")
        expect(page.get_by_role("tab", name="Run", selected=True)).to_be_visible()
        note = page.get_by_role("note").filter(visible=True)
        expect(note).to_have_text(NOTE)
        page.get_by_role("tab", name="Check & approve").click()
        expect(note).to_have_text(NOTE)
        approvals = page.get_by_role("list", name="Approvals")
        expect(approvals).to_contain_text(f"In spite of: balance, contact, path balance, travel. {REASON}")
        bound = page.get_by_role("spinbutton", name="Stop bound", exact=True)
        bound.fill("0.9")
        bound.press("Enter")
        expect(page.get_by_text(re.compile("the gait changed .*, so it is no longer", re.I))).to_be_visible()
        expect(note).to_have_count(0)
