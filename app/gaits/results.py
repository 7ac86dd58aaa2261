"""Results of solvers: where they are kept, and which gait takes one.

Only the command queue's thread calls this, but for `of`.
"""

from app.common.json import Json
from app.documents.gait_json import asked_hash, motion_hash
from app.plans.provenance import stored_result, with_found_poses, with_result
from app.plans.sequence_plan import run_motions
from app.store.database import Database
from core.gait.gait import Gait
from core.gait.provenance import Provenance
from core.pose_gaits.gait_poses import found_gait
from core.robot.model import load_robot


class Results:
    """The stored results, and those that came too late for their gait.

    Args:
        database: where they are stored.
    """

    def __init__(self, database: Database) -> None:
        self._database = database
        self._late: dict[tuple[str, str], Provenance] = {}

    def of(self, gait: Gait) -> Json | None:
        """The stored result that a document has. Thread-safe."""
        return stored_result(gait, self._database.result)

    def keep(self, content: Json) -> Provenance:
        """Stores a checked result of the exact tier."""
        provenance = Provenance(**content["provenance"])
        self._database.put_result(provenance.trajectory, content)
        return provenance

    def taken(self, gait_id: str, gait: Gait, provenance: Provenance) -> tuple[Gait, bool]:
        """A gait with the result that was computed for it, and whether it asks for that.

        Where it asks for something else by now, it stays as it is, and takes the result once an undo makes
        it ask for that again (see `with_late`).

        Args:
            gait_id: which gait.
            gait: its present document.
            provenance: of the result.
        """
        if provenance.motion not in _asked(gait):
            self.keep_late(gait_id, provenance)
            return gait, False
        return with_result(gait, provenance), True

    def keep_late(self, gait_id: str, provenance: Provenance) -> None:
        """Keeps a result for the time when its gait asks for it again."""
        self._late[gait_id, provenance.motion] = provenance

    def with_late(self, gait_id: str, gait: Gait) -> Gait:
        """A document that an undo or redo leads to, with the results that came too late for it."""
        for motion in _asked(gait):
            late = self._late.get((gait_id, motion))
            gait = gait if late is None else with_result(gait, late)
        return gait

    def keep_poses(self, motion: str, content: Json) -> None:
        """Stores what a search for poses ended with.

        Args:
            motion: hash of what was asked.
            content: the result as it is kept.
        """
        self._database.put_result(motion, content)

    def with_known_poses(self, gait: Gait) -> Gait:
        """The document with poses that were found for exactly what it asks, where its own are others."""
        motion = motion_hash(gait)
        content = self._database.result(motion) if lacks_poses(gait, motion) else None
        return gait if content is None else with_found_poses(gait, motion, content)


def lacks_poses(gait: Gait, motion: str) -> bool:
    """Whether a gait asks for the poses of a hash, and has none that answer it."""
    if gait.poses is None or motion_hash(gait) != motion:
        return False
    return found_gait(gait, load_robot(gait.robot)) is None


def _asked(gait: Gait) -> frozenset[str]:
    """What a document's plan is solved for; nothing where it has a recorded motion."""
    if gait.recorded is not None:
        return frozenset()
    return run_motions(gait) if gait.sequence else frozenset({asked_hash(gait)})
