"""Videos in the database; the files themselves are in the data folder."""

import json

from app.common.json import Json
from app.store.database import Database


class VideoStore:
    """What is known of each video.

    Args:
        database: where it is kept.
    """

    def __init__(self, database: Database) -> None:
        self._database = database

    def found(self, run: str = "", *, is_deleted: bool = False) -> list[Json]:
        """Videos, the newest first.

        Args:
            run: those of one run; empty for all.
            is_deleted: the deleted ones instead.
        """
        which = "NOT NULL" if is_deleted else "NULL"
        rows = self._database.rows(
            f"SELECT content, deleted FROM video WHERE deleted IS {which} AND (?='' OR run=?) "
            "ORDER BY rowid DESC",
            run,
            run,
        )
        return [_content(*row) for row in rows]

    def get(self, video: str) -> Json | None:
        """One video, also a deleted one; None where there is none."""
        rows = self._database.rows("SELECT content, deleted FROM video WHERE id=?", video)
        return _content(*rows[0]) if rows else None

    def trials(self, video: str = "") -> dict[str, list[dict[str, str]]]:
        """The trials that are not deleted, by the video that their feet were seen in, the newest first.

        Args:
            video: those of one video; empty for all.

        Returns:
            Id and name of each trial, under the video's id.
        """
        rows = self._database.rows(
            "SELECT json_extract(content, '$.sight.source.video') AS video, id, "
            "json_extract(content, '$.name') FROM trial "
            "WHERE deleted IS NULL AND video<>'' AND (?='' OR video=?) ORDER BY rowid DESC",
            video,
            video,
        )
        found: dict[str, list[dict[str, str]]] = {}
        for source, trial, name in rows:
            found.setdefault(source, []).append({"id": trial, "name": name})
        return found

    def put(self, content: Json) -> None:
        """Stores what is known of a video now; whether it is deleted stays as it is."""
        kept = {key: value for key, value in content.items() if key != "deleted"}
        text = json.dumps(kept, allow_nan=False)
        with self._database.writing() as connection:
            connection.execute(
                "INSERT INTO video(id, made, run, content) VALUES(?,?,?,?) "
                "ON CONFLICT(id) DO UPDATE SET content=excluded.content",
                (content["id"], content["made"], content["run"], text),
            )

    def deleted_at(self, video: str) -> float:
        """When a deleted video was deleted, by the folder's time (see `FolderTime`), s."""
        return float(self._database.rows("SELECT deleted FROM video WHERE id=?", video)[0][0])

    def put_deleted(self, video: str, deleted: float | None) -> None:
        """Takes a video out of every list at a folder's time, or brings it back with None; its file stays."""
        with self._database.writing() as connection:
            connection.execute("UPDATE video SET deleted=? WHERE id=?", (deleted, video))


def _content(content: str, deleted: float | None) -> Json:
    return {**json.loads(content), "deleted": deleted is not None}
