"""The list of faults in the Robot section: there with the emulated robot, and what it does is shown."""

import pytest
from playwright.sync_api import Browser, expect

from tests.support.page.opened import look, opened_page
from tests.support.page.robot_panel import name
from tests.support.studio_process import running_studio

pytestmark = pytest.mark.heavy


def test_a_fault_is_chosen_and_its_effect_is_shown(
    browser: Browser, tmp_path_factory: pytest.TempPathFactory
) -> None:
    with (
        running_studio(tmp_path_factory.mktemp("data")) as studio,
        opened_page(browser, studio.url, 1280, 720) as page,
    ):
        name(page, "Ada")
        page.get_by_text("Faults of the emulated robot").click()
        strike = page.get_by_role("button", name="Cause this fault")
        expect(strike).to_have_attribute("title", "Connect the emulated robot first.")
        page.get_by_role("button", name="Connect", exact=True).click()
        expect(page.get_by_role("button", name="Arm", exact=True)).not_to_have_attribute(
            "aria-disabled", "true"
        )
        page.get_by_role("combobox", name="Fault", exact=True).select_option("unplug")
        strike.scroll_into_view_if_needed()
        look(page, "faults")
        strike.click()
        expect(page.get_by_role("status", name="Robot")).to_contain_text("hung up")
