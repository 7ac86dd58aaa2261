"""Deadlines for loaded machines, where an emulated robot may get no turn for longer than it may be silent.

What they are for users is tested in the robot's own time, for which no machine is too slow.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from app.bridge import bridge, delivery, handshake, state_machine, stop_confirmation, telemetry, transport
from app.cli import streaming
from app.emulator import emulated_robot
from app.emulator.emulated_robot import EmulatedRobot, start_emulator
from app.emulator.profiles import ProfileName

PATIENT_SECONDS = 60.0
DEADLINES = (
    (telemetry, "IDLE_SILENCE"),
    (telemetry, "SILENCE_LIMIT"),
    (telemetry, "FRESH_TIME"),
    (handshake, "START_LIMIT"),
    (delivery, "ECHO_DEADLINE"),
    (state_machine, "STALE_TIME"),
    (state_machine, "PATIENCE"),
    (state_machine, "START_PATIENCE"),
    (bridge, "LATE"),
    (bridge, "STOP_LIMIT"),
    (stop_confirmation, "STOP_LIMIT"),
    (transport, "WRITE_DEADLINE"),
    (emulated_robot, "PATIENCE"),
    (streaming, "SILENCE_LIMIT"),
    (streaming, "READY_SECONDS"),
    (streaming, "CLEAR_SECONDS"),
    (streaming, "STOP_SECONDS"),
)
"""The deadlines between bridge and robot that pass in real time, by the module that looks at each."""


def be_patient() -> None:
    """Makes the deadlines longer."""
    for module, name in DEADLINES:
        if not isinstance(getattr(module, name), float):
            raise TypeError(f"{module.__name__}.{name} is no time")
        setattr(module, name, PATIENT_SECONDS)


@contextmanager
def patient_robot(
    speed: float, *, profile: ProfileName = ProfileName.NOMINAL, booted: bool = False
) -> Iterator[EmulatedRobot]:
    """An emulated robot in this process, whose programs are patient meanwhile.

    Args:
        speed: seconds of the robot in a second.
        profile: timing of its input and output.
        booted: as if the board had been powered on long ago.
    """
    usual = [getattr(module, name) for module, name in DEADLINES]
    be_patient()
    emulated = start_emulator(profile, speed, booted=booted)
    try:
        yield emulated
    finally:
        emulated.close()
        for (module, name), seconds in zip(DEADLINES, usual, strict=True):
            setattr(module, name, seconds)
