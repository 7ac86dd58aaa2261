"""A person at the keyboard: Tab to a control, and nothing else."""

from __future__ import annotations

from playwright.sync_api import Page

FOCUSED = """() => {
  const { activeElement: element } = document;
  if (element === document.body) return "";
  const words = element.getAttribute("aria-label") ?? element.labels?.[0]?.textContent ?? element.textContent;
  return words.trim();
}"""
STOPS = """(part) => {
  const found = [...part.querySelectorAll("a[href], button, input, select, textarea, summary, [tabindex]")];
  return found.filter((element) => element.tabIndex >= 0 && !element.disabled
    && element.checkVisibility({ visibilityProperty: true })).length;
}"""
MOST_TABS = 90


def focused(page: Page) -> str:
    """The name of what has the focus."""
    name: str = page.evaluate(FOCUSED)
    return name


def tab_to(page: Page, name: str, *, back: bool = False, most: int = MOST_TABS) -> None:
    """Presses Tab until a control with this name has the focus.

    Args:
        page: with the focus anywhere.
        name: how the control's name begins.
        back: with Shift.
        most: how often, at most.
    """
    passed: list[str] = []
    for _ in range(most):
        page.keyboard.press("Shift+Tab" if back else "Tab")
        passed.append(focused(page))
        if passed[-1].startswith(name):
            return
    raise AssertionError(f"{name} is not among the next {most} tab stops: {passed}")


def tab_stops(page: Page, selector: str) -> int:
    """How often Tab stops in a part of the page."""
    count: int = page.locator(selector).evaluate(STOPS)
    return count
