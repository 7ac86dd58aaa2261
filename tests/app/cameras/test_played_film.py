"""A film that is served as a camera gives each picture at its own time."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from app.cameras import source
from app.cameras.source import PlayedFile
from tests.support.trials.films import COUNT, RATE, film, number_of
from tests.support.trials.retimed import retimed


class PassedTime:
    """The monotonic clock; waiting for it takes no time."""

    def __init__(self) -> None:
        self.now = 50.0

    def monotonic(self) -> float:
        return self.now

    def sleep(self, seconds: float) -> None:
        self.now += seconds


@pytest.fixture
def time(monkeypatch: pytest.MonkeyPatch) -> PassedTime:
    passed = PassedTime()
    monkeypatch.setattr(source, "time", passed)
    return passed


LENGTHS = [[1] * COUNT, [3] * 30 + [1] * 30, [1] * 30 + [3] * 30, [1, 2, 1, 4] * 15, [20] + [1] * 59]


@pytest.mark.parametrize("lengths", LENGTHS)
def test_each_picture_comes_at_its_time(lengths: list[int], time: PassedTime, tmp_path: Path) -> None:
    path = tmp_path / "walk.mp4"
    path.write_bytes(retimed(film(path), lengths))
    played = PlayedFile(path)
    shown = [played.next() for _ in range(COUNT)]
    found = [(at - 50.0, number_of(picture)) for at, picture in filter(None, shown)]
    assert [number for _, number in found] == list(range(COUNT))
    times = np.concatenate([[0], np.cumsum(lengths[:-1])]) / RATE
    np.testing.assert_allclose([at for at, _ in found], times, atol=1e-3)
    played.close()


@pytest.mark.parametrize("lengths", LENGTHS)
def test_pictures_whose_time_has_passed_are_left_out(
    lengths: list[int], time: PassedTime, tmp_path: Path
) -> None:
    path = tmp_path / "walk.mp4"
    path.write_bytes(retimed(film(path), lengths))
    played = PlayedFile(path)
    times = np.concatenate([[0], np.cumsum(lengths[:-1])]) / RATE
    time.sleep(float(times[40]) + 1e-3)
    shown = played.next()
    assert shown is not None
    assert number_of(shown[1]) == 40
    assert played.next() is not None
    played.close()


def test_a_film_begins_anew_a_usual_interval_after_its_last_picture(time: PassedTime, tmp_path: Path) -> None:
    path = tmp_path / "walk.mp4"
    film(path)
    played = PlayedFile(path)
    for _ in range(COUNT):
        played.next()
    again = played.next()
    assert again is not None
    assert number_of(again[1]) == 0
    assert again[0] - 50.0 == pytest.approx(COUNT / RATE, abs=1e-3)
    played.close()
