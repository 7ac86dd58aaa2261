"""What was acknowledged of one gait, and what may be there besides: the action that was in flight."""

from __future__ import annotations

from dataclasses import dataclass, replace


@dataclass(frozen=True)
class GaitState:
    """What is looked at of a gait; its documents differ in the name alone.

    Args:
        name: in the present document.
        done: the names before each edit that undo takes back, the newest last.
        undone: the names after each edit that redo does again, the newest last.
        saved: the name in the saved file; None where there is none.
        versions: names of named versions, in order; each repeats the name in its document.
        approvals: who approved, in order.
        stands: whose approval is of the present document; None for nobody's.
    """

    name: str
    done: tuple[str, ...] = ()
    undone: tuple[str, ...] = ()
    saved: str | None = None
    versions: tuple[str, ...] = ()
    approvals: tuple[str, ...] = ()
    stands: str | None = None

    def edited(self, name: str) -> GaitState:
        """After an edit."""
        return replace(self, name=name, done=(*self.done, self.name), undone=(), stands=None)

    def taken_back(self) -> GaitState:
        """After an undo."""
        *done, name = self.done
        return replace(self, name=name, done=tuple(done), undone=(*self.undone, self.name), stands=None)

    def done_again(self) -> GaitState:
        """After a redo."""
        *undone, name = self.undone
        return replace(self, name=name, undone=tuple(undone), done=(*self.done, self.name), stands=None)

    def kept(self) -> GaitState:
        """After a save."""
        return replace(self, saved=self.name)

    def named(self, version: str) -> GaitState:
        """With one more named version."""
        return replace(self, versions=(*self.versions, version))

    def approved(self, by: str) -> GaitState:
        """After an approval."""
        return replace(self, approvals=(*self.approvals, by), stands=by)

    def seen(self) -> GaitState:
        """Without what cannot be looked at without changing it."""
        return replace(self, done=(), undone=())


@dataclass
class GaitLedger:
    """What is known of a gait.

    Args:
        gait: its id.
        state: as acknowledged.
        approves: whether it is approved too; looking at approvals needs its plan.
        coming: as it is once the action in flight is done; None where nothing is in flight.
        numbers: of names that were given so far.
    """

    gait: str
    state: GaitState
    approves: bool
    coming: GaitState | None = None
    numbers: int = 0

    def number(self) -> int:
        """A number that no name had."""
        self.numbers += 1
        return self.numbers

    def acknowledge(self) -> None:
        """The action in flight was answered: it is done."""
        if self.coming is None:
            raise AssertionError("nothing was in flight")
        self.state, self.coming = self.coming, None

    def compare(self, found: GaitState) -> bool | None:
        """Compares with what is there after a kill, which must be all or nothing of the action in flight.

        Returns:
            Whether the action in flight is there; None where none was.
        """
        coming, self.coming = self.coming, None
        if coming is not None and found == coming.seen():
            self.state = coming
            return True
        assert found == self.state.seen(), f"{self.gait}: {found} instead of {self.state.seen()}; {coming}"
        return None if coming is None else False
