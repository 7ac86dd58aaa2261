"""Films that do not open, do not decode or keep no even time: what is read of them, and what is said."""

from __future__ import annotations

import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from app.vision import film_faults
from app.vision.avi_index import pictures_there
from app.vision.film_faults import begins_later, codec_name
from app.vision.frame_source import increasing_times, rate_of
from app.vision.video_file import VideoFile
from core.errors import InputError
from tests.support.studio_process import PROJECT
from tests.support.trials.films import (
    COUNT,
    RATE,
    SIZE,
    blotted,
    film,
    index_first,
    number_of,
    trimmed,
    turned,
    with_codec,
    without_pictures,
    without_times,
)
from tests.support.trials.retimed import retimed

CONVERT = r'Convert it, then choose the new file: ffmpeg -i "walk\.\w+" -c:v libx264'
AGAIN = "Copy it from the camera again"

Change = Callable[[bytes], bytes]

REFUSED: list[tuple[str, str, Change, str]] = [
    ("mp4", "mp4v", lambda film: with_codec(film, b"av01"), rf"None of the 60 .* codec is AV1, .*{CONVERT}"),
    ("mp4", "mp4v", lambda film: with_codec(film, b"hvc1"), rf"codec is HEVC \(H\.265\), .*{CONVERT}"),
    ("mp4", "mp4v", lambda film: with_codec(film, b"zzzz"), rf"codec is “zzzz”, .*{CONVERT}"),
    ("webm", "VP90", lambda film: film.replace(b"V_VP9", b"V_AV1"), rf"codec is AV1, .*{CONVERT}"),
    ("avi", "MJPG", lambda film: film.replace(b"MJPG", b"AV01"), rf"codec is AV1, .*{CONVERT}"),
    ("mp4", "mp4v", lambda film: blotted(film, 0.006, 700), f"file is damaged .*MPEG-4, can be .*{AGAIN}"),
    ("mp4", "mp4v", lambda film: film[: film.find(b"moov") - 4], rf"index \(the box “moov”\).*{AGAIN}"),
    ("mp4", "mp4v", lambda film: film.replace(b"vide", b"soun"), "sound and no pictures"),
    ("avi", "MJPG", lambda film: film.replace(b"vids", b"auds"), "sound and no pictures"),
    ("mp4", "mp4v", lambda film: b"0.1, 0.2\n" * 200, "holds text. Choose the film itself"),
    ("mp4", "mp4v", lambda film: b"", "walk.mp4 is empty; choose a video"),
    ("mp4", "mp4v", without_pictures, "film without pictures: it lasts 0 s. Record it again"),
    ("mp4", "mp4v", lambda film: film[:-100], f"index is damaged or cut off. {AGAIN}.* untrunc"),
    ("mp4", "mp4v", lambda film: film.replace(b"stts", b"xxxx"), f"index is damaged or cut off. {AGAIN}"),
    ("mp4", "mp4v", lambda film: film.replace(b"stsz", b"xxxx"), f"index is damaged or cut off. {AGAIN}"),
    ("mp4", "mp4v", lambda film: film.replace(b"stco", b"xxxx"), f"index is damaged or cut off. {AGAIN}"),
    ("mp4", "mp4v", without_times, "all its pictures have the same one.*ffmpeg -i"),
    ("avi", "MJPG", lambda film: film.replace(b"MJPG", b"I420"), f"codec is “I420”, .*{CONVERT}"),
    ("mp4", "mp4v", lambda film: bytes(range(256)) * 40, rf"its kind is not known here.*{CONVERT}"),
]


@pytest.mark.parametrize(("ending", "code", "change", "sentence"), REFUSED)
def test_a_film_that_gives_no_picture_names_its_codec_or_damage_and_the_way_out(
    ending: str, code: str, change: Change, sentence: str, tmp_path: Path
) -> None:
    path = tmp_path / f"walk.{ending}"
    path.write_bytes(change(film(path, code)))
    with pytest.raises(InputError, match=sentence):
        VideoFile(path)


