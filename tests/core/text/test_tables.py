"""Tables in every unambiguous dialect are read as the plain ones, by every reader; the others are refused."""

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from core.arrays import Floats
from core.errors import InputError
from core.text.tables import read_table
from core.vision.track_csv import read_track_csv
from core.wire.trajectory_csv import parse_trajectory_csv
from core.wire.waypoints import is_waypoint_text, read_waypoint_csv

Read = tuple[Floats, tuple[str, ...]]


def numbers(rows: int, columns: int) -> str:
    """Rows of decimals that differ, some negative, none a whole number."""
    values = np.linspace(-0.1, 0.4, rows * columns).reshape(rows, columns) + 0.00137
    return "".join(",".join(f"{value:.5f}" for value in row) + "\n" for row in values.tolist())


HEADER = "duration_s," + ",".join(f"h{i}" for i in range(1, 13)) + "\n"
TEXTS = {
    "trajectory": "Column1,Column2,Column3,Column4\n" + numbers(30, 4),
    "waypoints": HEADER + numbers(5, 13).replace("-", ""),
    "track": "X_D1,Y_D1,X_D2,Y_D2\n" + numbers(6, 4),
}


def read_trajectory(text: str) -> Read:
    read = parse_trajectory_csv(text, "mine.csv")
    whole = np.concatenate([read.trajectory.body_world.ravel(), read.trajectory.feet_world.ravel()])
    return whole, tuple(note for note in read.assumptions if "has no companion" not in note)


def read_waypoints(text: str) -> Read:
    assert is_waypoint_text(text)
    read = read_waypoint_csv(text, "mine.csv")
    return np.concatenate([read.waypoints.durations, read.waypoints.strokes.ravel()]), read.notes


def read_track(text: str) -> Read:
    read = read_track_csv(text, "mine.csv")
    return read.track.feet, read.notes


READERS: dict[str, Callable[[str], Read]] = {
    "trajectory": read_trajectory,
    "waypoints": read_waypoints,
    "track": read_track,
}


def each_line(change: Callable[[str, int], str]) -> Callable[[str], str]:
    """A change of every line, which gets the line and its number from 0."""
    return lambda text: "".join(change(line, at) + "\n" for at, line in enumerate(text.splitlines()))


def counted(begin: int, name: str | None) -> Callable[[str], str]:
    """A first column as pandas writes it; its header has `name`, or no cell where that is None."""
    head = "" if name is None else f"{name},"
    return each_line(lambda line, at: f"{at - 1 + begin},{line}" if at else head + line)


def quoted(text: str) -> str:
    return each_line(lambda line, _: ",".join(f'"{cell}"' for cell in line.split(",")))(text)


GERMAN = "Read with ; between the numbers and a decimal comma."
COUNTED = "The first column counts the rows and was left out."
UNUSUAL: dict[str, tuple[Callable[[str], str], tuple[str, ...]]] = {
    "semicolons": (lambda t: t.replace(",", ";"), ("Read with ; between the numbers.",)),
    "decimal commas": (lambda t: t.replace(",", ";").replace(".", ","), (GERMAN,)),
    "decimal commas in quotes": (lambda t: quoted(t).replace('","', '";"').replace(".", ","), (GERMAN,)),
    "sep": (
        lambda t: "sep=;\r\n" + t.replace(",", ";").replace("\n", "\r\n"),
        ("Read with ; between the numbers.",),
    ),
    "tabs": (lambda t: t.replace(",", "\t"), ("Read with tabs between the numbers.",)),
    "tabs and decimal commas": (
        lambda t: t.replace(",", "\t").replace(".", ","),
        ("Read with tabs between the numbers and a decimal comma.",),
    ),
    "blanks": (lambda t: t.replace(",", "  "), ("Read with blanks between the numbers.",)),
    "nameless count": (counted(0, ""), (COUNTED,)),
    "count from 1": (counted(1, ""), (COUNTED,)),
    "count without header": (counted(0, None), (COUNTED,)),
    "count read again": (counted(0, "Unnamed: 0"), (COUNTED,)),
    "count and semicolons": (
        lambda t: counted(0, "")(t).replace(",", ";").replace(".", ","),
        (GERMAN, COUNTED),
    ),
    "carriage returns": (
        lambda t: t.replace("\n", "\r"),
        ("Read with carriage returns as the ends of lines.",),
    ),
    "line ends of Windows": (lambda t: t.replace("\n", "\r\n"), ()),
    "line ends twice": (lambda t: t.replace("\n", "\r\r\n"), ()),
    "mark": (lambda t: "\ufeff" + t, ()),
    "quotes": (quoted, ()),
    "empty columns": (each_line(lambda line, _: line + ",,"), ()),
    "empty columns below the header": (each_line(lambda line, at: line + "," * bool(at)), ()),
    "blanks around": (lambda t: t.replace(",", " , "), ()),
    "empty lines": (lambda t: t + "\n  \n", ()),
}


