"""What a run will be, on the page: each line can be read, also a long one."""

from __future__ import annotations

import pytest
from playwright.sync_api import Browser, Route, expect

from tests.support.page.opened import opened_page
from tests.support.studio_process import StudioProcess

pytestmark = pytest.mark.heavy

HEIGHTS = "list => [...list.querySelectorAll('dt')].map(name => name.getBoundingClientRect().height)"
OVER = (
    "list => [...list.querySelectorAll('dt, dd')].filter(part => part.scrollWidth > part.clientWidth).length"
)


@pytest.mark.parametrize(("width", "height"), [(1280, 800), (1024, 768)])
def test_the_names_stand_in_one_line_beside_a_long_reason(
    browser: Browser, studio: StudioProcess, width: int, height: int
) -> None:
    def altered(route: Route) -> None:
        answer = route.fetch()
        slow = {"stop_seconds": 1.31, "scan_seconds": 0.52, "start_distance_mm": 5.0, "start_moves": 2}
        route.fulfill(response=answer, json=answer.json() | slow)

    with opened_page(browser, studio.url, width, height) as page:
        page.route("**/api/gaits/*/run?*", altered)
        page.reload()
        page.get_by_role("tab", name="Run").click()
        expect(page.get_by_text("To the start pose")).to_be_visible()
        rows = page.locator("#robot dl.summary")
        expect(rows.get_by_text("the slowest error scan of the firmware")).to_be_visible()
        assert len(set(rows.evaluate(HEIGHTS))) == 1
        assert rows.evaluate(OVER) == 0
