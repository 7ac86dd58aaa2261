"""Opening a gait of an atlas: it is solved again, compared with its row, and made a document."""

from collections.abc import Callable
from dataclasses import dataclass, replace

from app.atlas.atlas_file import AtlasFile
from app.common.json import Json
from core.atlas.documents import drawn_document, pose_document
from core.atlas.near_walk import near_walk
from core.atlas.row import AtlasRow, RowStatus
from core.atlas.space import AtlasKind
from core.errors import InfeasibleError
from core.gait.gait import Gait
from core.pose_gaits.gait_poses import pose_problem, with_poses
from core.pose_gaits.pose_gait import PoseGait
from solver_jobs import PoseProgress, PoseResult, SolveStatus, drawn_points, evaluated_point, solve_poses


@dataclass(frozen=True, eq=False)
class OpenedGait:
    """A gait of an atlas, solved again.

    Args:
        stored: its row in the file.
        row: what comes of it now.
        parameters: of the gait.
        cycle: its motion in mid-walk; None of a drawn gait, and where it is not solved.
        document: as a gait file; None where none was asked for.
        walk: the search for poses from the standard stance to rest; None where none was asked for. Its step
            is another one where that of the atlas is too long for it.
    """

    stored: AtlasRow
    row: AtlasRow
    parameters: Json
    cycle: PoseGait | None
    document: Gait | None = None
    walk: PoseResult | None = None

    @property
    def agrees(self) -> bool:
        """Whether the answer is the one of the file."""
        return self.row.agrees_with(self.stored)

    @property
    def difference(self) -> str | None:
        """What differs from the file, in a sentence; None where nothing does."""
        if self.agrees:
            return None
        if self.row.status is not self.stored.status:
            return f"It was {self.stored.status.value} in the atlas, and now it is {self.row.status.value}."
        return (
            f"It made {self.stored.speed * 1000:.3f} mm/s in the atlas, and now it makes "
            f"{self.row.speed * 1000:.3f} mm/s."
        )


def opened_point(atlas: AtlasFile, number: int) -> OpenedGait:
    """A gait of an atlas, solved again and compared with its row.

    Args:
        atlas: the file.
        number: of the gait.

    Raises:
        NotFoundError: the atlas has none of that number.
        InputError: the robot's parameters are no longer those of the atlas.
    """
    stored, parameters = atlas.entry(number)
    atlas.require_same_robot()
    cycle, row = evaluated_point(atlas.space, number)
    return OpenedGait(stored, row, parameters, cycle)


def opened_gait(
    atlas: AtlasFile, number: int, report: Callable[[PoseProgress], bool] = lambda progress: True
) -> OpenedGait:
    """The same as a document: a gait for the robot's clock with poses from the standard stance to rest.

    Its row is of mid-walk, so these poses are searched for by the exact solver, which begins with the cycle
    of the atlas.

    Args:
        atlas: the file.
        number: of the gait.
        report: told of that search; False ends it.

    Raises:
        NotFoundError: the atlas has none of that number.
        InputError: it has no document, or the robot's parameters have changed.
        InfeasibleError: it has no motion, in the atlas as now.
    """
    opened = opened_point(atlas, number)
    if opened.agrees and opened.row.status is not RowStatus.SOLVED:
        raise InfeasibleError(
            f"Gait {number} is {opened.row.status.value}. {opened.row.reason} There is no gait file of it.",
            "ID",
        )
    (point,) = drawn_points(atlas.space, number, 1)
    model, name = atlas.space.model(point.numbers), f"Atlas gait {number}"
    if atlas.space.kind is AtlasKind.DRAWN:
        document = drawn_document(point, model, name)
        return OpenedGait(opened.stored, opened.row, opened.parameters, None, document)
    document, walk = pose_document(point, model, name), None
    if opened.cycle is not None:
        document, walk = _from_stance(document, opened.cycle, report)
    return OpenedGait(opened.stored, opened.row, opened.parameters, opened.cycle, document, walk)


def _from_stance(
    document: Gait, cycle: PoseGait, report: Callable[[PoseProgress], bool]
) -> tuple[Gait, PoseResult]:
    """The document with poses from stance to rest, and the search for them.

    Where the step of mid-walk is too long for the way from and to the standard stance, the document asks for
    the fastest step instead.
    """
    model = cycle.problem.model
    problem = pose_problem(document, model)
    walk = solve_poses(problem, report, near_walk(cycle, problem), explain=False)
    if walk.status is SolveStatus.INFEASIBLE and document.poses is not None and not problem.on_the_spot:
        free = replace(document, poses=replace(document.poses, free_step=True))
        found = solve_poses(pose_problem(free, model), report, explain=False)
        if found.gait is not None:
            document, walk = free, found
    return (document if walk.gait is None else with_poses(document, walk.gait)), walk
