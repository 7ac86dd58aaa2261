"""The commands of `footfall`, grouped by what a person wants to do."""

COMMAND_GROUPS = {
    "Studio": {
        "serve": "Serve the studio and print its address.",
        "doctor": "Say whether this computer has all that is needed.",
    },
    "Design": {
        "gaits": "List built-in and saved gaits.",
        "manual": "Make the trajectory of a gait made by hand.",
        "optimise": "Find the best trajectory of a gait.",
    },
    "Search": {
        "fastest": "Find the fastest walk on the robot.",
        "atlas": "Evaluate thousands of gaits, and find the best.",
        "frontier": "Find the largest step of a gait, and what limits it.",
        "pattern": "Find the best footfall pattern.",
    },
    "Check and simulate": {
        "check": "Check a trajectory, waypoints or a gait.",
        "simulate": "Run a gait or a file in a physics model.",
        "trial": "Measure how far the real robot went, from tracks or films.",
    },
    "Robot": {
        "waypoints": "Make motor waypoints of a trajectory.",
        "send": "Check, approve and send a waypoint file.",
        "emulate": "Run an emulated robot on a line.",
    },
    "Data and files": {
        "export": "Write a gait or a recorded motion in another form.",
        "import": "Make a gait of another program's file.",
        "restore": "List the backups of the database, or go back to one.",
    },
    "Measure": {
        "bench": "Measure the figures of the documentation.",
    },
}
"""Headings of `footfall --help`; below each its commands with one line each."""

_WIDTH = 12
"""Of the column of names."""


def grouped_commands() -> str:
    """The end of `footfall --help`: each group with its commands."""
    groups = (
        "\n".join([f"{title}:", *(f"  {name:{_WIDTH}}{line}" for name, line in commands.items())])
        for title, commands in COMMAND_GROUPS.items()
    )
    return "\n\n".join([*groups, "footfall COMMAND --help explains a command and its options."])
