"""What can go wrong with a robot and its cable, on request, each as a small object of its own.

Those of the cable work on both directions alike: a cable does not know which way it is spoiled.
"""

import math
import random
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum
from typing import Protocol, Self

from app.emulator.firmware import Firmware
from core.errors import InputError
from core.text.numbers import plain_whole
from core.wire.messages import MOTORS

DROP_CHANCE, GARBLE_CHANCE = 0.002, 0.002
"""Chance of a byte to be lost, or to have one of its bits flipped."""

SPLIT_CHANCE = 0.3
"""Chance of what arrives at once to be cut in two."""

SPLIT_PAUSE = (0.02, 0.25)
DELAY = (0.05, 0.4)
"""Shortest and longest pause between two pieces, and lateness of bytes, s."""

NOISE_MM = 0.02
"""Standard deviation of a noisy reading, mm: between one and two counts of the converter."""

WEAK_SHARE = 0.35
"""Speed of a weak motor as a share of a sound one's."""


class Fault(StrEnum):
    """What can go wrong on request; stall, unplug and reset strike once, the others last until mended."""

    DROP = "drop"
    GARBLE = "garble"
    SPLIT = "split"
    DELAY = "delay"
    STALL = "stall"
    UNPLUG = "unplug"
    RESET = "reset"
    WEAK_MOTOR = "weak-motor"
    STUCK_MOTOR = "stuck-motor"
    DEAD_POT = "dead-pot"
    REVERSED_MOTOR = "reversed-motor"
    SWAPPED_MOTORS = "swapped-motors"
    NOISE = "noise"


STRIKE_ONCE = frozenset({Fault.STALL, Fault.UNPLUG, Fault.RESET})

USUAL_MOTORS: dict[Fault, tuple[int, ...]] = {
    Fault.WEAK_MOTOR: (7,),
    Fault.STUCK_MOTOR: (4,),
    Fault.DEAD_POT: (1,),
    Fault.REVERSED_MOTOR: (6,),
    Fault.SWAPPED_MOTORS: (3, 4),
}
"""0-based motors that the faults of motors take where none are named."""


@dataclass(frozen=True)
class FaultRequest:
    """A fault and the motors that it strikes.

    Args:
        fault: what goes wrong.
        motors: 0-based motors of a fault of motors; its usual ones where none are named.

    Raises:
        InputError: a fault of the cable names motors, or one of motors other than it has.
    """

    fault: Fault
    motors: tuple[int, ...] = ()

    def __post_init__(self) -> None:
        count = len(USUAL_MOTORS.get(self.fault, ()))
        if not self.motors:
            return
        if len(self.motors) != count or len(set(self.motors)) != count:
            need = f"names {count} different motors" if count > 1 else "names one motor" if count else ""
            raise InputError(f"The fault {self.fault} {need or 'has no motors; leave them out'}.", "motors")
        if not all(0 <= motor < MOTORS for motor in self.motors):
            named = ", ".join(str(motor + 1) for motor in self.motors)
            raise InputError(f"Motors are 1 to {MOTORS}; the fault {self.fault} names {named}.", "motors")

    @classmethod
    def parse(cls, text: str) -> Self:
        """Reads `NAME` or `NAME:MOTORS`, as `swapped-motors:4,5`, with motors from 1.

        Raises:
            InputError: there is no such fault, or it has no such motors.
        """
        name, _, motors = text.partition(":")
        if name not in list(Fault):
            raise InputError(f"There is no fault {name}; choose one of {', '.join(Fault)}.", "fault")
        try:
            numbers = tuple(plain_whole(one) - 1 for one in motors.split(",")) if motors else ()
        except ValueError:
            raise InputError(f"{motors} are no motors; write as in {name}:4.", "fault") from None
        return cls(Fault(name), numbers)


class Spoiler(Protocol):
    """One thing that is wrong with one direction of a cable."""

    def carry(self, data: bytes, now: float) -> bytes:
        """Takes what goes in at the time `now` in s, perhaps nothing, and returns what comes out then."""


class Dropper:
    """Loses bytes.

    Args:
        dice: decides which.
        chance: of each byte.
    """

    def __init__(self, dice: random.Random, chance: float = DROP_CHANCE) -> None:
        self._dice = dice
        self._chance = chance

    def carry(self, data: bytes, now: float) -> bytes:
        """Returns what is left."""
        del now
        return bytes(new for byte in data for new in self._pass_on(byte))

    def _pass_on(self, byte: int) -> bytes:
        return self._strike(byte) if self._dice.random() < self._chance else bytes([byte])

    def _strike(self, byte: int) -> bytes:
        """What becomes of a byte that is hit."""
        del byte
        return b""


class Garbler(Dropper):
    """Flips a bit of some bytes, and loses none."""

    def __init__(self, dice: random.Random, chance: float = GARBLE_CHANCE) -> None:
        super().__init__(dice, chance)

    def _strike(self, byte: int) -> bytes:
        return bytes([byte ^ (1 << self._dice.randrange(8))])


