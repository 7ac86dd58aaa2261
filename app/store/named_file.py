"""Files that a person names: a plain file is replaced whole, everything else is written through."""

import errno
import os
import stat
from collections.abc import Iterable
from pathlib import Path

from app.store.plain_file import write_atomically
from app.store.storage_errors import file_error
from core.errors import InputError
from core.text.printable import printable_text

_MOST_LINKS = 40
"""Links that are followed, as by the system."""


def write_named(
    path: Path, content: str | bytes, beside: Path | None = None, companion: str | bytes = b""
) -> None:
    """Writes a file that a person names, as a shell's `>` would, but a plain file whole or not at all.

    A plain file is replaced, and keeps its mode, owner and extended attributes; it may have a companion, and
    then both are written, or none. Links are followed and stay.
    A device, a pipe or one of this process's open files, such as /dev/stdout, is written through.

    Args:
        path: the file.
        content: what it holds from then on.
        beside: the companion; none is written beside what is no plain file, such as /dev/stdout or a pipe.
        companion: what the companion holds from then on.

    Raises:
        StorageError: the disk does not take it; plain files are as they were.
        InputError: nothing can be written there, or the text holds half a character (a lone surrogate).
    """
    data = content if isinstance(content, bytes) else _encoded(content, path)
    try:
        number, state = open_file_number(path), _state(path)
        if number is not None:
            _write_through(os.dup(number), data)
        elif state is None or stat.S_ISREG(state.st_mode):
            _replace(_replaceable(path, state), data, beside, companion)
        else:
            _require_writable(path, state)
            # Without O_TRUNC and O_CREAT; a pipe waits for its reader.
            _write_through(os.open(path, os.O_WRONLY | os.O_NOCTTY | os.O_CLOEXEC), data)
    except BrokenPipeError:
        return  # its reader has read enough, as with `| head`
    except OSError as error:
        if error.errno == errno.ELOOP:
            raise InputError(f"{path} is a link that leads nowhere but to links.", str(path)) from error
        raise file_error(error, path) from error


def _replace(path: Path, data: bytes, beside: Path | None, companion: str | bytes) -> None:
    """Replaces a plain file and its companion."""
    if beside is None:
        write_atomically(path, data)
        return
    try:
        old = beside.read_bytes() if beside.is_file() else None
    except OSError as error:
        raise file_error(error, beside) from error

    def write_beside() -> None:
        write_named(beside, companion)

    def undo() -> None:
        if old is not None:
            write_named(beside, old)
        elif is_plain(beside):
            Path(os.path.realpath(beside)).unlink()

    write_atomically(path, data, write_beside, undo)


def _encoded(text: str, path: Path) -> bytes:
    try:
        return text.encode()
    except UnicodeEncodeError as error:
        line = text.count("\n", 0, error.start) + 1
        beside = text[: error.start].rpartition("\n")[2][-30:]
        where = f"holds half a character after “{beside}”" if beside else "begins with half a character"
        raise InputError(
            f"{path} cannot be written: line {line} of its text {where}. Take it out of the name or the note "
            "that it comes from.",
            str(path),
        ) from error


def file_path(text: str | os.PathLike[str]) -> Path:
    """The path of a file that is to be written.

    Raises:
        InputError: it names a folder, also one that does not exist yet, as `results/` does.
    """
    path = Path(text)
    if os.path.basename(text) in ("", os.curdir, os.pardir) or path.is_dir():
        raise _is_folder(os.fspath(text) or os.curdir)
    return path


def _is_folder(name: str) -> InputError:
    return InputError(f"{name} is a folder. Name a file in it.", name)


def is_plain(path: Path) -> bool:
    """Whether a plain file stands there, or nothing yet, so that it may have a companion beside it."""
    try:
        state = _state(path)
    except OSError:  # writing to it says why
        return True
    return open_file_number(path) is None and (state is None or stat.S_ISREG(state.st_mode))


def form_of(path: Path, forms: Iterable[str]) -> str | None:
    """The form that a file's name ends in, such as `.csv`; None where it ends in none.

    What is no plain file, such as /dev/stdout, gets the first form.
    """
    known = tuple(forms)
    if path.suffix in known:
        return path.suffix
    return None if is_plain(path) else known[0]


def open_file_number(path: Path) -> int | None:
    """The number of this process's open file to which a path such as /dev/stdout leads; None of others."""
    folders = {"/dev/fd", os.path.realpath("/proc/self/fd"), os.path.realpath("/proc/thread-self/fd")}
    for _ in range(_MOST_LINKS):
        if path.name.isdecimal() and os.path.realpath(path.parent) in folders:
            return int(path.name)
        if not path.is_symlink():
            return None
        path = path.parent / path.readlink()
    return None


def _state(path: Path) -> os.stat_result | None:
    """What stands at the end of a path's links; None where nothing does yet."""
    try:
        return path.stat()
    except FileNotFoundError:
        return None


def _replaceable(path: Path, state: os.stat_result | None) -> Path:
    """The plain file at the end of a path's links, which may be replaced.

    Raises:
        InputError: it has other names, or may only be read.
    """
    if state is not None and state.st_nlink > 1:
        raise InputError(
            f"{path} has {state.st_nlink} names (hard links), and the others would keep what it holds now. "
            "Take this name away first (rm), or write another file.",
            str(path),
        )
    if state is not None and not os.access(path, os.W_OK):
        raise InputError(
            f"{path} cannot be written: it may only be read. Give yourself the right to write it "
            "(chmod u+w), or write another file.",
            str(path),
        )
    return Path(os.path.realpath(path))


def _require_writable(path: Path, state: os.stat_result) -> None:
    """Something that is no plain file takes bytes.

    Raises:
        InputError: it does not.
    """
    if stat.S_ISDIR(state.st_mode):
        raise _is_folder(str(path))
    if stat.S_ISSOCK(state.st_mode):
        raise InputError(f"{path} is a socket, into which no file can be written.", str(path))


def _write_through(descriptor: int, data: bytes) -> None:
    """Writes all bytes and closes the descriptor; control characters never reach a terminal raw."""
    with os.fdopen(descriptor, "wb") as file:
        if file.isatty():
            data = printable_text(data.decode(errors="replace")).encode()
        file.write(data)
