"""Sentences under a published table: whose physics its columns are, and which definitions they have."""

from collections.abc import Iterator

from app.published.columns import WITH_REFERENCE, Who, has_data
from app.published.figures import SIMULATED, physics_of
from app.published.own_gait import SMALLER_MARGINS
from app.published.reference_folder import PublishedFolder
from core.published.tables import Kind, Movement, PublishedTable

_DEFINITIONS = {
    Kind.STANDING: (
        "An error is the mean distance of feet 1 to 3, over all waypoints, from where they would be if the "
        "robot stood still at the origin, 53 mm high. So the way that the robot goes counts as an error.",
        "By this definition our gaits are worse because they go further than the published runs: compare "
        "“goes”. “Feet from the plan” is the mean distance of all four feet from the motion that is planned.",
    ),
    Kind.TRACKING: (
        "An error is the mean distance from the plan over all waypoints and the four feet, each waypoint at "
        "its arrival. The thesis calls it a mean square error; it is none.",
        "The printed errors are those of PyBullet. Ours compare with those of the published motions in our "
        "physics, which come with the folder of the published data.",
    ),
    Kind.PAPER: (
        "An error is the mean distance from the plan over all waypoints, of the body and of each foot. The "
        "folder of the published data does not hold the paper's trajectories.",
    ),
    Kind.WALKED: (
        "A distance is that of the largest excursions from the first frame towards +x and +y, and the angle "
        "is theirs, means over the four feet. Thesis 5.2 says first and last values; its tables differ.",
    ),
    Kind.EXTENTS: (
        "A distance is √((largest x − smallest x)² + (largest y − smallest y)²) of each foot over the whole "
        "track, mean over the four feet; angles are those of the largest excursions. The folder of the "
        "published data does not hold the tracks of these tables.",
    ),
    Kind.PACE: (
        "The thesis timed the robot, and its speed is the measured distance of a step in that time. Ours is "
        "computed by the firmware's law of time for one iteration as it is sent by default, and its speed is "
        "the planned distance in that time.",
    ),
}
_PRINTED = {
    True: "“Thesis” is the thesis's own simulation, in PyBullet.",
    False: "“Thesis” is measured on the real robot.",
}


def about_table(table: PublishedTable, published: PublishedFolder) -> list[str]:
    """Sentences about a table.

    Args:
        table: which one.
        published: the folder of the published data.
    """
    return [*_about(table, published)]


def _about(table: PublishedTable, published: PublishedFolder) -> Iterator[str]:
    yield from _DEFINITIONS[table.kind]
    if table.kind is Kind.PAPER:
        yield "“Paper” is the paper's own simulation, in PyBullet."
    elif table.kind is not Kind.PACE:
        yield _PRINTED[table.kind in SIMULATED]
    yield from _ours(table)
    if table.kind in (Kind.WALKED, Kind.EXTENTS):
        yield from _real(table)
    if published.reference is not None:
        yield from _theirs(table)
    elif any(has_data(table, who) for who in WITH_REFERENCE):
        yield f"Columns of the published motions, runs and tracks are not at hand. {published.remedy}"


def _ours(table: PublishedTable) -> Iterator[str]:
    if all(row.gait.version is not None for row in table.rows):
        made = "made by hand from the same segments"
    else:
        *margins, last = (f"{margin * 1000:g}" for margin in SMALLER_MARGINS)
        made = (
            "of the same foot order and step, with the robot's own margin or the largest of "
            f"{', '.join(margins)} and {last} mm that has a motion"
        )
    if table.kind is Kind.PACE:
        yield f"“Ours” is our gait {made}."
        return
    physics = physics_of(table.kind).title
    sent = "one waypoint a sample" if table.kind in SIMULATED else "as it is sent by default"
    yield f"“Ours” is our gait {made}, in our physics ({physics}), {sent}: computed, not measured."


def _real(table: PublishedTable) -> Iterator[str]:
    fb = any(row.gait.family in ("walk", "amble") for row in table.rows)
    if fb:
        yield "In Walk and Amble the robot stood turned by 45° clockwise, and ours is turned likewise."
    if any(row.movement is Movement.STEP for row in table.rows):
        yield (
            "An individual step is the mean over the three iterations of first to last value, with a signed "
            "angle. Iterations end where the feet's own steps show it; in the thesis, where a person clicked."
        )


def _theirs(table: PublishedTable) -> Iterator[str]:
    if has_data(table, Who.RUN):
        yield (
            "“Published run, PyBullet” is read from the published positions; leans are those of the feet, "
            "since no attitude was published."
        )
    if has_data(table, Who.TRACK):
        yield "“Published tracks, our reading” is the mean of the trials whose tracks are in the folder."
    if has_data(table, Who.RECORDED):
        yield (
            "“Published motion, our physics” is the published trajectory, its strokes kept within the "
            "motors' range as the published program did."
        )
