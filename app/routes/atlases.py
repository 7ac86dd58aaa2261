"""Atlases: thousands of gaits that are evaluated by a job, their list, their map and their tables."""

from typing import Annotated, Literal

from fastapi import APIRouter, Query, Response
from pydantic import Field
from starlette.concurrency import run_in_threadpool

from app.atlas.atlas_file import AtlasFile
from app.atlas.export import MEDIA_TYPES, exported, table_row
from app.atlas.front import atlas_front
from app.atlas.library import MOST_NAME
from app.common.json import Json
from app.web.dependencies import RequestBody, TheStudio, on_command_thread
from core.atlas.space import MOST_SEED, AtlasSpace, default_space, space_from_toml
from core.errors import InputError

router = APIRouter(prefix="/api/atlases", tags=["atlases"])

MOST_GAITS = 1_000_000
"""Of an atlas that the studio makes."""
MOST_SPACE = 100_000
"""Characters of a space."""
MAP_POLICY = "; ".join(
    [
        "default-src 'none'",
        "script-src 'unsafe-inline'",
        "style-src 'unsafe-inline'",
        "img-src data:",
        "frame-ancestors 'none'",
        "sandbox allow-scripts allow-downloads",
    ]
)
"""Content security of a map: it holds its code itself, and reaches neither the studio nor anything else."""


class AtlasBody(RequestBody):
    """Which atlas to make, or to go on with."""

    name: str = Field(min_length=1, max_length=MOST_NAME)
    count: int = Field(default=10_000, ge=1, le=MOST_GAITS, description="gaits that it is to have")
    robot: str | None = Field(default=None, max_length=80, description="null for that of the space")
    seed: int | None = Field(default=None, ge=0, le=MOST_SEED, description="null for that of the space")
    space: str | None = Field(
        default=None, max_length=MOST_SPACE, description="TOML; null for the robot's default space"
    )

    def space_asked(self) -> AtlasSpace | None:
        """The space that is asked for; None for that of the atlas, or else the default space.

        Raises:
            InputError: it is no space, or is of another robot.
        """
        if self.space is None and self.robot is None and self.seed is None:
            return None
        if self.space is None:
            return default_space(self.robot or "deltawalker").drawn_by(self.seed)
        space = space_from_toml(self.space, "space")
        if self.robot not in (None, space.robot):
            raise InputError(
                f"The space is of {space.robot}, and robot is {self.robot}. Leave robot out, or change the "
                "space.",
                "robot",
            )
        return space.drawn_by(self.seed)


@router.get("")
async def list_atlases(studio: TheStudio) -> Json:
    """Every atlas of the data folder with its gaits, robot and version; m/s."""
    return {"atlases": await run_in_threadpool(studio.atlases.library.contents)}


@router.post("", status_code=202)
async def make_atlas(body: AtlasBody, studio: TheStudio) -> Json:
    """Starts a job that evaluates the gaits which an atlas does not have yet."""

    def opened() -> AtlasFile:
        return studio.atlases.opened(body.name, body.space_asked())

    atlas = await run_in_threadpool(opened)
    return await on_command_thread(
        studio, lambda: studio.job_commands.submit_atlas(body.name, atlas, body.count)
    )


@router.get("/{name}")
async def read_atlas(name: str, studio: TheStudio) -> Json:
    """The summary of an atlas."""
    return await run_in_threadpool(studio.atlases.library.content, name)


@router.get("/{name}/front")
async def read_front(name: str, studio: TheStudio, x: str = "margin", y: str = "speed") -> Json:
    """The solved gaits that no other one beats in one of two keys without losing in the other; SI."""

    def found() -> Json:
        with studio.atlases.library.opened(name) as atlas:
            return {"x": x, "y": y, "front": [table_row(*entry) for entry in atlas_front(atlas, x, y)]}

    return await run_in_threadpool(found)


@router.get("/{name}/export", response_class=Response)
async def export_atlas(
    name: str,
    studio: TheStudio,
    format: Annotated[Literal["csv", "parquet", "html"], Query()] = "csv",  # noqa: A002  # the query's word
) -> Response:
    """All gaits as a table, or a page with their map that needs no studio."""

    def written() -> bytes:
        with studio.atlases.library.opened(name) as atlas:
            return exported(atlas, f".{format}")

    content = await run_in_threadpool(written)
    headers = {"content-disposition": f'attachment; filename="{name}.{format}"', "cache-control": "no-cache"}
    return Response(content, media_type=MEDIA_TYPES[f".{format}"], headers=headers)


@router.get("/{name}/map", response_class=Response)
async def show_map(name: str, studio: TheStudio) -> Response:
    """The map, to look at; it holds its code itself."""

    def written() -> bytes:
        with studio.atlases.library.opened(name) as atlas:
            return exported(atlas, ".html")

    content = await run_in_threadpool(written)
    headers = {"content-security-policy": MAP_POLICY, "cache-control": "no-cache"}
    return Response(content, media_type=MEDIA_TYPES[".html"], headers=headers)


@router.delete("/{name}")
async def delete_atlas(name: str, studio: TheStudio) -> Json:
    """Takes an atlas out of the list; `restore` brings it back until the studio starts again."""
    await on_command_thread(studio, lambda: studio.atlases.delete(name))
    return {"name": name}


@router.post("/{name}/restore")
async def restore_atlas(name: str, studio: TheStudio) -> Json:
    """Brings back an atlas that was deleted."""
    await on_command_thread(studio, lambda: studio.atlases.library.restore(name))
    return await run_in_threadpool(studio.atlases.library.content, name)
