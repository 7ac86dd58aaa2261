"""`restore`."""

from argparse import ArgumentParser, Namespace
from datetime import datetime
from pathlib import Path

from app.cli.common.command import set_command
from app.cli.common.output import show
from app.common.json import Json
from app.store.backups import Backup, found_backups
from app.store.database import DATABASE
from app.store.gait_files import default_data_folder
from app.store.quick_check import damage_of
from app.store.restore import contents_of, restore
from core.errors import InputError, StorageError


def restore_command(parser: ArgumentParser) -> None:
    """Makes the parser of `restore`."""
    text = "List the backups of the database, or go back to one; what was there is kept aside."
    set_command(parser, run_restore, text)
    parser.add_argument("--data", type=Path, default=None, help="data folder")
    chosen = parser.add_mutually_exclusive_group()
    text = "go back to this one: a name that the list shows, or a file"
    chosen.add_argument("--backup", type=Path, default=None, metavar="FILE", help=text)
    text = "begin with an empty database; saved gaits stay"
    chosen.add_argument("--empty", action="store_true", help=text)


def run_restore(options: Namespace) -> int:
    """Lists the backups of the database, or goes back to one of them."""
    data = (options.data or default_data_folder()).expanduser()
    if not data.is_dir():
        raise InputError(f"There is no data folder {data}. Give another with --data.", "--data")
    if options.backup is None and not options.empty:
        return _list(options, data)
    aside = restore(data, options.backup)
    what = "An empty database" if options.backup is None else f"The backup {options.backup.name}"
    lines = [f"{what} is in place. Saved gaits are as they were."]
    if aside is not None:
        lines.append(f"What was there before is kept in {aside}.")
    content = {
        "backup": None if options.backup is None else str(options.backup),
        "aside": aside and str(aside),
    }
    show(options, content, lines)
    return 0


def _list(options: Namespace, data: Path) -> int:
    path = data / DATABASE
    present = _line(path) if path.is_file() else None
    backups = [_backup(backup) for backup in found_backups(data)]
    lines = [f"The database {path}: {_state(present)}."]
    lines += ["Backups, the newest first:"] if backups else ["There are no backups."]
    for backup in backups:
        made = datetime.fromtimestamp(backup["made"]).strftime("%Y-%m-%d %H:%M")
        counts = ", ".join(f"{count} {name}" for name, count in backup["contents"].items())
        lines.append(
            f"  {backup['file']:<52} {made}  {backup['size'] / 1e6:8.1f} MB  {_state(backup)}  {counts}"
        )
    if backups:
        lines.append("Give the one to go back to with --backup; the database of now is kept aside.")
    show(options, {"database": present, "backups": backups}, lines)
    return 0


def _backup(backup: Backup) -> Json:
    contents = contents_of(backup.path)
    return {**_line(backup.path), "made": backup.made, "size": backup.size, "contents": contents}


def _line(path: Path) -> Json:
    try:
        damage = damage_of(path, is_open=path.name == DATABASE)
    except StorageError as error:
        damage = error.sentence
    return {"file": path.name, "damage": damage}


def _state(line: Json | None) -> str:
    if line is None:
        return "there is none"
    return "good" if line["damage"] is None else f"damaged ({line['damage']})"
