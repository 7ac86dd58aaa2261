"""The emulated robot against recordings of the real sketch: kinds, order, numbers, times."""

import json
import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

from app.emulator.firmware import Firmware
from app.emulator.memory import ARM, X86
from app.emulator.profiles import PROFILES, ProfileName

FOLDER = Path(__file__).parents[4] / "shared" / "protocol"
NUMBER = re.compile(r"-?\d+\.\d+")
LEFT_OUT = re.compile(r"(.)\.\.\.\[(\d+) characters left out by the recorder\]\.\.\.")
BOOT_MM = (10, 5, 0, 20, 7.5, 3, 0.5, 1.4, 12, 18, 9, 1.6)
REBOOT_AT = {"j2_mcu_reset_motor_driver_still_powered": 7.10562, "j_power_cycle_in_motion": 7.00562}
OFF_SECONDS = 0.5
COUNT_MM = 0.0121
"""A reading between two counts falls to either side, by the last bit of a sum."""

LATE = 2e-6
LATE_AFTER_RESET = 0.02
"""Recorded times are whole microseconds; a reset strikes between two steps of the emulator, s."""

RECORDINGS = [
    "a_boot", "b_reset", "c_one_waypoint", "c_one_waypoint_slow_io", "c2_small_step",
    "d_gait_walk_a_40knots", "e_stop_in_motion", "e4_stop_replace_then_start", "f_second_p_while_moving",
    "g_three_points_arm_Os_layout", "g_three_points_x86_Os", "g_7_points_arm_Os_layout",
    "h01_bytes_without_start_marker", "h02_start_without_end_then_valid", "h03_unknown_letter",
    "h04_too_few_fields", "h05_too_many_fields", "h07_count_zero_negative_missing", "h08a_non_numeric_field",
    "h08b_nan_field", "h08c_inf_field", "h08d_huge_number", "h08e_duration_ignored", "h09_empty",
    "h12_r_variants", "h13_spoofed_echo", "h14_overlong_20000_armOs", "h14_overlong_20100_armOs",
    "i_partial_write_idle", "i3_half_message_closed_by_lone_end", "j2_mcu_reset_motor_driver_still_powered",
    "j_power_cycle_in_motion", "k2_windup_after_stall", "k_unreachable_target_stop_resume",
]  # fmt: skip

pytestmark = pytest.mark.skipif(not FOLDER.is_dir(), reason=f"no recordings at {FOLDER}")


Record = dict[str, Any]


@dataclass(frozen=True)
class Timed:
    time: float
    text: str

    @property
    def kind(self) -> str:
        return NUMBER.sub("#", self.text)

    @property
    def numbers(self) -> list[float]:
        return [float(n) for n in NUMBER.findall(self.text)]


def whole(text: str) -> str:
    return LEFT_OUT.sub(lambda m: m[1] * (int(m[2]) + 1), text)


def replay(name: str, records: list[Record]) -> list[Timed]:
    profile = ProfileName.SLOW if "slow" in name else ProfileName.NOMINAL
    layout = X86 if "x86" in name else ARM
    firmware = Firmware(PROFILES[profile], BOOT_MM if name == "a_boot" else (0.5,) * 12, layout)
    to_robot = [(r["t"], whole(r["data"]).encode("latin-1")) for r in records if r["dir"] == "rx"]
    reboot = REBOOT_AT.get(name)
    lines, pending = [], b""
    program = firmware.run()
    end = max(float(r.get("t_end") or r["t"]) for r in records)
    while firmware.now < end + 0.2:
        next(program)
        for chunk in firmware.board.take_sent():
            pending += chunk.data
            while b"\n" in pending:
                line, _, pending = pending.partition(b"\n")
                lines.append(Timed(chunk.time_us / 1e6, line.decode("latin-1") + "\n"))
        while to_robot and to_robot[0][0] < firmware.now:
            firmware.board.inbox += to_robot.pop(0)[1]
        if reboot is not None and firmware.now >= reboot:
            if "power_cycle" in name:
                firmware.power_cycle(OFF_SECONDS)
            else:
                firmware.reset()
            reboot = None
    return lines


def test_every_recording_is_replayed() -> None:
    recorded = {path.stem for path in FOLDER.glob("*.jsonl")}
    assert recorded == {*RECORDINGS, "c_one_waypoint_by_usb_write"}


@pytest.mark.parametrize("name", RECORDINGS)
def test_the_emulator_says_what_the_sketch_said(name: str) -> None:
    records = [json.loads(line) for line in (FOLDER / f"{name}.jsonl").read_text().splitlines()]
    lines = iter(replay(name, records))
    late = LATE_AFTER_RESET if "mcu_reset" in name else LATE
    for record in records:
        if record["dir"] == "gap":
            for _ in range(record["lines"]):
                next(lines)
        elif record["dir"] == "tx":
            line, said = next(lines), Timed(record["t"], whole(record["data"]))
            assert line.kind == said.kind, f"at {said.time} s"
            assert line.numbers == pytest.approx(said.numbers, abs=COUNT_MM, nan_ok=True)
            assert line.time == pytest.approx(said.time, abs=late)


def test_the_emulator_writes_in_the_pieces_in_which_the_sketch_wrote() -> None:
    text = (FOLDER / "c_one_waypoint_by_usb_write.jsonl").read_text()
    records = [json.loads(line) for line in text.splitlines()]
    message = next(record for record in records if record["dir"] == "rx")
    wanted = [record for record in records if record["dir"] == "tx"]
    firmware = Firmware(PROFILES[ProfileName.NOMINAL])
    program, pieces, is_sent = firmware.run(), [], False
    while firmware.now < wanted[-1]["t"] + 0.2:
        next(program)
        pieces += [Timed(c.time_us / 1e6, c.data.decode()) for c in firmware.board.take_sent()]
        if firmware.now > message["t"] and not is_sent:
            firmware.board.inbox += message["data"].encode()
            is_sent = True
    first = next(i for i, piece in enumerate(pieces) if piece.time > wanted[0]["t"] - 2e-5)
    for piece, record in zip(pieces[first:], wanted, strict=False):
        assert piece.text == record["data"]
        assert piece.time == pytest.approx(record["t"], abs=LATE)
    assert len(pieces) - first >= len(wanted)


def test_the_published_walk_takes_its_published_time() -> None:
    records = (FOLDER / "d_gait_walk_a_40knots.jsonl").read_text().splitlines()
    messages = [r["data"].encode() for r in map(json.loads, records) if r["dir"] == "rx"]
    firmware = Firmware(PROFILES[ProfileName.PUBLISHED])
    program = firmware.run()
    times = []
    for message in messages:
        done = len(firmware.completions)
        firmware.board.inbox += message
        while len(firmware.completions) == done:
            next(program)
        times.append(firmware.now)
    assert 29.0 < times[-1] - times[6] < 30.5
    assert max(c.worst_mm for c in firmware.completions) <= 1.0
