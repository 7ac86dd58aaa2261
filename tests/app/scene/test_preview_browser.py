"""The preview in a real browser: it fails when the way into Viser's client breaks."""

import time
from collections.abc import Iterator
from io import BytesIO

import numpy as np
import pytest
from PIL import Image
from playwright.sync_api import Browser, Page

from app.scene import Scenes
from tests.support.page.opened import scene_browser
from tests.support.page.preview_page import preview_application, walk
from tests.support.page.serving import serving, stop_under_clients

pytestmark = [pytest.mark.heavy, pytest.mark.alone]

START_MS = 60_000

PLAIN_LINES = """(name, pieces) => {
  let lines = null;
  preview.client.node(name)?.traverse(({ geometry }) => {
    if (geometry?.attributes?.instanceStart) lines ??= geometry;
  });
  if (!lines || lines.isInstancedBufferGeometry || lines.index.count !== pieces * 18) return null;
  const starts = lines.attributes.instanceStart;
  return Array.from({ length: starts.count }, (_, at) => [starts.getX(at), starts.getY(at), starts.getZ(at)]);
}"""
"""Where the pieces of a line begin, at each of their corners; null while they are drawn as instances."""


@pytest.fixture(scope="module")
def scenes() -> Iterator[Scenes]:
    scenes = Scenes()
    scenes.of("deltawalker")
    yield scenes
    stop_under_clients(scenes)


@pytest.fixture(scope="module")
def address(scenes: Scenes) -> Iterator[str]:
    with serving(preview_application(scenes)) as host:
        yield f"http://{host}/"


@pytest.fixture
def page(browser: Browser, address: str) -> Iterator[Page]:
    page = scene_browser(browser).new_page(viewport={"width": 800, "height": 500})
    errors: list[str] = []
    page.on("pageerror", lambda error: errors.append(str(error)))
    page.goto(address)
    page.wait_for_function("window.loaded === true", timeout=START_MS)
    yield page
    page.close()
    assert errors == []


def wait_for_foot(page: Page, foot: int, position: np.ndarray) -> None:
    """Waits until the client's own node of a foot stands within a micrometre of a place."""
    page.wait_for_function(
        """([name, wanted]) => {
          const at = preview.client.position(name);
          return at && Math.hypot(...at.map((value, axis) => value - wanted[axis])) < 1e-6;
        }""",
        arg=[f"/robot/leg{foot + 1}_foot", position.tolist()],
        timeout=START_MS,
    )


def test_a_scrubbed_playhead_moves_the_clients_own_nodes(page: Page) -> None:
    assert page.evaluate("preview.route") == "direct"
    plan = walk()
    for knot in (0, 7, plan.knot_count - 1):
        page.evaluate("time => playback.setTime(time)", float(plan.times[knot]))
        wait_for_foot(page, 2, plan.feet_world[knot, 2])


def test_playing_shows_new_poses_and_stops_at_the_end(page: Page) -> None:
    before = page.screenshot()
    page.evaluate("playback.setSpeed(10); playback.play()")
    page.wait_for_function("!playback.playing", timeout=START_MS)
    plan = walk()
    wait_for_foot(page, 0, plan.feet_world[-1, 0])
    assert page.evaluate("preview.posesShown") > 5
    assert page.screenshot() != before
    assert page.evaluate("playback.setSpeed(0.1); playback.play(); playback.time") < 0.1
    page.evaluate("playback.pause()")


def test_without_a_gpu_a_playing_robot_is_drawn_once_in_each_frame_of_the_page(page: Page) -> None:
    frames, drawn = page.evaluate(
        """() => new Promise((done) => {
          const inside = document.querySelector("iframe").contentWindow.__viserMutable;
          const { render } = inside.scene.__r3f.root.getState().gl.info;
          playback.setTime(0);
          playback.play();
          let [frames, before] = [0, null];
          const count = () => {
            before ??= render.frame;
            if (frames++ < 20) requestAnimationFrame(count);
            else { playback.pause(); done([frames - 1, render.frame - before]); }
          };
          requestAnimationFrame(() => requestAnimationFrame(count));
        })"""
    )
    # The client's own way would draw twice in a frame, or in every second one; what settles late adds a few.
    assert 0.75 * frames < drawn < 1.5 * frames


