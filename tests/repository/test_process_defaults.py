"""The processes of the tests have default signals and surroundings, however the tests were started."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from tests.support.process_defaults import LOCAL, OPEN_FILES, default_environment
from tests.support.studio_process import ANSWER_SECONDS, PROJECT

REPORT = """
import json, locale, os, resource, signal, sys, time
ignored = {number for number in signal.valid_signals() if signal.getsignal(number) is signal.SIG_IGN}
json.dump(
    {
        "ignored": sorted(ignored - {signal.SIGPIPE, signal.SIGXFSZ}),  # Python ignores these two itself
        "interrupt": signal.getsignal(signal.SIGINT) is signal.default_int_handler,
        "blocked": sorted(signal.pthread_sigmask(signal.SIG_BLOCK, ())),
        "umask": os.umask(0),
        "encoding": locale.getpreferredencoding(),
        "zone": time.timezone,
        "odd": sorted(name for name in sys.argv[1:] if name in os.environ),
        "home": os.access(os.path.expanduser("~"), os.W_OK),
        "files": resource.getrlimit(resource.RLIMIT_NOFILE),
        "input": sys.stdin.read(),
    },
    sys.stdout,
)
"""
"""A program that writes the surroundings that it has got."""

ODD_START = """
import os, resource, signal, sys
for number in (signal.SIGINT, signal.SIGQUIT, signal.SIGHUP, signal.SIGTERM, signal.SIGTSTP, signal.SIGCHLD):
    signal.signal(number, signal.SIG_IGN)
signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGTERM, signal.SIGUSR1})
os.umask(0o077)
resource.setrlimit(resource.RLIMIT_NOFILE, (256, resource.getrlimit(resource.RLIMIT_NOFILE)[1]))
os.close(0)
os.execv(sys.executable, [sys.executable, "-m", "pytest", *sys.argv[1:]])
"""
"""Becomes pytest with signals ignored and blocked, another umask, few files and no standard input."""

ODD_ENVIRONMENT = {
    "HOME": "/nowhere",
    "LC_ALL": "C",
    "PYTHONSAFEPATH": "1",
    "TZ": "Asia/Kathmandu",
    "XDG_DATA_HOME": "/nowhere",
}


def test_a_process_of_the_tests_has_default_signals_and_surroundings() -> None:
    command = [sys.executable, "-c", REPORT, *(ODD_ENVIRONMENT.keys() - {"HOME", "TZ"})]
    done = subprocess.run(command, stdout=subprocess.PIPE, check=True)
    report: dict[str, Any] = json.loads(done.stdout)
    files, most = (number % 2**64 for number in report.pop("files"))  # -1 is infinite
    assert files >= min(OPEN_FILES, most)
    assert report == {
        "ignored": [],
        "interrupt": True,
        "blocked": [],
        "umask": 0o022,
        "encoding": "UTF-8",
        "zone": 0,
        "odd": [],
        "home": True,
        "input": "",
    }


@pytest.mark.heavy
@pytest.mark.parametrize("lanes", ["0", "1"])
def test_the_start_of_the_tests_does_not_change_their_processes(lanes: str, tmp_path: Path) -> None:
    chosen = test_a_process_of_the_tests_has_default_signals_and_surroundings
    words = ("-q", "-n", lanes, "-p", "no:cacheprovider", "--basetemp", str(tmp_path / "inner"))
    done = subprocess.run(
        [sys.executable, "-c", ODD_START, *words, f"{__file__}::{chosen.__name__}"],
        cwd=PROJECT,
        env={**os.environ, **ODD_ENVIRONMENT},
        capture_output=True,
        text=True,
        timeout=ANSWER_SECONDS,
    )
    assert done.returncode == 0, done.stdout
    assert "1 passed" in done.stdout


def test_no_proxy_leads_to_the_studios_of_the_tests() -> None:
    environment = default_environment({"http_proxy": "http://proxy:3128", "no_proxy": "lab,localhost"})
    assert environment["http_proxy"] == "http://proxy:3128"
    assert environment["no_proxy"] == "lab,localhost,127.0.0.1,::1"
    assert environment["NO_PROXY"].split(",") == list(LOCAL)
