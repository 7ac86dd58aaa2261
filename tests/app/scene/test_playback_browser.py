"""The playback clock and the floor marks' geometry, run in a browser with a clock of the test's own."""

from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Page

from app.scene import Scenes
from tests.support.page.preview_page import preview_application
from tests.support.page.serving import serving

SETUP = """async () => {
  const { Playback } = await import("/static/preview/playback.js");
  window.overlay = await import("/static/preview/overlay.js");
  window.make = (options) => {
    const clock = { now: 0, waiting: [] };
    const playback = new Playback({
      duration: 10, step: 0.4, now: () => clock.now,
      requestFrame: (callback) => clock.waiting.push(callback), cancelFrame: () => { clock.waiting = []; },
      ...options,
    });
    const advance = (seconds) => {
      clock.now += seconds * 1000;
      for (const callback of clock.waiting.splice(0)) callback();
    };
    const seen = [];
    for (const type of ["time", "state", "end"]) {
      playback.addEventListener(type, (event) => seen.push([type, event.detail.cause]));
    }
    return { playback, advance, seen };
  };
}"""


@pytest.fixture(scope="module")
def page(browser: Browser) -> Iterator[Page]:
    with serving(preview_application(Scenes())) as host:
        page = browser.new_page()
        page.route("**/viser/**", lambda route: route.abort())
        page.goto(f"http://{host}/poses-page-that-is-not-there")
        page.evaluate(SETUP)
        yield page
        page.close()


def times(page: Page, script: str) -> object:
    return page.evaluate("() => { const { playback, advance, seen } = make(); " + script + " }")


def test_time_follows_the_clock_at_the_speed_that_is_set(page: Page) -> None:
    script = "playback.play(); advance(1); playback.setSpeed(10); advance(0.25); return playback.time;"
    assert times(page, script) == pytest.approx(3.5)


def test_it_stops_at_the_end_and_plays_again_from_the_start(page: Page) -> None:
    script = """playback.setTime(9.5); playback.play(); advance(2);
      const stopped = [playback.time, playback.playing]; playback.play(); advance(0.5);
      return [...stopped, playback.time, seen.some(([type]) => type === "end")];"""
    assert times(page, script) == [10, False, pytest.approx(0.5), True]


def test_a_loop_wraps_by_the_time_that_ran_over(page: Page) -> None:
    script = (
        "playback.setLoop([6, 2]); playback.setTime(5); playback.play(); advance(2); return playback.time;"
    )
    assert times(page, script) == pytest.approx(3.0)


def test_a_step_pauses_and_goes_to_whole_samples(page: Page) -> None:
    script = """playback.setTime(1.0); playback.play(); playback.step(1); const forwards = playback.time;
      playback.step(-100); return [forwards, playback.time, playback.playing];"""
    assert times(page, script) == [pytest.approx(1.6), 0, False]


@pytest.mark.parametrize(("wanted", "given"), [("0.01", 0.1), ("99", 10), ("2.5", 2.5), ("NaN", 1)])
def test_speed_is_held_between_a_tenth_and_ten(page: Page, wanted: str, given: float) -> None:
    assert times(page, f"return playback.setSpeed({wanted});") == given


def test_a_shorter_plan_holds_the_playhead_and_says_so(page: Page) -> None:
    script = "playback.setTime(8); playback.setPlan(5, 0.2); return [playback.time, seen.at(-2)];"
    assert times(page, script) == [5, ["time", "plan"]]


def test_an_empty_plan_does_not_play(page: Page) -> None:
    assert times(page, "playback.setPlan(0); playback.play(); return playback.playing;") is False


def test_hull_leaves_out_inner_feet(page: Page) -> None:
    corners = page.evaluate("overlay.hull([[0, 0], [2, 0], [1, 0.5], [2, 2], [0, 2], [1, 0]])")
    assert sorted(corners) == [[0, 0], [0, 2], [2, 0], [2, 2]]


@pytest.mark.parametrize(("time", "sample"), [(-1, 0), (0.39, 0), (0.4, 1), (0.79, 1), (9, 2)])
def test_the_current_sample_is_the_last_one_not_after_the_playhead(
    page: Page, time: float, sample: int
) -> None:
    assert page.evaluate("time => overlay.sampleAt([0, 0.4, 0.8], time)", time) == sample


def test_a_slow_way_that_is_closed_while_it_waits_is_not_opened_again(page: Page) -> None:
    opened = """async () => {
      const { ServerRoute } = await import("/static/preview/server_route.js");
      const [{ WebSocket, setTimeout, clearTimeout }, sockets, waits] = [window, [], new Map()];
      window.WebSocket = class { constructor() { sockets.push(this); } close() {} };
      window.setTimeout = (callback) => { waits.set(waits.size + 1, callback); return waits.size; };
      window.clearTimeout = (timer) => waits.delete(timer);
      const route = new ServerRoute("deltawalker");
      sockets[0].onclose();
      if (CLOSED) route.close();
      waits.forEach((callback) => callback());
      Object.assign(window, { WebSocket, setTimeout, clearTimeout });
      return sockets.length;
    }"""
    assert page.evaluate(opened.replace("CLOSED", "false")) == 2
    assert page.evaluate(opened.replace("CLOSED", "true")) == 1


def test_rings_of_a_track_follow_a_plan_of_another_length(page: Page) -> None:
    places = page.evaluate(
        """async () => {
          const { Tracks } = await import("/static/preview/tracks.js");
          const middles = [];
          const tell = (points) => middles.push((points[0] + points[60]) / 2);
          const tracks = new Tracks({
            node: () => ({}), updateMessage: () => ({}),
            moveSegments: (_, points) => { tell(points); return []; },
          });
          const track = { feet: [[[0, 0], [1, 0]]], filled: [[false, false]], colours: ["#ff0000"] };
          tracks.set([{ ...track, shares: [0, 1], playing: [0, 1] }]);
          tracks.messages(0, 10, 0);
          for (const duration of [10, 20, 20]) tracks.messages(2, duration, 0);
          return middles;
        }"""
    )
    assert places == pytest.approx([0.2, 0.1])