@pytest.mark.parametrize("kind", TEXTS)
@pytest.mark.parametrize("form", UNUSUAL)
def test_every_reader_reads_an_unambiguous_form_as_the_plain_one(form: str, kind: str) -> None:
    change, notes = UNUSUAL[form]
    plain, nothing = READERS[kind](TEXTS[kind])
    found, said = READERS[kind](change(TEXTS[kind]))
    np.testing.assert_array_equal(found, plain)
    assert (nothing, said) == ((), notes)


@pytest.mark.parametrize("kind", ["trajectory", "waypoints"])
@pytest.mark.parametrize("sign", [",", ";", "\t"])
def test_rows_of_separators_at_the_end_are_left_out(sign: str, kind: str) -> None:
    text = TEXTS[kind].replace(",", sign)
    empty = sign * text.splitlines()[1].count(sign) + "\n"
    found, notes = READERS[kind](text + empty * 3)
    np.testing.assert_array_equal(found, READERS[kind](TEXTS[kind])[0])
    assert notes[-1] == "3 empty rows at the end were left out."


def test_an_empty_row_of_a_track_is_a_frame_in_which_no_foot_was_seen() -> None:
    track = read_track_csv(TEXTS["track"] + ",,,\n").track
    assert track.filled.tolist() == [[False, False]] * 6 + [[True, True]]


@pytest.mark.parametrize("begin", [0, 1])
@pytest.mark.parametrize("has_header", [False, True])
def test_a_count_is_no_first_sample_of_a_trajectory(has_header: bool, begin: int) -> None:
    body = TEXTS["trajectory"].partition("\n")[2]
    text = "".join(f"{at},{line}\n" for at, line in enumerate(body.splitlines(), begin))
    found, notes = read_trajectory(("i,a,b,c,d\n" if has_header else "") + text)
    np.testing.assert_array_equal(found, read_trajectory(TEXTS["trajectory"])[0])
    assert notes == (COUNTED,)


NAMELESS = "The first column has no name and was left out."


@pytest.mark.parametrize("kind", TEXTS)
@pytest.mark.parametrize(
    ("cell", "note"),
    [("{}.0", COUNTED), ("{}0", COUNTED), ("{}e1", COUNTED), ("0.{}", NAMELESS), ("row {}", NAMELESS)],
)
def test_an_index_is_left_out_whatever_it_holds(kind: str, cell: str, note: str) -> None:
    head, *lines = TEXTS[kind].splitlines()
    text = "\n".join([f",{head}", *(f"{cell.format(row)},{line}" for row, line in enumerate(lines))])
    expected, _ = READERS[kind](TEXTS[kind])
    values, notes = READERS[kind](text)
    assert np.array_equal(values, expected)
    assert notes == (note,)


@pytest.mark.parametrize("head", [",Column2,Column3,Column4", ",1,2,3"])
def test_a_first_column_whose_name_is_missing_is_refused(head: str) -> None:
    with pytest.raises(InputError, match="the first column has no name"):
        read_trajectory(f"{head}\n{numbers(30, 4)}")


def test_numbers_that_count_under_a_name_of_their_own_are_numbers() -> None:
    text = "X_D1,Y_D1\n0,5\n1,5\n2,5\n3,5\n"
    assert read_track_csv(text).track.feet[:, 0, 0].tolist() == [0.0, 0.01, 0.02, 0.03]


