"""The commands of `footfall`, grouped by what a person wants to do."""

from typing import NamedTuple


class Command(NamedTuple):
    """A command, whose module is loaded when it is asked for.

    Args:
        line: what it does, for `footfall --help`.
        define: the function that makes its parser, as `module:function` of this folder.
    """

    line: str
    define: str


COMMAND_GROUPS = {
    "Studio": {
        "serve": Command("Serve the studio and print its address.", "commands_robot:serve_command"),
        "doctor": Command(
            "Say whether this computer has all that is needed.", "commands_doctor:doctor_command"
        ),
    },
    "Design": {
        "gaits": Command("List built-in and saved gaits.", "commands_gait:gaits_command"),
        "manual": Command("Make the trajectory of a gait made by hand.", "commands_gait:manual_command"),
        "optimise": Command("Find the best trajectory of a gait.", "commands_gait:optimise_command"),
    },
    "Search": {
        "fastest": Command("Find the fastest walk on the robot.", "commands_fastest:fastest_command"),
        "atlas": Command("Evaluate thousands of gaits, and find the best.", "atlas.options:atlas_command"),
        "frontier": Command(
            "Find the largest step of a gait, and what limits it.", "commands_frontier:frontier_command"
        ),
        "pattern": Command("Find the best footfall pattern.", "commands_pattern:pattern_command"),
    },
    "Check and simulate": {
        "check": Command("Check a trajectory, waypoints or a gait.", "commands_plan:check_command"),
        "simulate": Command("Run a gait or a file in a physics model.", "commands_simulate:simulate_command"),
        "trial": Command(
            "Measure how far the real robot went, from tracks or films.", "commands_trial:trial_command"
        ),
    },
    "Robot": {
        "waypoints": Command("Make motor waypoints of a trajectory.", "commands_plan:waypoints_command"),
        "send": Command("Check, approve and send a waypoint file.", "commands_robot:send_command"),
        "emulate": Command("Run an emulated robot on a line.", "commands_robot:emulate_command"),
    },
    "Data and files": {
        "export": Command(
            "Write a gait or a recorded motion in another form.", "commands_files:export_command"
        ),
        "import": Command("Make a gait of another program's file.", "commands_files:import_command"),
        "restore": Command(
            "List the backups of the database, or go back to one.", "commands_restore:restore_command"
        ),
    },
    "Measure": {
        "bench": Command("Measure the figures of the documentation.", "commands_bench:bench_command"),
    },
}
"""Headings of `footfall --help`; below each its commands."""

COMMANDS = {name: command for commands in COMMAND_GROUPS.values() for name, command in commands.items()}

_WIDTH = 12
"""Of the column of names."""


def grouped_commands() -> str:
    """The end of `footfall --help`: each group with its commands."""
    groups = (
        "\n".join([f"{title}:", *(f"  {name:{_WIDTH}}{command.line}" for name, command in commands.items())])
        for title, commands in COMMAND_GROUPS.items()
    )
    return "\n\n".join([*groups, "footfall COMMAND --help explains a command and its options."])
