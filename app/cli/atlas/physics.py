"""What the commands of atlases do and print of physics."""

from argparse import Namespace
from collections.abc import Mapping
from typing import Any

from app.atlas.atlas_file import AtlasFile
from app.atlas.front import UNITS
from app.atlas.physics import VARIATIONS, PhysicsProgress, run_physics
from app.atlas.physics_choice import PhysicsChoice, physics_choice
from app.cli.common.output import duration, note
from app.cli.common.progress import end_line, rewrite_line
from app.common.json import Json
from core.atlas.physics_row import PhysicsRow, physics_content


def simulate_chosen(options: Namespace, atlas: AtlasFile, workers: int) -> Json | None:
    """Simulates the gaits that `--physics` names, and shows how far it is.

    Args:
        options: of `atlas run`.
        atlas: the file, with all gaits evaluated.
        workers: processes.

    Returns:
        What came of it, as JSON content; None where the option is not given.
    """
    if options.physics is None:
        return None
    choice = physics_choice(atlas, options.physics)
    if choice.notice is not None:
        note(choice.notice)
    progress = run_physics(atlas, choice, workers, _tell, variations=VARIATIONS)
    end_line()
    return run_content(choice, progress)


def run_content(choice: PhysicsChoice, progress: PhysicsProgress) -> Json:
    """What came of the simulations of a run, as JSON content."""
    return {
        "rule": choice.rule,
        "chosen": progress.count,
        "simulated": progress.simulated,
        "walk_in_all": progress.walking,
        "variations": VARIATIONS,
        "seconds": progress.seconds,
    }


def run_lines(content: Mapping[str, Any] | None) -> list[str]:
    """The same for people."""
    if content is None:
        return []
    chosen, simulated, seconds = (content[key] for key in ("chosen", "simulated", "seconds"))
    each = f", {seconds / simulated:.1f} s a gait" if simulated else ""
    return [
        f"Physics: {simulated:,} of {chosen:,} chosen gaits were simulated now, in {seconds:.1f} s{each}.",
        f"{content['walk_in_all']:,} of {chosen:,} walk in all {content['variations']} variations.",
    ]


def gait_content(row: PhysicsRow | None) -> Json | None:
    """What physics made of a gait, as JSON content; None of one that was not simulated."""
    return None if row is None else {**physics_content(row), "reason": row.reason}


def gait_lines(row: PhysicsRow | None) -> list[str]:
    """The same for people."""
    if row is None:
        return []
    if row.reason:
        return [f"It has no figures of physics: {row.reason}"]

    def words(key: str) -> str:
        unit, factor = UNITS[key]
        return f"{row.figures[key] * factor:.2f}{'' if unit.startswith('°') else ' '}{unit}"

    turn = f" and {words('simulated_turn_rate')}" if abs(row.simulated_turn_rate) > 1e-4 else ""
    return [
        f"In physics it makes {words('simulated_speed')}{turn}, leans by {words('max_tilt')} at most, "
        f"and no foot slides by more than {words('slip')} in all; {round(row.walked * row.variations)} of "
        f"{row.variations} variations walk."
    ]


def _tell(progress: PhysicsProgress) -> None:
    left = progress.seconds_left
    words = "" if left is None else f", {duration(left)} left"
    rewrite_line(
        f"{progress.done:,} of {progress.count:,} gaits simulated, {progress.walking:,} walk in all "
        f"variations{words}"
    )