class _Late:
    """Bytes that wait for their time; none overtakes another."""

    def __init__(self) -> None:
        self._waiting: deque[tuple[float, bytes]] = deque()

    def put(self, data: bytes, due: float) -> None:
        """Keeps bytes until `due` in s, or until those before them are out."""
        if data:
            last = self._waiting[-1][0] if self._waiting else due
            self._waiting.append((max(due, last), data))

    def take(self, now: float) -> bytes:
        """Returns what is due."""
        out = b""
        while self._waiting and self._waiting[0][0] <= now:
            out += self._waiting.popleft()[1]
        return out


class Splitter:
    """Cuts what arrives at once in two, the second piece after a pause.

    Args:
        dice: decides where, and how long the pause is.
    """

    def __init__(self, dice: random.Random) -> None:
        self._dice = dice
        self._late = _Late()

    def carry(self, data: bytes, now: float) -> bytes:
        """Returns the pieces that are due; nothing is lost."""
        cut = len(data)
        if cut > 1 and self._dice.random() < SPLIT_CHANCE:
            cut = self._dice.randrange(1, cut)
        self._late.put(data[:cut], now)
        self._late.put(data[cut:], now + self._dice.uniform(*SPLIT_PAUSE))
        return self._late.take(now)


class Delayer:
    """Has all bytes late.

    Args:
        dice: decides by how much.
    """

    def __init__(self, dice: random.Random) -> None:
        self._dice = dice
        self._late = _Late()

    def carry(self, data: bytes, now: float) -> bytes:
        """Returns what is due; nothing is lost."""
        self._late.put(data, now + self._dice.uniform(*DELAY))
        return self._late.take(now)


SPOILERS: dict[Fault, Callable[[random.Random], Spoiler]] = {
    Fault.DROP: Dropper,
    Fault.GARBLE: Garbler,
    Fault.SPLIT: Splitter,
    Fault.DELAY: Delayer,
}
"""Faults of the cable."""


class Cable:
    """One direction of the cable, through everything that is wrong with it."""

    def __init__(self) -> None:
        self._spoilers: list[Spoiler] = []
        self._left = b""

    def spoil(self, spoiler: Spoiler) -> None:
        """Adds something that is wrong."""
        self._spoilers.append(spoiler)

    def mend(self) -> None:
        """Takes away everything that is wrong; what was under way late comes out next."""
        self._left = self.carry(b"", math.inf)
        self._spoilers.clear()

    def carry(self, data: bytes, now: float) -> bytes:
        """Takes what goes in at the time `now` in s, perhaps nothing, and returns what comes out then."""
        for spoiler in self._spoilers:
            data = spoiler.carry(data, now)
        left, self._left = self._left, b""
        return left + data


class Troubles:
    """Everything that is wrong with one robot and its cable.

    Args:
        firmware: the robot.
        unplug: pulls the plug.
        seed: of all dice.

    Attributes:
        to_robot: direction of the cable.
        to_host: the other one.
    """

    def __init__(self, firmware: Firmware, unplug: Callable[[], None], seed: int = 0) -> None:
        self.to_robot, self.to_host = Cable(), Cable()
        self._firmware = firmware
        self._unplug = unplug
        self._dice = random.Random(seed)

    def strike(self, fault: Fault, motors: tuple[int, ...] = ()) -> None:
        """Makes something go wrong from now on.

        Args:
            fault: what.
            motors: 0-based motors of a fault of motors; its usual ones where none are named.
        """
        if fault in SPOILERS:
            for cable in (self.to_robot, self.to_host):
                cable.spoil(SPOILERS[fault](random.Random(self._dice.random())))
        elif fault in STRIKE_ONCE:
            self._strike_once(fault)
        else:
            self._strike_motors(fault, motors or USUAL_MOTORS.get(fault, ()))

    def mend(self) -> None:
        """Ends what lasts: the cable is whole and the motors are sound again."""
        self.to_robot.mend()
        self.to_host.mend()
        self._firmware.board.motors.mend(self._firmware.board.now_us)

    def _strike_once(self, fault: Fault) -> None:
        if fault is Fault.STALL:
            self._firmware.stall("The program was stalled on request.")
        elif fault is Fault.RESET:
            self._firmware.reset()
        else:
            self._unplug()

    def _strike_motors(self, fault: Fault, struck: tuple[int, ...]) -> None:
        motors, now_us = self._firmware.board.motors, self._firmware.board.now_us
        match fault:
            case Fault.WEAK_MOTOR:
                motors.weaken(struck[0], WEAK_SHARE, now_us)
            case Fault.REVERSED_MOTOR:
                motors.weaken(struck[0], -1.0, now_us)
            case Fault.STUCK_MOTOR:
                motors.jam(struck[0], now_us)
            case Fault.DEAD_POT:
                motors.blind(struck[0], now_us)
            case Fault.SWAPPED_MOTORS:
                motors.swap(struck[0], struck[1], now_us)
            case _:
                dice = random.Random(self._dice.random())
                motors.disturb(lambda: dice.gauss(0.0, NOISE_MM))
