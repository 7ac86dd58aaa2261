"""Standard streams that are missing or cannot show every letter, and names that would control a terminal."""

from __future__ import annotations

import json
import logging
import os
import subprocess
import sys
import urllib.request
from collections.abc import Callable
from contextlib import suppress
from io import BytesIO, TextIOWrapper
from pathlib import Path

import pytest

from app.cli.common.streams import LogFormatter, prepare_streams
from app.documents.gait_json import gait_content
from app.store.folder_lock import studio_address
from core.library.library import library
from core.text.printable import PrintableStream
from tests.support.closed_terminal import in_terminal
from tests.support.command import run, run_json
from tests.support.studio_process import PROJECT, wait_for

PLAIN = {"LC_ALL": "C", "PYTHONUTF8": "0"}
NAMES = {
    "colour": "\x1b[31mred",
    "lines": "one\nSaved:\n  two",
    "csi": "\x9b2Jcleared",
    "delete": "a\x7f\x08\x07",
    "return": "shown\rhidden",
    "bidi": "gnp.\u202efig",
}


def closed_streams(*numbers: int) -> None:
    """Closes standard streams in a new process."""
    for number in numbers:
        os.close(number)


def children(parent: int) -> list[int]:
    """The processes that a process has started."""
    found = []
    for path in Path("/proc").glob("[0-9]*/stat"):
        with suppress(OSError):  # it has ended
            number, _, rest = path.read_text().partition(" ")
            if int(rest.rpartition(")")[2].split()[1]) == parent:
                found.append(int(number))
    return found


def program(
    *words: str, closed: tuple[int, ...] = (), surroundings: dict[str, str] | None = None
) -> subprocess.CompletedProcess[bytes]:
    """Runs the command in a process of its own, without the standard streams that are named."""
    return subprocess.run(
        [sys.executable, "-m", "app", *words],
        cwd=PROJECT,
        env=os.environ | (surroundings or {}),
        stdin=subprocess.DEVNULL,
        capture_output=True,
        timeout=120,
        preexec_fn=lambda: closed_streams(*closed),
        check=False,
    )


@pytest.fixture
def named(tmp_path: Path) -> Path:
    """A data folder with gaits whose names would control a terminal."""
    folder = tmp_path / "gaits"
    folder.mkdir()
    content = gait_content(library()["walk"].gait)
    for gait, name in NAMES.items():
        text = json.dumps(content | {"name": name}, ensure_ascii=False)
        (folder / f"{gait}.json").write_text(text, encoding="utf-8")
    return tmp_path


@pytest.mark.parametrize(
    "surroundings",
    [
        PLAIN,
        PLAIN | {"PYTHONIOENCODING": "ascii"},
        {"PYTHONIOENCODING": "latin-1"},
        {"PYTHONIOENCODING": "ascii:strict"},
        {"PYTHONIOENCODING": "cp1252"},
        PLAIN | {"PYTHONCOERCECLOCALE": "0"},
    ],
)
def test_what_cannot_be_encoded_is_replaced(surroundings: dict[str, str]) -> None:
    said = program("gaits", surroundings=surroundings)
    assert (said.returncode, said.stderr) == (0, b"")
    assert b"Rotate 45" in said.stdout


def test_a_sentence_is_read_in_ascii() -> None:
    said = program("export", "walk–2", "--format", "json", surroundings=PLAIN)
    assert (said.returncode, said.stdout) == (2, b"")
    assert said.stderr.startswith(b'There is no gait "walk')
    assert program("gaits", surroundings=PLAIN | {"PYTHONIOENCODING": "ascii"}).stdout.count(b" deg/s") > 1


def test_a_file_on_standard_output_is_utf_8_whatever_the_locale() -> None:
    said = program("export", "rotate-45", "--format", "json", surroundings=PLAIN)
    assert json.loads(said.stdout.decode())["name"] == "Rotate 45°"