def in_row(row: int, cell: str, column: int = 1) -> Callable[[str], str]:
    """Puts another cell in a line counted from 1, in a column counted from 1."""

    def change(line: str, at: int) -> str:
        cells = line.split(",")
        return ",".join([*cells[: column - 1], cell, *cells[column:]]) if at == row - 1 else line

    return each_line(change)


DAMAGED: dict[str, tuple[Callable[[str], str], str]] = {
    "underscore": (
        in_row(3, "1_0.0"),
        r"mine\.csv:3, column 1: “1_0\.0” is not a number; write it without _",
    ),
    "fullwidth": (
        in_row(3, "１", 2),
        r"mine\.csv:3, column 2: “１” is not a number; it has the character fullwidth",
    ),
    "arabic": (in_row(3, "٣", 2), r"mine\.csv:3, column 2: “٣” is not a number"),
    "no-break space": (in_row(4, "\u00a01"), r"mine\.csv:4, column 1: .* has the character no-break space"),
    "minus": (in_row(4, "−1"), r"mine\.csv:4, column 1: .* write the minus sign as -"),
    "nan": (in_row(4, "nan"), r"mine\.csv:4, column 1: nan is not a finite number"),
    "infinity": (in_row(4, "-Infinity"), r"mine\.csv:4, column 1: -Infinity is not a finite number"),
    "too large": (in_row(4, "1e999"), r"mine\.csv:4, column 1: 1e999 is not a finite number"),
    "too long": (in_row(4, "9" * 5000), r"mine\.csv:4, column 1: 9{40}… is not a finite number"),
    "words": (in_row(4, "x"), r"mine\.csv:4, column 1: “x” is not a number"),
    "vertical tab": (in_row(4, "\x0b1"), r"mine\.csv:4, column 1: .* is not a number"),
    "decimal comma in quotes": (
        lambda t: quoted(t).replace('"0.', '"0,'),
        r"mine\.csv:[0-9]+, column \d+: “0,\d+” is not a number; write a decimal point, not a comma",
    ),
    "mixed decimals": (
        lambda t: in_row(3, "1,5", 2)(t).replace(",", ";").replace("1;5", "1,5"),
        r"column 1: “.*\..*” has a decimal point, other numbers have a decimal comma; use one of them",
    ),
    "quote within": (
        in_row(3, '1"2"'),
        r"mine\.csv, line 3: quotes stand in a cell|“1\"2\"” is not a number",
    ),
    "open quote": (in_row(3, '"1'), r"mine\.csv, line 3: quotes stand in a cell or are not closed"),
    "return within": (in_row(3, "1\r2"), r"mine\.csv, line 3: a carriage return stands within the line"),
}


@pytest.mark.parametrize("kind", TEXTS)
@pytest.mark.parametrize("damage", DAMAGED)
def test_every_reader_refuses_what_is_no_plain_number_by_line_and_column(damage: str, kind: str) -> None:
    change, words = DAMAGED[damage]
    with pytest.raises(InputError, match=words):
        READERS[kind](change(TEXTS[kind]))


@pytest.mark.parametrize("read", [parse_trajectory_csv, read_waypoint_csv, read_track_csv, read_table])
@pytest.mark.parametrize("text", ['{"a": 1}', '\ufeff\r\n{"format": "footfall-gait"}'])
def test_json_is_no_table(text: str, read: Callable[[str, str], object]) -> None:
    with pytest.raises(InputError, match=r"mine\.csv holds JSON; a table of numbers is wanted here"):
        read(text, "mine.csv")


@pytest.mark.parametrize("kind", TEXTS)
def test_decimal_commas_between_commas_are_refused_with_the_way_out(kind: str) -> None:
    with pytest.raises(
        InputError, match=r"mine\.csv, line 2: .*Write decimal points, or ; between the numbers"
    ):
        READERS[kind](TEXTS[kind].replace(".", ","))


@pytest.mark.parametrize("kind", TEXTS)
def test_a_second_header_is_refused_with_what_stands_there(kind: str) -> None:
    with pytest.raises(InputError, match=r"only the first line may hold words|it reads “A title”"):
        READERS[kind]("A title\n" + TEXTS[kind]) if kind != "waypoints" else read_waypoint_csv(
            "A title\n" + HEADER
        )


