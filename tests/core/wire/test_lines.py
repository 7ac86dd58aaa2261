"""Lines from the robot: every kind is recognised, nothing raises."""

import itertools
import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.wire.lines import (
    KEPT_OF_OVERLONG,
    LONGEST_LINE,
    Blank,
    CurrentPoint,
    Echo,
    EndOfTrajectories,
    ErrorScan,
    ErrorsChecked,
    Execute,
    Line,
    LineReader,
    NewData,
    OutOfTravel,
    OverlongLine,
    PointCount,
    PointDuration,
    PointReached,
    SetupFinished,
    SetupMoving,
    Telemetry,
    TrajectoryPoint,
    UnknownLine,
    is_miscounted,
    numbers_equal,
    parse_line,
)

TWELVE = (0.504, 1.5, 2.0, 3.3, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0, 19.5)
COMMAS = ",".join(f"{n:.4f}" for n in TWELVE) + ","
SPACES = " ".join(f"{n:.4f}" for n in TWELVE) + " "


@pytest.mark.parametrize(
    ("text", "line"),
    [
        (f"j,{COMMAS}", Telemetry(TWELVE)),
        ("new data tf 0", NewData(taken=False)),
        ("new data tf 1", NewData(taken=True)),
        ("", Blank()),
        ("p durations i1.00", PointDuration(1.0, first=True)),
        ("durations i0.40", PointDuration(0.4, first=False)),
        (f"Trajectory Point 0: \tp 1.00 {SPACES}", TrajectoryPoint(0, 1.0, TWELVE)),
        ("Number of trajectory points \t1", PointCount(1, bare=False)),
        ("p Number of trajectory points \t-1", PointCount(-1, bare=True)),
        ("num pts 1 execute waypoints ", Execute(1)),
        ("Curr point 0 Max pts 1", CurrentPoint(0, 1)),
        (f"E, {COMMAS}", ErrorScan(TWELVE)),
        ("Checked errors, reached point 0", ErrorsChecked(reached=False)),
        ("Checked errors, reached point 1", ErrorsChecked(reached=True)),
        ("reached point, onto next trajectory", PointReached()),
        ("end of all available trajectories", EndOfTrajectories()),
        ("SETUP MOVING", SetupMoving()),
        ("SETUP FINISHED", SetupFinished()),
    ],
)
def test_each_kind_of_line_is_recognised(text: str, line: Line) -> None:
    assert parse_line(text.encode() + b"\r") == line


@pytest.mark.parametrize("odd", ["   nan", "   inf", "  -inf"])
def test_a_padded_odd_number_in_the_trajectory_line_is_read(odd: str) -> None:
    line = parse_line(f"Trajectory Point 0: \tp 1.00 {odd} {SPACES[7:]}".encode())
    assert isinstance(line, TrajectoryPoint)
    assert not math.isfinite(line.strokes_mm[0])


def test_an_overflow_in_the_errors_is_read_as_infinite() -> None:
    line = parse_line(f"E, ovf,{COMMAS[7:]}".encode())
    assert isinstance(line, ErrorScan)
    assert line.errors_mm[0] == math.inf


@pytest.mark.parametrize(
    "text",
    [
        f"j,{COMMAS}"[:-1],
        f"j,{COMMAS}1.0000,",
        "j,0.5040,0.5040,",
        f"j,{COMMAS}".replace("19.5000", "nan"),
        f"j,{COMMAS}".replace("19.5000", "19.5"),
        "new data tf 2",
        "end of all available trajectories ",
        "Trajectory Point 0: \tp 1.00 1.0000 ",
    ],
)
def test_a_line_that_is_not_quite_right_is_unknown(text: str) -> None:
    assert parse_line(text.encode()) == UnknownLine(text)


@pytest.mark.parametrize(
    ("text", "is_odd"),
    [
        (f"E, {COMMAS[7:]}", True),
        (f"E, {COMMAS}1.0000,", True),
        ("E, ", True),
        (f"E, {COMMAS}"[:-1], False),
        (f"E, {COMMAS}".replace(",", "", 1), False),
    ],
)
def test_errors_of_another_number_of_motors_are_told_from_a_spoilt_line(text: str, is_odd: bool) -> None:
    assert parse_line(text.encode()) == UnknownLine(text) or not is_odd
    assert is_miscounted(text) is is_odd


@pytest.mark.parametrize("stroke", [25.0, -9.0, 999.9999])
def test_strokes_that_no_motor_can_have_are_no_telemetry(stroke: float) -> None:
    line = parse_line(f"j,{COMMAS}".replace("19.5000", f"{stroke:.4f}").encode())
    assert line == OutOfTravel((*TWELVE[:-1], stroke))


