"""Gait files that cannot be opened or were changed outside the studio, as the page shows them."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from playwright.sync_api import Browser, expect

from tests.support.studio_process import running_studio

pytestmark = pytest.mark.heavy


def test_the_list_marks_files_and_the_page_offers_both_ways(browser: Browser, tmp_path: Path) -> None:
    with running_studio(tmp_path) as studio:
        made = studio.ask("POST", "/api/gaits?copy_of=walk&name=Shared%20walk", {}).content
        page = browser.new_page(viewport={"width": 1280, "height": 800})
        page.goto(studio.url)
        row = page.locator(f'[data-gait="{made["id"]}"]')
        row.click()
        notice = page.locator("#file-notice")
        expect(page.get_by_role("textbox", name="Gait name")).to_have_value("Shared walk")
        expect(notice).to_be_hidden()
        path = tmp_path / "gaits" / f"{made['id']}.json"
        path.write_text(json.dumps({**made["document"], "notes": "theirs"}))
        (tmp_path / "gaits" / "cut-off.json").write_text("{")
        expect(notice).to_be_visible()
        expect(row).to_contain_text("changed")
        broken = page.locator('[data-gait="cut-off"]')
        broken.click()
        dialog = page.get_by_role("dialog")
        expect(dialog).to_contain_text("cut-off.json is not JSON")
        dialog.get_by_role("button", name="Delete").click()
        expect(broken).to_have_count(0)
        notice.get_by_role("button", name="Use the file").click()
        expect(notice).to_be_hidden()
        assert studio.document(made["id"])["notes"] == "theirs"
        page.close()


def test_keep_mine_sets_the_other_file_aside_and_changes_nothing_else(
    browser: Browser, tmp_path: Path
) -> None:
    with running_studio(tmp_path) as studio:
        made = studio.ask("POST", "/api/gaits?copy_of=walk&name=Shared%20walk", {}).content
        gait = made["id"]
        path = tmp_path / "gaits" / f"{gait}.json"
        saved = path.read_text()
        unsaved = {**made["document"], "notes": "mine, not saved yet"}
        assert studio.ask("PUT", f"/api/gaits/{gait}", unsaved).status == 200
        page = browser.new_page(viewport={"width": 1280, "height": 800})
        page.goto(studio.url)
        row = page.locator(f'[data-gait="{gait}"]')
        row.click()
        notice = page.locator("#file-notice")
        expect(page.get_by_role("textbox", name="Gait name")).to_have_value("Shared walk")
        theirs = json.dumps({**made["document"], "notes": "theirs"})
        path.write_text(theirs)
        expect(notice).to_contain_text(f"{path.name} was changed outside the studio")
        before = studio.ask("GET", f"/api/gaits/{gait}/view").content
        assert studio.ask("POST", f"/api/gaits/{gait}/save").status == 409

        notice.get_by_role("button", name="Keep mine").click()
        expect(notice).to_be_hidden()
        expect(row).not_to_contain_text("changed")
        assert path.read_text() == saved
        assert [file.read_text() for file in (tmp_path / "set-aside").rglob("*.json")] == [theirs]
        after = studio.ask("GET", f"/api/gaits/{gait}/view").content
        assert after["document"] == before["document"] == unsaved
        assert after["undo"] == before["undo"]
        assert (before["outside"] is None, after["outside"]) == (False, None)
        assert studio.ask("POST", f"/api/gaits/{gait}/save").status == 200
        expect(page.locator("#toasts")).to_be_empty()
        expect(notice).to_be_hidden()
        assert json.loads(path.read_text())["notes"] == "mine, not saved yet"
        page.close()