def test_polygon_is_drawn_on_the_floor_in_the_colour_of_its_margin(page: Page) -> None:
    for margin, colour in ((0.01, "0b7470"), (0.001, "7d5a00"), (-0.002, "b3145f")):
        page.evaluate(
            """margin => preview.setOverlay({
              times: [0], com: [[0, 0, 0.07]], margins: [margin], contact: [[true, true, true, false]],
              feet: [[[0.04, 0, 0], [0, 0.04, 0], [-0.04, 0, 0], [0, -0.04, 0.005]]] })""",
            margin,
        )
        page.wait_for_function(
            """colour => {
              let drawn = null;
              preview.client.node("/overlay/polygon")?.traverse((part) => {
                if (part.material?.color) drawn = part;
              });
              if (!drawn || !drawn.visible) return false;
              const points = drawn.geometry.attributes.position;
              return drawn.material.color.getHexString() === colour && points.count === 3;
            }""",
            arg=colour,
            timeout=START_MS,
        )


def test_without_a_gpu_lines_are_drawn_in_one_go_where_they_are_told_to_be(page: Page) -> None:
    if not page.evaluate("preview.client.drawsInSoftware"):
        pytest.skip("this browser draws with a GPU")
    page.evaluate("""() => preview.setOverlay({
      times: [0], com: [[0, 0, 0.07]], margins: [0.01], contact: [[true, true, true, false]],
      feet: [[[0.04, 0, 0], [0, 0.04, 0], [-0.04, 0, 0], [0, -0.04, 0.005]]] })""")
    moved = [0.01 * value for value in range(6)] * 3
    starts = page.wait_for_function(
        f"""points => {{
          const told = preview.client.moveSegments("/overlay/polygon_edge", Float32Array.from(points));
          return told.length ? null : ({PLAIN_LINES})("/overlay/polygon_edge", 3);
        }}""",
        arg=moved,
        timeout=START_MS,
    ).json_value()
    np.testing.assert_allclose(starts, np.tile([0.0, 0.01, 0.02], (len(starts), 1)), atol=1e-7)
    another = page.evaluate("preview.client.moveSegments('/overlay/polygon_edge', new Float32Array(12))")
    assert [message["type"] for message in another] == ["SceneNodeUpdateMessage"]


def test_without_a_gpu_the_feet_keep_their_colours(page: Page) -> None:
    if not page.evaluate("preview.client.drawsInSoftware"):
        pytest.skip("this browser draws with a GPU")
    page.wait_for_function(
        """() => { let key = null;
          preview.client.node("/robot/leg1_foot")?.traverse(({ material }) => {
            key ??= material?.customProgramCacheKey();
          });
          return key === "plain surface"; }""",
        timeout=START_MS,
    )
    with Image.open(BytesIO(page.screenshot())) as picture:
        red, green, blue = np.moveaxis(np.asarray(picture.convert("RGB"), dtype=int), 2, 0)
    for name, seen in (
        ("green", (green > red + 60) & (green > blue + 60)),
        ("red", (red > green + 90) & (red > blue + 60)),
        ("orange", (red > blue + 90) & (green > blue + 40)),
        ("blue", (blue > red + 60) & (blue > green + 40)),
    ):
        assert seen.sum() > 200, name


def test_without_a_gpu_the_backdrop_is_drawn_with_the_scene(page: Page) -> None:
    if not page.evaluate("preview.client.drawsInSoftware"):
        pytest.skip("this browser draws with a GPU")
    canvas = "document.querySelector('iframe').contentDocument.querySelector('canvas[data-engine]')"
    assert page.evaluate(f"{canvas}.getContext('webgl2').getContextAttributes().alpha") is False
    await_backdrop(page, [238, 241, 245], [253, 253, 254])
    page.evaluate("preview.setDark(true)")
    await_backdrop(page, [27, 33, 43], [17, 21, 27])


def await_backdrop(page: Page, high: list[int], low: list[int]) -> None:
    """Waits until the uppermost and the lowest pixels have mostly these colours, to a step of eight bits."""
    wanted, latest = np.array([high, low]), time.monotonic() + START_MS / 1e3
    while True:
        with Image.open(BytesIO(page.screenshot())) as picture:
            seen = np.median(np.asarray(picture.convert("RGB"), dtype=int)[[0, -1]], axis=1)
        if abs(seen - wanted).max() <= 1:
            return
        assert time.monotonic() < latest, seen
        page.wait_for_timeout(100)


