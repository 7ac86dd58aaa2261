"""The queue of the bridge's worker: bounded, whatever the robot sends."""

import time

from app.bridge.bridge import RobotBridge
from app.bridge.inbox import ITEM_BYTES, MOST_BYTES, TURN_BYTES, Bytes, HungUp, Inbox, LeftOut
from app.bridge.states import LinkState
from tests.support.studio_process import wait_for

CHUNK = 65_536


def test_what_finds_no_room_is_left_out_and_marked_once() -> None:
    inbox = Inbox()
    for number in range(100):
        inbox.put(Bytes(b"x" * CHUNK, float(number)))
    inbox.put(HungUp(1, "gone"))
    items = inbox.take(0.0, MOST_BYTES)
    kept = [item for item in items if isinstance(item, Bytes)]
    assert sum(len(item.data) + ITEM_BYTES for item in kept) <= MOST_BYTES
    assert items[len(kept) :] == [LeftOut(), HungUp(1, "gone")]
    inbox.put(Bytes(b"again", 5.0))
    assert inbox.take() == [Bytes(b"again", 5.0)]


def test_a_piece_that_is_too_large_by_itself_is_left_out() -> None:
    inbox = Inbox()
    inbox.put(Bytes(b"x" * (MOST_BYTES + 1), 1.0))
    assert inbox.take(20.0) == [LeftOut()]


def test_many_small_pieces_are_bounded_too() -> None:
    inbox = Inbox()
    for _ in range(3 * MOST_BYTES // ITEM_BYTES):
        inbox.put(Bytes(b"\n", 0.0))
    assert len(inbox.take(0.0, MOST_BYTES)) <= MOST_BYTES // ITEM_BYTES + 1


def test_a_turn_takes_a_part_and_the_rest_is_not_judged_yet() -> None:
    inbox = Inbox()
    for number in range(4):
        inbox.put(Bytes(b"x" * CHUNK, float(number)))
    assert len(inbox.take()) == 1
    assert inbox.judged_until(9.0) == 1.0
    while inbox.take():
        pass
    assert inbox.judged_until(9.0) == 9.0
    assert TURN_BYTES <= CHUNK


def test_waking_ends_a_wait_once() -> None:
    inbox = Inbox()
    inbox.wake()
    began = time.monotonic()
    assert inbox.take(20.0) == []
    assert time.monotonic() - began < 10.0
    assert inbox.take(0.01) == []


class FloodingLine:
    """A line on which a robot sends bytes as fast as they are taken."""

    def __init__(self, device, on_data, on_lost) -> None:  # type: ignore[no-untyped-def]
        del on_lost
        self.device = device
        for _ in range(60):
            on_data(b"flood, flood, flood.\n" * (CHUNK // 20))

    def write(self, data: bytes) -> None:
        del data

    def wait_read(self) -> None:
        pass

    def close(self) -> None:
        pass


def test_a_flood_is_named_and_the_bridge_can_be_closed() -> None:
    bridge = RobotBridge(tick=0.005, opener=FloodingLine)  # type: ignore[arg-type]
    bridge.connect("flood")
    wait_for(
        lambda: any("faster than the program can read" in t.cause for t in bridge.transitions), "it is named"
    )
    assert bridge._inbox._memory <= MOST_BYTES
    bridge.disconnect()
    assert bridge.snapshot.link is LinkState.DISCONNECTED
    bridge.close()