@pytest.mark.parametrize(
    ("words", "closed", "status"),
    [
        (("gaits",), (1,), 0),
        (("gaits",), (2,), 0),
        (("gaits",), (0, 1, 2), 0),
        (("gaits", "--json"), (0,), 0),
        (("--help",), (1,), 0),
        (("dance",), (2,), 2),
        (("check", "absent.csv"), (0, 1, 2), 2),
        (("manual", "walk", "--step", "0.05"), (1, 2), 3),
    ],
)
def test_a_missing_stream_is_like_dev_null(
    words: tuple[str, ...], closed: tuple[int, ...], status: int
) -> None:
    said = program(*words, closed=closed)
    assert said.returncode == status
    assert b"Traceback" not in said.stderr


def test_a_studio_and_its_workers_run_without_streams_and_in_every_locale(tmp_path: Path) -> None:
    command = [sys.executable, "-m", "app", "serve", "--port", "0", "--no-browser", "--data", str(tmp_path)]
    with subprocess.Popen(
        command, cwd=PROJECT, env=os.environ | PLAIN, preexec_fn=lambda: closed_streams(0, 1, 2)
    ) as studio:
        try:
            wait_for(lambda: studio_address(tmp_path) is not None, "the studio has told its address")
            address = studio_address(tmp_path) or ""
            wait_for(lambda: len(children(studio.pid)) > 1, "the solvers are started")
            with urllib.request.urlopen(address, timeout=60) as page:
                assert "<title>Footfall Studio" in page.read().decode()
            with urllib.request.urlopen(f"{address}api/gaits", timeout=60) as gaits:
                assert "Rotate 45°" in {gait["name"] for gait in json.load(gaits)["gaits"]}
            for process in (studio.pid, *children(studio.pid)):
                streams = {os.readlink(f"/proc/{process}/fd/{number}") for number in (0, 1, 2)}
                assert streams == {os.devnull}
        finally:
            studio.terminate()
    assert studio.returncode == 0


@pytest.mark.heavy
def test_no_file_and_no_worker_gets_the_number_of_a_missing_stream(tmp_path: Path) -> None:
    gait = tmp_path / "walk.json"
    said = program("fastest", "walk", "--cycles", "1", "-o", str(gait), closed=(0, 1, 2), surroundings=PLAIN)
    assert said.returncode == 0
    assert json.loads(gait.read_text("utf-8"))["format"] == "footfall-gait"
    assert program("check", str(gait), closed=(0,)).returncode == 0


def test_no_answer_is_read_from_a_missing_standard_input(tmp_path: Path) -> None:
    way = tmp_path / "way.csv"
    header = "duration_s," + ",".join(f"h{i}" for i in range(1, 13))
    way.write_text(f"{header}\n1.0," + ",".join(["5.5"] * 12) + "\n")
    said = program("send", str(way), "--robot", "emulator", "--data", str(tmp_path), closed=(0,))
    assert said.returncode == 4
    assert said.stderr.decode().endswith("Not approved; nothing was sent.\n")


@pytest.mark.parametrize("words", [("gaits",), ("gaits", "--json"), ("gaits", "--schema"), ("--help",)])
def test_a_full_disk_is_a_sentence_and_a_reader_that_ends_is_none(words: tuple[str, ...]) -> None:
    command = [sys.executable, "-m", "app", *words]
    with Path("/dev/full").open("w") as full:
        said = subprocess.run(command, cwd=PROJECT, stdout=full, stderr=subprocess.PIPE, check=False)
    assert said.returncode == 2
    assert said.stderr.startswith(b"The output cannot be written: No space left on device.")
    reading, writing = os.pipe()
    os.close(reading)
    said = subprocess.run(command, cwd=PROJECT, stdout=writing, stderr=subprocess.PIPE, check=False)
    os.close(writing)
    assert (said.returncode, said.stderr) == (0, b"")