@given(st.binary())
def test_no_line_makes_the_parser_raise(raw: bytes) -> None:
    parse_line(raw)


SPOKEN = (
    f"j,{COMMAS}",
    f"E, {COMMAS}",
    f"Trajectory Point 0: \tp 1.00 {SPACES}",
    "p durations i1.00",
    "Number of trajectory points \t1",
    "num pts 1 execute waypoints ",
    "Curr point 0 Max pts 1",
)


@given(
    st.sampled_from(SPOKEN),
    st.lists(st.tuples(st.integers(0, 120), st.integers(0, 3), st.binary(max_size=3)), max_size=4),
)
def test_a_line_that_a_bad_cable_changed_is_whole_or_unknown(
    text: str, changes: list[tuple[int, int, bytes]]
) -> None:
    raw = text.encode()
    for place, cut, put in changes:
        raw = raw[:place] + put + raw[place + cut :]
    line = parse_line(raw)
    if isinstance(line, Telemetry):
        assert len(line.strokes_mm) == len(TWELVE)
        assert all(-1.0 <= stroke <= 21.5 for stroke in line.strokes_mm)
    if isinstance(line, TrajectoryPoint | ErrorScan):
        numbers = line.strokes_mm if isinstance(line, TrajectoryPoint) else line.errors_mm
        assert len(numbers) == len(TWELVE)
    assert not isinstance(line, Echo)


@given(st.lists(st.binary(max_size=200), max_size=20))
def test_no_stream_makes_the_reader_raise(chunks: list[bytes]) -> None:
    reader = LineReader()
    for chunk in chunks:
        reader.feed(chunk)


@given(st.lists(st.integers(0, 200), max_size=10).map(sorted))
def test_a_stream_reads_the_same_however_it_is_cut(cuts: list[int]) -> None:
    stream = f"rest\r\nnew data tf 1\r\np,1\r\n\r\nj,{COMMAS}\r\nnew data tf 0\r\n".encode()
    reader = LineReader()
    edges = [0, *(min(c, len(stream)) for c in cuts), len(stream)]
    lines = [line for a, b in itertools.pairwise(edges) for line in reader.feed(stream[a:b])]
    assert lines == [NewData(taken=True), Echo("p,1"), Blank(), Telemetry(TWELVE), NewData(taken=False)]


@pytest.mark.parametrize("payload", ["end of all available trajectories", f"j,{COMMAS}", "new data tf 1", ""])
def test_an_echo_is_never_taken_for_a_line_of_the_robot(payload: str) -> None:
    reader = LineReader(drop_first=False)
    lines = reader.feed(f"new data tf 1\r\n{payload}\r\nnew data tf 0\r\n".encode())
    assert lines == [NewData(taken=True), Echo(payload), NewData(taken=False)]


@pytest.mark.parametrize("drop_first", [False, True])
@pytest.mark.parametrize("piece", [1 << 10, 3 << 20])
def test_a_line_without_end_is_cut_once_and_its_rest_is_no_line(piece: int, drop_first: bool) -> None:
    reader = LineReader(drop_first=drop_first)
    lines = [line for _ in range(40 if piece < LONGEST_LINE else 2) for line in reader.feed(b"\0" * piece)]
    assert [type(line) for line in lines] == [OverlongLine]
    assert len(reader._pending) <= LONGEST_LINE
    assert reader.feed(b"end of all available trajectories\r\nnew data tf 0\r\n") == [NewData(taken=False)]


def test_an_overlong_line_that_ends_in_the_same_piece_is_cut_too_and_an_overlong_echo_is_none() -> None:
    reader = LineReader(drop_first=False)
    stream = (
        b"new data tf 1\n" + b"x" * (LONGEST_LINE + 1) + b"\nnew data tf 1\n" + b"y" * LONGEST_LINE + b"\n"
    )
    cut = OverlongLine("x" * KEPT_OF_OVERLONG)
    taken = NewData(taken=True)
    assert reader.feed(stream) == [taken, cut, taken, Echo("y" * LONGEST_LINE)]


def test_numbers_are_equal_to_the_fourth_decimal_only() -> None:
    assert numbers_equal(TWELVE, TWELVE)
    assert not numbers_equal(TWELVE, (*TWELVE[:-1], 19.4998))
    assert not numbers_equal(TWELVE, TWELVE[:-1])
