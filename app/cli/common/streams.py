"""The standard streams of a command: none is missing, all text can be written, none controls a terminal.

Whatever writes to `sys.stdout` or `sys.stderr` passes here: results, notes, help, warnings, the log.
"""

import logging
import os
import sys

from core.text.printable import printable_stream


class LogFormatter(logging.Formatter):
    """Lines of the log; those that continue a message are indented, so that none can be taken for another."""

    def format(self, record: logging.LogRecord) -> str:
        """A message with its traceback, if it has one."""
        return super().format(record).replace("\n", "\n  ")


def prepare_streams() -> None:
    """Makes the standard streams safe to use; doing it twice does no harm."""
    _open_missing()
    sys.stdin = sys.stdin or os.fdopen(0, closefd=False)
    sys.stdout = printable_stream(sys.stdout or os.fdopen(1, "w", closefd=False))
    sys.stderr = printable_stream(sys.stderr or os.fdopen(2, "w", closefd=False))


def _open_missing() -> None:
    """Opens /dev/null in the place of standard streams that are closed.

    Otherwise the next file that the program or a worker opens would get the number of one, and the output.
    """
    while True:
        number = os.open(os.devnull, os.O_RDWR)
        if number > 2:
            os.close(number)
            return
        os.set_inheritable(number, True)
