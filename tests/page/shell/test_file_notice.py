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
        expect(page.locator("#toasts")).to_contain_text("cut-off.json")
        page.get_by_role("button", name="Delete the file").click()
        expect(broken).to_have_count(0)
        notice.get_by_role("button", name="Take it over").click()
        expect(notice).to_be_hidden()
        assert studio.document(made["id"])["notes"] == "theirs"
        page.close()
