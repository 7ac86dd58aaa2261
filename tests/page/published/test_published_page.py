"""The published tables on the page: one is chosen and computed, and a row opens and is simulated."""

from __future__ import annotations

import re
from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Page, expect

from app.published.entries import entries_of
from app.published.figures import figures_content
from app.store.database import Database
from app.store.tables.published_store import PublishedStore
from core.published.tables import Kind, published_table
from tests.support.page.axe import require_no_finding
from tests.support.page.drawers import open_drawer
from tests.support.page.opened import look, opened_page
from tests.support.studio_process import StudioProcess, running_studio

pytestmark = pytest.mark.heavy

MISSING, FALLS = "walk-0", "amble-1"
FELL = "Our gait falls at 3.2 s."


@pytest.fixture(scope="module")
def studio(tmp_path_factory: pytest.TempPathFactory) -> Iterator[StudioProcess]:
    """A studio with figures of ours for all rows of T Table 4.1 but one."""
    data = tmp_path_factory.mktemp("data")
    database = Database(data / "studio.sqlite3")
    store, table = PublishedStore(database), published_table("t4-1")
    definitions: dict[str, dict[str, float | None]] = {Kind.STANDING.value: {"feet_mm": 2.25}}
    for row in table.rows:
        if row.id != MISSING:
            (own,) = entries_of(table, row, None)
            store.put(own.key, 0.0, figures_content(definitions, FELL if row.id == FALLS else ""))
    database.close()
    with running_studio(data) as running:
        yield running


def choose_table(page: Page) -> None:
    open_drawer(page, "Papers")
    tables = page.get_by_role("list", name="Published tables")
    expect(tables.get_by_role("button")).to_have_count(15)
    tables.get_by_role("button", name="T 4.1").click()


def test_a_table_is_computed_and_a_row_of_it_is_simulated(browser: Browser, studio: StudioProcess) -> None:
    with opened_page(browser, studio.url, 1280, 800) as page:
        choose_table(page)
        table = page.get_by_role("table")
        walk, amble = (table.get_by_role("row", name=f"{name}, version") for name in ("Walk", "Amble"))
        expect(table.get_by_role("columnheader", name="thesis")).to_be_visible()
        expect(walk.nth(1).get_by_role("cell").nth(0)).to_have_text("3.3")
        expect(walk.nth(1).get_by_role("cell").nth(1)).to_have_text("▲2.25, better")
        expect(amble.nth(2).get_by_role("cell").nth(1)).to_have_text("▼2.25, worse")
        expect(amble.nth(1)).to_contain_text(FELL)
        expect(walk.first.get_by_role("cell").nth(1)).to_have_text(re.compile(r"\d"))
        expect(page.get_by_role("status", name="Computed")).to_have_text("Ours: 9 of 9")
        expect(page.get_by_role("button", name=re.compile("^Compute"))).to_have_count(0)

        walk.first.get_by_role("button").press("ArrowDown")
        expect(walk.nth(1).get_by_role("button")).to_be_focused()
        page.keyboard.press("ArrowUp")
        page.keyboard.press("Enter")
        expect(page.get_by_alt_text("Paths of the feet of Walk, version 0")).to_be_visible()
        look(page, "published")
        require_no_finding(page, "published table")
        page.reload()
        row = page.get_by_role("group", name="Walk, version 0")
        expect(row.get_by_role("button", name="Published motion")).to_have_attribute("aria-disabled", "true")
        row.get_by_role("button", name="Simulate").click()
        expect(page.get_by_label("Gait name")).to_have_value(re.compile("T 4.1"))
        expect(page.get_by_role("tab", name="Simulate", selected=True)).to_be_visible()
        expect(page.get_by_role("button", name="Cancel simulation")).to_be_visible()


def test_a_folder_without_the_published_data_is_refused_beside_its_field_and_a_table_is_copied(
    browser: Browser, studio: StudioProcess
) -> None:
    with opened_page(browser, studio.url, 820, 1180) as page:
        choose_table(page)
        assert page.evaluate("document.documentElement.scrollWidth") == 820
        page.context.grant_permissions(["clipboard-read"])
        page.get_by_role("button", name="Copy table").click()
        lines = page.evaluate("navigator.clipboard.readText()").splitlines()
        assert lines[0].startswith("Gait\tVersion\terror by the table, thesis, mm\t")
        assert lines[2].startswith("Walk\t1\t3.3\t2.25\t")
        assert len(lines) == 10
        page.get_by_role("button", name="All tables").click()
        field = page.get_by_role("textbox", name="Folder with the published data")
        field.fill("/no/such/folder")
        field.press("Enter")
        expect(field).to_have_attribute("aria-invalid", "true")
        expect(page.get_by_role("alert").filter(has_text="/no/such/folder")).to_be_visible()
        page.get_by_role("tab", name="Design").click()
        expect(field).to_be_hidden()
        expect(page.get_by_role("status", name="Verdict")).to_be_visible()