def test_reach_that_is_shown_again_is_of_the_present_height(page: Page) -> None:
    times = walk().times
    said = page.evaluate(
        """async ({ samples, time }) => {
          preview.setReach({
            radii: Array(samples).fill([Array(6).fill(0.02)]), layers: [0], sole: 0,
            azimuths: [0], radius: 0, colours: [[9, 9, 9]],
            planes: Array.from({ length: samples }, (_, sample) => 0.05 + sample / 1000),
          });
          const { client } = preview;
          const [push, heights] = [client.push.bind(client), []];
          client.push = (messages, ...rest) => {
            for (const { name, updates } of messages) {
              if (name === "/robot/body/reach" && updates) heights.push(updates.points[2]);
            }
            return push(messages, ...rest);
          };
          for (const at of [0, time]) {
            playback.setTime(at);
            await preview.drawn();
            preview.show("reach", true);
            await preview.drawn();
            preview.show("reach", false);
          }
          return heights;
        }""",
        {"samples": times.size, "time": float(times[11])},
    )
    np.testing.assert_allclose(sorted(set(said)), [-0.061, -0.05], atol=1e-6)


def test_the_scene_comes_back_with_the_present_pose_after_a_lost_connection(
    page: Page, scenes: Scenes
) -> None:
    plan = walk()
    page.evaluate("time => playback.setTime(time)", float(plan.times[11]))
    wait_for_foot(page, 2, plan.feet_world[11, 2])
    page.evaluate("""() => {
      window.cameBack = false;
      preview.addEventListener("ready", () => { window.cameBack = true; }, { once: true });
    }""")
    stop_under_clients(scenes)
    scenes.of("deltawalker")
    page.wait_for_function("window.cameBack", timeout=START_MS)
    wait_for_foot(page, 2, plan.feet_world[11, 2])


def test_a_still_view_is_drawn_finer_than_a_moving_one_without_a_gpu(page: Page) -> None:
    if not page.evaluate("preview.client.drawsInSoftware"):
        pytest.skip("this browser draws with a GPU")
    width = "document.querySelector('iframe').contentDocument.querySelector('canvas[data-engine]').width"
    page.wait_for_function(f"{width} > window.innerWidth", timeout=START_MS)
    page.evaluate("playback.setSpeed(0.2); playback.play()")
    page.wait_for_function(f"{width} <= window.innerWidth", timeout=START_MS)
    page.evaluate("playback.pause()")
    page.wait_for_function(f"{width} > window.innerWidth", timeout=START_MS)


def test_keys_pressed_in_the_frame_reach_the_page(page: Page) -> None:
    page.evaluate("document.addEventListener('keydown', (event) => { window.pressed = event.key; })")
    page.frame_locator("iframe").locator("canvas[data-engine]").click()
    page.keyboard.press("Escape")
    page.wait_for_function("window.pressed === 'Escape'", timeout=START_MS)


def test_panels_of_the_client_are_hidden(page: Page) -> None:
    frame = next(frame for frame in page.frames if "/viser/" in frame.url)
    for selector in ("[data-floating-window]", ".mantine-Notifications-root"):
        assert frame.locator(f"{selector}:visible").count() == 0


def test_a_client_whose_inside_is_closed_is_moved_through_the_server(browser: Browser, address: str) -> None:
    page = scene_browser(browser).new_page(viewport={"width": 640, "height": 400})
    page.add_init_script(
        """Object.defineProperty(window, "__viserMutable", {
          get: () => undefined, set(value) { window.closedInside = value; }, configurable: true })"""
    )
    page.goto(address)
    page.wait_for_function("window.loaded === true", timeout=START_MS)
    assert page.evaluate("preview.route") == "server"
    plan = walk()
    page.evaluate("time => preview.setTime(time)", float(plan.times[9]))
    frame = next(frame for frame in page.frames if "/viser/" in frame.url)
    frame.wait_for_function(
        """wanted => {
          const pose = window.closedInside.nodePoseData["/robot/leg3_foot"];
          return Math.hypot(...pose.position.map((value, axis) => value - wanted[axis])) < 1e-6;
        }""",
        arg=plan.feet_world[9, 2].tolist(),
        timeout=START_MS,
    )
    page.close()
