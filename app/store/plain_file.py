"""Plain files: read without waiting for a pipe that anybody may have put there, written atomically."""

import errno
import itertools
import os
import stat
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

from app.store.storage_errors import file_error
from core.errors import InputError

_NUMBERS = itertools.count()
"""Of the files that this process writes."""


def read_plain_file(path: Path, most: int) -> bytes:
    """What stands in a plain file.

    Args:
        path: the file; a symbolic link is not followed.
        most: bytes that it may have.

    Raises:
        FileNotFoundError: there is none.
        InputError: it is no plain file, too large, or cannot be read.
    """
    try:
        # Opened without O_NONBLOCK, a pipe would wait for somebody who writes into it.
        file = os.open(path, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC)
    except FileNotFoundError:
        raise
    except OSError as error:
        raise InputError(_why_not_opened(path, error), path.name) from error
    except ValueError as error:
        raise InputError("The name of a file holds the character U+0000. Leave it out.", "path") from error
    state = os.fstat(file)
    if not stat.S_ISREG(state.st_mode):
        os.close(file)
        raise InputError(_no_file(path, state.st_mode), path.name)
    with os.fdopen(file, "rb") as opened:
        content = b"" if state.st_size > most else opened.read(most + 1)
    if state.st_size > most or len(content) > most:
        size = max(state.st_size, len(content)) / 1e6
        raise InputError(
            f"{path.name} has {size:.1f} MB; at most {most / 1e6:.0f} MB are read. Move it elsewhere.",
            path.name,
        )
    return content


def sweep_partials(folder: Path, is_abandoned: Callable[[Path, os.stat_result], bool]) -> None:
    """Takes away what a killed program had half written; what is no plain file stays.

    Args:
        folder: with names as of `write_atomically`.
        is_abandoned: whether nobody writes a file any more, from its path and state.
    """
    for path in folder.glob(".*.partial*"):
        with suppress(OSError):  # it was taken away meanwhile, or may not be
            state = path.lstat()
            if stat.S_ISREG(state.st_mode) and is_abandoned(path, state):
                path.unlink()


def link_refusal(path: Path) -> InputError:
    """The refusal of a symbolic link where a file should be."""
    sentence = f"{path.name} is a symbolic link, which is not followed. Put the file itself in its place."
    return InputError(sentence, path.name)


def write_atomically(
    path: Path,
    content: str | bytes,
    before: Callable[[], object] = lambda: None,
    undo: Callable[[], object] = lambda: None,
) -> None:
    """Writes a file whole or not at all, and on disk when this returns.

    A file that is replaced passes its mode, owner and extended attributes on, as far as this account may.

    Args:
        path: the file.
        content: what it holds from then on.
        before: called once the new file is on the disk and is about to take its place; what it raises leaves
            the old one.
        undo: called where the new file cannot take its place after that.

    Raises:
        StorageError: the disk does not take it; what was there before is as it was.
        InputError: the file cannot be written there.
    """
    # Fits wherever the name itself fits; each file has its own, also one that `before` writes.
    partial = path.with_name(f".{path.name[:40]}.{next(_NUMBERS)}.{os.getpid()}.partial")
    try:
        partial.unlink(missing_ok=True)
        flags, mode = os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600 if os.path.lexists(path) else 0o666
        with open(os.open(partial, flags | os.O_CLOEXEC, mode), "wb") as file:
            _take_over(path, file.fileno())
            file.write(content if isinstance(content, bytes) else content.encode())
            file.flush()
            os.fsync(file.fileno())
        before()
        try:
            partial.replace(path)
        except BaseException:
            undo()
            raise
        folder = os.open(path.parent, os.O_RDONLY)
        try:
            os.fsync(folder)
        finally:
            os.close(folder)
    except OSError as error:
        raise file_error(error, path) from error
    finally:
        with suppress(OSError):
            partial.unlink(missing_ok=True)


def _take_over(path: Path, file: int) -> None:
    """Gives an open file what belongs to the plain file in whose place it comes, if there is one."""
    try:
        old = path.lstat()
    except FileNotFoundError:
        return
    if not stat.S_ISREG(old.st_mode):
        return
    mode = stat.S_IMODE(old.st_mode)
    if hasattr(os, "fchown"):
        try:
            os.fchown(file, old.st_uid, old.st_gid)
        except OSError:
            with suppress(OSError):  # the group alone may be given by its members
                os.fchown(file, -1, old.st_gid)
        if os.fstat(file).st_gid != old.st_gid:  # another group gets no rights but everybody's
            mode = mode & ~0o070 | (mode & 0o007) << 3
    os.chmod(file, mode)
    if hasattr(os, "listxattr"):
        with suppress(OSError):  # the file system has none
            for name in os.listxattr(path, follow_symlinks=False):
                with suppress(OSError):  # those of the system are its own
                    os.setxattr(file, name, os.getxattr(path, name, follow_symlinks=False))


def _why_not_opened(path: Path, error: OSError) -> str:
    if error.errno == errno.ELOOP:
        return link_refusal(path).sentence
    if error.errno == errno.ENXIO:
        return _no_file(path, stat.S_IFSOCK)
    return f"{path.name} cannot be read: {error.strerror}. Give the studio the right to read it."


def _no_file(path: Path, mode: int) -> str:
    kinds = {stat.S_IFDIR: "folder", stat.S_IFIFO: "pipe", stat.S_IFSOCK: "socket"}
    kind = kinds.get(stat.S_IFMT(mode), "device")
    return f"{path.name} is a {kind}, no plain file. Move it elsewhere."