def test_opencv_and_its_ffmpeg_print_nothing(tmp_path: Path) -> None:
    """In a process of its own, since OpenCV takes its settings once."""
    for number, (ending, code, change, _) in enumerate(REFUSED):
        path = tmp_path / f"{number}.{ending}"
        path.write_bytes(change(film(path, code)))
    (tmp_path / "damaged.mp4").write_bytes(blotted(film(tmp_path / "damaged.mp4"), 0.35, 900))
    script = """
import pathlib, sys
from app.vision.video_file import VideoFile
from core.errors import InputError
for path in pathlib.Path(sys.argv[1]).iterdir():
    try:
        list(VideoFile(path).pictures())
    except InputError as error:
        print(error.sentence)
"""
    command = [sys.executable, "-c", script, str(tmp_path)]
    done = subprocess.run(command, cwd=PROJECT, capture_output=True, text=True, check=True)
    assert done.stderr == ""
    assert len(done.stdout.splitlines()) == len(REFUSED)


def test_what_libraries_print_by_themselves_stays_in_a_vision_process(tmp_path: Path) -> None:
    script = """
import os, sys
from app.vision.video_io import silence_libraries
end_silence = silence_libraries()
os.write(2, b"libpng error: IDAT: CRC error")
print("A line of the program's own, “\x1b[2J”.", file=sys.stderr)
end_silence()
os.write(2, b"A line of a library.\\n")
silence_libraries()
raise ValueError("the gait “\x1b[31m”")
"""
    command = [sys.executable, "-c", script]
    done = subprocess.run(command, cwd=PROJECT, capture_output=True, text=True, check=False)
    own, library, *crash = done.stderr.splitlines()
    assert (own, library) == (r"A line of the program's own, “\u001b[2J”.", "A line of a library.")
    assert crash[-1] == r"ValueError: the gait “\u001b[31m”"
    closed = subprocess.run(["sh", "-c", 'exec "$@" 2>&-', "sh", *command], cwd=PROJECT, check=False)
    assert closed.returncode == 1


@pytest.mark.parametrize(("ending", "code"), [("mp4", "mp4v"), ("avi", "MJPG"), ("mkv", "FFV1")])
@pytest.mark.parametrize("count", [1, 2])
def test_a_film_of_one_or_two_pictures_is_not_cut_off(
    ending: str, code: str, count: int, tmp_path: Path
) -> None:
    path = tmp_path / f"walk.{ending}"
    film(path, code, count)
    read = VideoFile(path)
    assert (read.facts.count, read.facts.remark) == (count, "")
    read.close()


