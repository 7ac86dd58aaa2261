"""The gaits of an atlas with everything that is known of them: rows, parameters, and physics."""

from collections.abc import Iterator

from app.atlas.atlas_file import AtlasFile
from app.common.json import Json
from core.atlas.physics_row import physics_content
from core.atlas.row import AtlasRow, RowStatus


def entries_with_physics(
    atlas: AtlasFile, status: RowStatus | None = None
) -> Iterator[tuple[AtlasRow, Json]]:
    """Rows in the order of their numbers, each with its parameters and its figures of physics.

    Args:
        atlas: the file.
        status: which; None for all.

    Returns:
        Rows with JSON content; figures of physics are None of gaits that were not simulated.
    """
    simulated = atlas.physics()
    for row, parameters in atlas.entries(status):
        yield row, {**parameters, **physics_content(simulated.get(row.number))}
