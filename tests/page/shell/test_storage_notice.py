"""The page says that the database is damaged, what the last good backup is, and why an edit is refused."""

from __future__ import annotations

import re
import sqlite3
from contextlib import closing
from pathlib import Path

import pytest
from playwright.sync_api import Browser, expect

from app.store.backups import DAILY, make_backup
from tests.support.page.opened import opened_page
from tests.support.spoilt_database import fill, overwrite_table
from tests.support.studio_process import running_studio

pytestmark = pytest.mark.heavy


def test_a_damaged_database_is_told_for_as_long_as_the_page_is_open(browser: Browser, tmp_path: Path) -> None:
    good = make_backup(fill(tmp_path), DAILY).path.name
    overwrite_table(tmp_path / "studio.sqlite3", "job")
    with (
        running_studio(tmp_path) as studio,
        opened_page(browser, studio.url, 1024, 768) as page,
    ):
        notice = page.locator("#storage-notice")
        expect(notice).to_contain_text(good)
        expect(notice).to_contain_text("footfall restore")
        cell = page.get_by_role("gridcell", name=re.compile("^foot 1, sample 3: "))
        expect(cell).to_have_accessible_name(re.compile("stance"))
        cell.click()
        expect(page.get_by_text(re.compile("^Not accepted: .*Nothing can be stored"))).to_be_visible()
        expect(cell).to_have_accessible_name(re.compile("swing"))
        expect(notice).to_be_visible()


def test_nothing_is_told_where_all_is_well(browser: Browser, tmp_path: Path) -> None:
    fill(tmp_path, 1)
    with (
        running_studio(tmp_path) as studio,
        opened_page(browser, studio.url, 1024, 768) as page,
    ):
        expect(page.get_by_role("list", name="Gaits").get_by_role("listitem").first).to_be_visible()
        expect(page.locator("#storage-notice")).to_be_hidden()


def test_an_entry_that_cannot_be_read_is_set_aside_and_brought_back(browser: Browser, tmp_path: Path) -> None:
    path = fill(tmp_path, 1)
    with closing(sqlite3.connect(path)) as connection, connection:
        connection.execute("INSERT INTO trial(id, made, content) VALUES('spoilt', 1.0, '{')")
    with (
        running_studio(tmp_path) as studio,
        opened_page(browser, studio.url, 1024, 768) as page,
    ):
        notice = page.locator("#storage-notice")
        expect(notice).to_contain_text("1 entry of the database cannot be read")
        page.get_by_role("button", name="Trials", exact=True).click()
        expect(page.get_by_role("list", name="Trials")).to_contain_text("The trial “spoilt” cannot be read")
        notice.get_by_text("Show them").click()
        notice.get_by_role("button", name="Set aside the trial spoilt").click()
        expect(notice).to_be_hidden()
        page.get_by_role("button", name="Undo", exact=True).last.click()
        expect(notice).to_contain_text("1 entry of the database cannot be read")