def test_a_missing_header_is_said_with_what_stands_in_its_place() -> None:
    body = {kind: text.partition("\n")[2] for kind, text in TEXTS.items()}
    with pytest.raises(InputError, match=r"must read X_D1, Y_D1, X_D2, Y_D2, …; it reads “-0\.09863, "):
        read_track(body["track"])
    with pytest.raises(
        InputError, match=r"waypoints of 12 motors, the first line must read duration_s,h1,…,h12"
    ):
        read_trajectory(body["waypoints"])


def test_columns_are_counted_as_in_the_file_where_one_was_left_out() -> None:
    with pytest.raises(InputError, match=r"mine\.csv:4, column 3: “x” is not a number"):
        read_track(counted(0, "")(in_row(4, "x", 2)(TEXTS["track"])))


BROKEN_FORMS: dict[str, tuple[Callable[[str], str], str]] = {
    "line separators": (
        lambda t: t.replace("\n", "\u2028"),
        r"line 1: a line separator \(U\+2028\) stands within the line",
    ),
    "next lines": (lambda t: t.replace("\n", "\x85"), r"line 1: a next line \(U\+0085\) stands within"),
    "form feed": (lambda t: t.replace("\n", "\n\f", 2), r"line 2: a form feed stands within the line"),
    "rows in quotes": (
        lambda t: "".join(f'"{line}"\n' for line in t.splitlines()),
        r"each row stands in one pair of quotes as a whole\. Take the quotes out",
    ),
    "sep=; over commas": (
        lambda t: "sep=;\n" + t,
        r"line 1 says that ; stands between the cells, and it is a comma\. Take that line out",
    ),
    "comment": (in_row(4, "5.5 # c"), r"mine\.csv:4, column 1: “5\.5 # c” is not a number\.$"),
    "unit": (in_row(4, "5.5 mm"), r"mine\.csv:4, column 1: “5\.5 mm” is not a number\.$"),
}


@pytest.mark.parametrize("kind", TEXTS)
@pytest.mark.parametrize("form", BROKEN_FORMS)
def test_forms_that_cannot_be_read_are_named(form: str, kind: str) -> None:
    change, words = BROKEN_FORMS[form]
    with pytest.raises(InputError, match=words):
        READERS[kind](change(TEXTS[kind]))


@pytest.mark.parametrize("kind", TEXTS)
def test_sep_in_capitals_and_names_in_other_letters_are_read(kind: str) -> None:
    head, _, body = TEXTS[kind].partition("\n")
    for other in (head.upper(), head.lower()):
        values, notes = READERS[kind](f"SEP=;\n{other}\n{body}".replace(",", ";"))
        assert np.array_equal(values, READERS[kind](TEXTS[kind])[0])
        assert notes == ("Read with ; between the numbers.",)
    assert is_waypoint_text(f"SEP=;\n{HEADER.upper()}")


@pytest.mark.parametrize(
    ("header", "words"),
    [
        (HEADER.replace("h9", "h09"), "in column 10 “h09” in place of “h9”"),
        (HEADER.replace("h12", "h12,h13"), "and has 14 columns"),
        (HEADER.replace(",h12", ""), "and has 12 columns"),
    ],
)
def test_where_a_header_differs_is_said(header: str, words: str) -> None:
    with pytest.raises(InputError, match=r"it reads “duration_s, h1, .*") as refusal:
        read_waypoint_csv(header + numbers(5, 13), "mine.csv")
    assert str(refusal.value).endswith(f"{words}.")


plain = arrays(
    np.float64,
    st.tuples(st.integers(1, 5), st.integers(2, 4)),
    elements={"allow_nan": False, "allow_infinity": False},
)


@given(
    plain,
    st.sampled_from([",", ";", "\t", " "]),
    st.sampled_from([".", ","]),
    st.sampled_from(["\n", "\r\n", "\r"]),
)
def test_every_table_of_doubles_is_read_to_the_last_bit(
    table: Floats, sign: str, point: str, end: str
) -> None:
    if sign in (",", " "):
        point = "."
    rows = [sign.join(map(repr, row)).replace(".", point) for row in table.tolist()]
    names = sign.join("abcd"[: table.shape[1]])
    read = read_table(names + end + end.join(rows) + end, "mine.csv")
    assert read.numbers(1).tobytes() == table.tobytes()
