"""Arming on the page: somebody has to say who they are first."""

from __future__ import annotations

import re

import pytest
from playwright.sync_api import Browser, expect

from tests.support.page.opened import opened_page
from tests.support.studio_process import StudioProcess

pytestmark = pytest.mark.heavy


def test_a_name_is_asked_for_before_the_robot_is_armed(browser: Browser, studio: StudioProcess) -> None:
    with opened_page(browser, studio.url, 1280, 900) as page:
        page.get_by_role("tab", name="Run").click()
        page.get_by_role("button", name="Connect", exact=True).click()
        status = page.get_by_role("status", name="Robot")
        expect(status).to_contain_text("disarmed")
        arm = page.get_by_role("button", name="Arm", exact=True)
        arm.click()
        asked = page.get_by_role("dialog", name="Who is working here?")
        asked.get_by_role("button", name="Cancel").click()
        expect(status).to_contain_text("disarmed")
        arm.click()
        asked.get_by_label("Your name").fill("Ada")
        asked.get_by_role("button", name="Continue").click()
        expect(status).to_contain_text("armed")
        expect(page.get_by_role("button", name=re.compile("Ada"))).to_be_visible()
