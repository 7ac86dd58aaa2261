"""A gait that cannot be shown: the list marks it, says why, and has the way out."""

from __future__ import annotations

import sqlite3
from contextlib import closing
from pathlib import Path

import pytest
from playwright.sync_api import Browser, expect

from tests.support.studio_process import running_studio

pytestmark = pytest.mark.heavy


def edited_then_spoilt(data: Path) -> str:
    """Edits a built-in and a saved gait in a studio that ends, and spoils both; gives the saved one's id."""
    with running_studio(data) as studio:
        made: str = studio.ask("POST", "/api/gaits?copy_of=walk&name=Mine", {}).content["id"]
        for gait in ("walk", made):
            for notes in ("one", "two"):
                document = {**studio.document(gait), "notes": notes}
                assert studio.ask("PUT", f"/api/gaits/{gait}", document).status == 200
    with closing(sqlite3.connect(data / "studio.sqlite3")) as connection, connection:
        connection.execute(
            "UPDATE history SET document=replace(document, 'deltawalker', 'centipede') "
            "WHERE position=(SELECT last FROM open_gait WHERE open_gait.gait=history.gait)"
        )
    return made


def test_both_ways_out_and_the_versions_that_keep_what_could_not_be_shown(
    browser: Browser, tmp_path: Path
) -> None:
    made = edited_then_spoilt(tmp_path)
    with running_studio(tmp_path) as studio:
        page = browser.new_page(viewport={"width": 1280, "height": 800})
        page.goto(studio.url)
        ways = {made: "Go back to the last state that can be shown", "walk": "Restore the original gait"}
        for gait, way in ways.items():
            row = page.locator(f'[data-gait="{gait}"]')
            expect(row).to_contain_text("unreadable")
            row.click()
            dialog = page.get_by_role("dialog")
            expect(dialog).to_contain_text("cannot be shown")
            expect(dialog).to_contain_text("centipede")
            expect(dialog.get_by_role("button", name="Delete")).to_have_count(int(gait == made))
            dialog.get_by_role("button", name=way).click()
            expect(dialog).to_have_count(0)
            expect(row).not_to_contain_text("unreadable")
            expect(row).to_have_attribute("aria-current", "true")
        assert studio.document(made)["notes"] == "one"
        assert studio.document("walk")["notes"] == ""
        page.get_by_role("button", name="Undo").click()
        expect(page.get_by_role("button", name="Redo")).to_be_enabled()
        assert studio.document("walk")["notes"] == "one"
        page.get_by_role("button", name="Versions").click()
        version = page.get_by_role("option", name="cannot be shown")
        version.click()
        expect(page.get_by_role("region", name="Difference")).to_contain_text("cannot show the document")
        expect(page.get_by_role("button", name="Restore")).to_have_attribute("aria-disabled", "true")
        page.close()