def test_names_never_control_a_terminal(capsys: pytest.CaptureFixture[str], named: Path) -> None:
    status, out, _ = run(capsys, "gaits", "--data", str(named))
    saved = out.split("Saved:\n", 1)[1]
    assert status == 0
    assert len(saved.splitlines()) == len(NAMES)
    assert out.replace("\n", "").isprintable()
    for shown in (r"\u001b[31mred", r"one\u000aSaved:", r"\u009b2J", r"a\u007f\u0008", r"gnp.\u202efig"):
        assert shown in saved
    _, listed = run_json(capsys, "gaits", "--data", str(named))
    assert {gait["name"] for gait in listed["gaits"]} >= set(NAMES.values())


@pytest.mark.parametrize(
    "words",
    [
        ("check", "/no/\x1b]0;title\x07.csv"),
        ("export", "a\x1b[2J\nWrote x.", "--format", "json"),
        ("optimise", "\x9b31m"),
        ("walk\u202e",),
        ("optimise", "walk", "--robot", "\x1b[1mrobot"),
        ("gaits", "--no\x08such"),
    ],
)
def test_sentences_never_control_a_terminal(
    capsys: pytest.CaptureFixture[str], words: tuple[str, ...]
) -> None:
    status, out, err = run(capsys, *words)
    assert (status, out) == (2, "")
    assert err.count("\n") == 1
    assert err.rstrip("\n").isprintable()


def test_a_file_goes_to_a_terminal_without_control_characters_and_elsewhere_as_it_is(named: Path) -> None:
    words = ("export", "colour", "--format", "json", "--data", str(named))
    assert json.loads(program(*words).stdout)["name"] == NAMES["colour"]
    assert program("export", "csi", *words[2:]).stdout.decode().count("\x9b2J") == 1
    with in_terminal("export", "csi", *words[2:]) as terminal:
        assert terminal.process.wait(60) == 0
        wait_for(lambda: "}\r\n" in terminal.shown, "the file is shown")
    assert r"\u009b2Jcleared" in terminal.shown
    assert "\x9b" not in terminal.shown


def test_the_log_has_no_control_characters_and_no_forged_lines() -> None:
    stream = PrintableStream(TextIOWrapper(BytesIO(), encoding="utf-8"))
    handler = logging.StreamHandler(stream)
    handler.setFormatter(LogFormatter("%(levelname)s %(name)s: %(message)s"))
    try:
        raise ValueError("\x1b[2J\nWARNING forged: by an error")
    except ValueError:
        error = sys.exc_info()
    text = "gait “\x1b[31m”\nERROR forged: line"
    handler.emit(logging.LogRecord("app.test", logging.WARNING, "", 0, text, None, error))
    stream.flush()
    lines = stream.buffer.getvalue().decode().splitlines()
    assert lines[0] == r"WARNING app.test: gait “\u001b[31m”"
    assert all(line.startswith("  ") and line.isprintable() for line in lines[1:])


@pytest.mark.parametrize("encoding", ["ascii", "latin-1", "cp1252", "utf-8", "utf-16"])
def test_a_stream_takes_every_text(encoding: str) -> None:
    stream = PrintableStream(TextIOWrapper(BytesIO(), encoding=encoding))
    stream.writelines(["“3” – 4,5° ", "Läufer 步 \udcff\n"])
    stream.flush()
    shown = stream.buffer.getvalue().decode(encoding)
    assert shown.startswith(('"3" - 4,5', "“3” – 4,5"))
    assert "ufer" in shown


def test_streams_are_prepared_once(monkeypatch: pytest.MonkeyPatch) -> None:
    streams: list[Callable[[], object]] = [lambda: sys.stdin, lambda: sys.stdout, lambda: sys.stderr]
    for name in ("stdin", "stdout", "stderr"):
        monkeypatch.setattr(sys, name, None)
    prepare_streams()
    first = [stream() for stream in streams]
    prepare_streams()
    assert [stream() for stream in streams] == first
    assert None not in first