def test_of_an_index_that_claims_the_whole_film_a_part_is_read(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "walk.mp4"
    content = index_first(film(path))
    begin = content.find(b"moov") - 4
    wrong = content[:begin] + (1 << 31).to_bytes(4, "big") + content[begin + 4 :]
    path.write_bytes(trimmed(wrong, 10_000_000))
    assert begins_later(path)
    monkeypatch.setattr(film_faults, "MOST_INDEX", wrong.find(b"elst") - begin)
    assert not begins_later(path)


CUT: list[tuple[str, str, Change, int, str]] = [
    ("mp4", "mp4v", lambda film: index_first(film)[:-1200], 30, "cut off: it should last 2.0 s"),
    ("avi", "MJPG", lambda film: film[: len(film) // 3], 10, "cut off: it should last 2.0 s"),
    ("webm", "VP90", lambda film: film[: len(film) // 2], 20, "cut off: it should last 2.0 s"),
    ("mkv", "FFV1", lambda film: film[: len(film) // 2], 20, "cut off: it should last 2.0 s"),
    ("mp4", "mp4v", lambda film: blotted(film, 0.4, 3000), 12, r"Only \d+ of its 60 pictures decode"),
]


@pytest.mark.parametrize(("ending", "code", "change", "least", "remark"), CUT)
def test_a_film_that_was_cut_off_or_is_damaged_is_read_as_far_as_it_decodes(
    ending: str, code: str, change: Change, least: int, remark: str, tmp_path: Path
) -> None:
    path = tmp_path / f"walk.{ending}"
    path.write_bytes(change(film(path, code)))
    read = VideoFile(path)
    assert least <= read.facts.count < COUNT
    assert re.search(remark, read.facts.remark)
    pictures = list(read.pictures())
    assert len(pictures) == read.facts.count
    assert read.picture(0).shape == (SIZE[1], SIZE[0], 3)
    with pytest.raises(InputError, match="ends before picture"):
        read.picture(read.facts.count)
    read.close()


def with_hole(content: bytes, begin: float, end: float) -> bytes:
    """An AVI file in which a part of the pictures is overwritten with zeros."""
    first, last = content.find(b"movi") + 4, content.rfind(b"idx1")
    hole = [first + int(share * (last - first)) for share in (begin, end)]
    return content[: hole[0]] + bytes(hole[1] - hole[0]) + content[hole[1] :]


@pytest.mark.parametrize(("begin", "end"), [(0.02, 0.1), (1 / 3, 1 / 2), (0.5, 0.52), (0.2, 0.9), (0.9, 1.0)])
def test_pictures_of_an_avi_behind_a_hole_keep_their_times(begin: float, end: float, tmp_path: Path) -> None:
    path = tmp_path / "walk.avi"
    path.write_bytes(with_hole(film(path, "MJPG"), begin, end))
    read = VideoFile(path)
    there = pictures_there(path)
    assert there is not None
    missing = np.flatnonzero(~there)
    assert re.match(rf"{missing.size} of its 60 pictures (is|are) missing, between", read.facts.remark)
    cut = missing[0] - 1  # the hole may begin in it
    own = {round(time * RATE): number_of(picture) for time, picture in read.pictures()}
    assert own.keys() | {cut} == {*np.flatnonzero(there).tolist()}
    assert all(place == number for place, number in own.items() if place != cut)
    assert number_of(read.picture(2)) == own[round(read.times[2] * RATE)]
    read.close()


def test_times_behind_a_hole_that_cannot_be_known_are_said_to_be_unknown(tmp_path: Path) -> None:
    path = tmp_path / "walk.avi"
    path.write_bytes(with_hole(film(path, "MJPG"), 0.0, 0.1))
    read = VideoFile(path)
    assert "The times of the pictures after 0.00 s cannot be known" in read.facts.remark
    read.close()


@pytest.mark.parametrize(("share", "size"), [(0.05, 900), (0.1, 900), (0.15, 500), (0.2, 900), (0.3, 900)])
def test_pictures_that_follow_damaged_ones_keep_their_numbers_and_times(
    share: float, size: int, tmp_path: Path
) -> None:
    path = tmp_path / "walk.mp4"
    path.write_bytes(blotted(film(path), share, size))
    read = VideoFile(path)
    found = [(time, number_of(picture)) for time, picture in read.pictures()]
    gaps = np.diff([time for time, _ in found]) * RATE
    assert 1.5 < gaps.max() < 40
    behind = [one for one in found if one[0] * RATE > 45]
    assert len(behind) > 8
    assert [round(time * RATE) for time, _ in behind] == [number for _, number in behind]


def test_a_film_that_is_turned_has_the_size_of_its_turned_pictures(tmp_path: Path) -> None:
    path = tmp_path / "walk.mp4"
    path.write_bytes(turned(film(path)))
    read = VideoFile(path)
    assert (read.facts.size, read.facts.remark) == ((SIZE[1], SIZE[0]), "")
    assert read.picture(5).shape == (SIZE[0], SIZE[1], 3)


def test_a_film_that_is_trimmed_begins_where_its_edit_list_says(tmp_path: Path) -> None:
    path = tmp_path / "walk.mp4"
    path.write_bytes(trimmed(film(path), 10 * 512))
    read = VideoFile(path)
    assert (read.facts.count, read.facts.remark, read.times[0]) == (COUNT - 10, "", 0.0)
    assert [number_of(picture) for _, picture in read.pictures()] == list(range(10, COUNT))
    assert number_of(read.picture(20)) == 30


UNEVEN = [
    [1] * 30 + [3] * 30,
    [3] * 30 + [1] * 30,
    [1, 2, 1, 4] * 15,
    [1] * 59 + [90],
    [40] + [1] * 59,
]


@pytest.mark.parametrize("lengths", UNEVEN)
def test_the_rate_of_an_uneven_film_and_the_time_of_each_picture_come_from_its_times(
    lengths: list[int], tmp_path: Path
) -> None:
    path = tmp_path / "phone.mp4"
    path.write_bytes(retimed(film(path), lengths))
    read = VideoFile(path)
    times = np.concatenate([[0], np.cumsum(lengths[:-1])]) / RATE
    np.testing.assert_allclose(read.times, times, atol=1e-4)
    assert read.facts.rate == pytest.approx((COUNT - 1) / times[-1], rel=1e-3)
    assert read.facts.seconds == pytest.approx(times[-1] * COUNT / (COUNT - 1), rel=1e-3)
    assert [number_of(picture) for _, picture in read.pictures()] == list(range(COUNT))
    for number in (59, 0, 31, 30, 3, 58, 12, 13, 45):
        assert number_of(read.picture(number)) == number


@pytest.mark.parametrize(
    ("code", "ending"),
    [("MJPG", "avi"), ("mp4v", "mp4"), ("VP80", "webm"), ("VP90", "webm"), ("FFV1", "mkv")],
)
def test_an_even_film_keeps_its_nominal_rate(code: str, ending: str, tmp_path: Path) -> None:
    path = tmp_path / f"walk.{ending}"
    film(path, code)
    read = VideoFile(path)
    assert (read.facts.rate, read.facts.count, read.facts.remark) == (RATE, COUNT, "")
    assert [number_of(read.picture(number)) for number in (59, 0, 30)] == [59, 0, 30]


@pytest.mark.parametrize(
    ("times", "nominal", "rate", "after"),
    [
        ([0.0, 0.1, 0.2, 0.3], 10.0, 10.0, [0.0, 0.1, 0.2, 0.3]),
        ([5.0, 5.1, 5.2, 5.3], 10.0, 10.0, [0.0, 0.1, 0.2, 0.3]),
        ([0.0, 0.1, 0.05, 0.3], 10.0, 10.0, [0.0, 0.1, 0.2, 0.3]),
        ([0.0, 0.2, 0.4, 0.6], 30.0, 5.0, [0.0, 0.2, 0.4, 0.6]),
        ([0.0, 0.2, 0.4, 0.6], float("nan"), 5.0, [0.0, 0.2, 0.4, 0.6]),
        ([0.0, 0.0, 0.0, 0.0], 10.0, 10.0, [0.0, 0.1, 0.2, 0.3]),
        ([0.0, 0.0, 0.0, 0.0], 0.0, None, []),
    ],
)
def test_times_that_begin_late_go_back_or_stand_still(
    times: list[float], nominal: float, rate: float | None, after: list[float]
) -> None:
    found = rate_of(np.array(times), nominal)
    assert found == pytest.approx(rate)
    if found is not None:
        np.testing.assert_allclose(increasing_times(np.array(times), found), after, atol=1e-9)


def test_codecs_have_the_names_that_people_know() -> None:
    names = [codec_name(mark) for mark in ("AV01", "hvc1", "V_AV1", "ZZZZ", "")]
    assert names == ["AV1", "HEVC (H.265)", "AV1", "“ZZZZ”", "unknown"]
