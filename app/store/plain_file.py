"""Reads files that anybody may have put there: plain ones only, and without waiting for a pipe."""

import errno
import os
import stat
from pathlib import Path

from core.errors import InputError


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


def _why_not_opened(path: Path, error: OSError) -> str:
    if error.errno == errno.ELOOP:
        return f"{path.name} is a symbolic link, which is not followed. Put the file itself in its place."
    if error.errno == errno.ENXIO:
        return _no_file(path, stat.S_IFSOCK)
    return f"{path.name} cannot be read: {error.strerror}. Give the studio the right to read it."


def _no_file(path: Path, mode: int) -> str:
    kinds = {stat.S_IFDIR: "folder", stat.S_IFIFO: "pipe", stat.S_IFSOCK: "socket"}
    kind = kinds.get(stat.S_IFMT(mode), "device")
    return f"{path.name} is a {kind}, no gait file. Move it elsewhere."
