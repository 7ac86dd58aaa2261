"""NPZ of a motion: it comes back to the last bit, and a damaged one is refused."""

from __future__ import annotations

import io
import zipfile
from contextlib import suppress
from dataclasses import fields
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from core.errors import InputError
from core.motion.trajectory import Trajectory
from core.motion.trajectory_npz import MotionFile, format_npz, parse_npz

numbers = st.floats(-1e3, 1e3, allow_nan=False)


@st.composite
def motions(draw: st.DrawFn) -> MotionFile:
    n, legs = draw(st.integers(2, 6)), draw(st.sampled_from([4, 6, 12]))
    moving = draw(st.booleans())

    def values(*shape: int) -> np.ndarray[tuple[int, ...], np.dtype[np.float64]]:
        return draw(arrays(np.float64, shape, elements=numbers))

    trajectory = Trajectory(
        times=np.cumsum(draw(arrays(np.float64, (n,), elements=st.floats(0.01, 5.0)))),
        body_world=values(n, 3),
        heading=values(n),
        feet_world=values(n, legs, 3),
        contact=draw(arrays(np.bool_, (n, legs))),
        body_velocity=values(n, 3) if moving else None,
        feet_velocity=values(n, legs, 3) if moving else None,
        contact_forces=values(n, legs, 3) if draw(st.booleans()) else None,
    )
    strokes = draw(arrays(np.float64, (n, legs, 3), elements=st.floats(-1, 1) | st.just(float("nan"))))
    name = draw(st.text(st.characters(exclude_characters="\0", codec="utf-8"), min_size=1, max_size=30))
    return MotionFile(trajectory, strokes, name, tuple(f"F{leg}" for leg in range(legs)))


@given(motions())
def test_a_motion_comes_back_to_the_last_bit(motion: MotionFile) -> None:
    read = parse_npz(format_npz(motion))
    assert (read.name, read.feet) == (motion.name, motion.feet)
    assert read.strokes.tobytes() == motion.strokes.tobytes()
    for field in fields(Trajectory):
        before, after = getattr(motion.trajectory, field.name), getattr(read.trajectory, field.name)
        assert (before is None and after is None) or before.tobytes() == after.tobytes(), field.name


@given(motions())
def test_the_same_motion_gives_the_same_bytes_and_says_its_units(motion: MotionFile) -> None:
    content = format_npz(motion)
    assert content == format_npz(motion)
    with np.load(io.BytesIO(content), allow_pickle=False) as archive:
        said = {line.split(": ")[0] for line in archive["units"].tolist()}
        data = set(archive.files) - {"format", "version", "name", "feet", "units"}
    assert said == data


def written(**changes: object) -> bytes:
    zeros = np.zeros((2, 4, 3))
    stands = np.ones((2, 4), dtype=np.bool_)
    motion = MotionFile(
        Trajectory(np.array([0.0, 0.4]), np.zeros((2, 3)), np.zeros(2), zeros, stands),
        zeros,
        "Walk",
        ("FR", "FL", "BL", "BR"),
    )
    with np.load(io.BytesIO(format_npz(motion))) as archive:
        arrays_by_name = {name: archive[name] for name in archive.files} | changes
    buffer = io.BytesIO()
    kept = {name: value for name, value in arrays_by_name.items() if value is not None}
    np.savez(buffer, allow_pickle=True, **kept)
    return buffer.getvalue()


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"", "is not an NPZ"),
        (b"PK\x03\x04 broken", "is not an NPZ"),
        (written()[:200], "is not an NPZ"),
        (written(times=np.array([{}, []], dtype=object)), "is not an NPZ of plain arrays"),
        (written(format=np.array("other")), "is not a motion of version 1"),
        (written(version=np.array(2)), "is not a motion of version 1"),
        (written(contact=None), "lacks contact"),
        (written(strokes=np.zeros((2, 4, 2))), "strokes has shape"),
        (written(times=np.array([1.0, 0.0])), "increasing times"),
        (written(heading=np.array([0.0, np.inf])), "must be finite"),
    ],
)
def test_a_damaged_file_is_refused_with_a_sentence(content: bytes, message: str) -> None:
    with pytest.raises(InputError, match=message):
        parse_npz(content)


@given(st.data())
def test_any_damage_is_refused_with_a_sentence(data: st.DataObject) -> None:
    content = bytearray(written())
    for _ in range(data.draw(st.integers(1, 6))):
        content[data.draw(st.integers(0, len(content) - 1))] = data.draw(st.integers(0, 255))
    with suppress(InputError):
        assert parse_npz(bytes(content)).trajectory.knot_count >= 2


def test_a_file_that_is_one_array_is_refused() -> None:
    buffer = io.BytesIO()
    np.save(buffer, np.zeros(3))
    with pytest.raises(InputError, match="is not an NPZ"):
        parse_npz(buffer.getvalue())


def _archive(name: str, shape: tuple[int, ...], held: bytes) -> bytes:
    """A motion of which one array says that it has a shape, and holds these bytes."""
    with np.load(io.BytesIO(format_npz(STANDING))) as archive:
        arrays = {key: archive[key] for key in archive.files}
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as file:
        for key, array in arrays.items():
            part = io.BytesIO()
            if key == name:
                head = {"descr": "<f8", "fortran_order": False, "shape": shape}
                np.lib.format.write_array_header_1_0(part, head)
                part.write(held)
            else:
                np.save(part, array)
            file.writestr(f"{key}.npy", part.getvalue())
    return buffer.getvalue()


STANDING = MotionFile(
    Trajectory(np.arange(3.0), np.zeros((3, 3)), np.zeros(3), np.zeros((3, 4, 3)), np.ones((3, 4), bool)),
    np.zeros((3, 4, 3)),
    "standing",
    ("1", "2", "3", "4"),
)


@pytest.mark.parametrize("shape", [(10**12,), (10**6, 10**6), (2**40, 4, 3), (-1,), (0,), (2**63, 2**63), ()])
def test_an_array_that_is_not_as_long_as_it_says_is_refused(shape: tuple[int, ...]) -> None:
    with pytest.raises(InputError, match="says that it has the shape"):
        parse_npz(_archive("times", shape, b"\0" * 24 if shape else b""))


def test_an_archive_that_unpacks_to_gigabytes_is_refused_unpacked() -> None:
    with pytest.raises(InputError, match=r"unpacks to .* MB; at most 100 MB are read"):
        parse_npz(_archive("feet_world", (101_000_000 // 8,), bytes(101_000_000)))


@pytest.mark.parametrize("key", ["times", "body_world", "contact", "strokes", "version", "feet", "format"])
@pytest.mark.parametrize(
    "value",
    [np.array("x"), np.array(["a", "b"]), np.zeros((3, 4, 3), complex), np.array([]), np.zeros(3, "M8[s]")],
    ids=["text", "texts", "complex", "empty", "dates"],
)
def test_an_array_of_another_kind_is_refused(key: str, value: np.ndarray[Any, Any]) -> None:
    with np.load(io.BytesIO(format_npz(STANDING))) as archive:
        arrays = {name: archive[name] for name in archive.files}
    buffer = io.BytesIO()
    np.savez(buffer, **{**arrays, key: value})
    with pytest.raises(InputError):
        parse_npz(buffer.getvalue())
