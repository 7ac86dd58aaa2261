"""Parameters of the physics that are not in the robot's own file, as named sets with their sources."""

from dataclasses import dataclass
from functools import cache

from core.data.tables import data_table
from core.errors import InputError


@dataclass(frozen=True)
class PhysicsSet:
    """A named set of physics parameters.

    Args:
        name: what files and records call it.
        title: what a person reads.
        masses: which set of masses of the robot's file: `scales`, `published` or `model`.
        friction: coefficient of friction between sole and ground.
        link_stiffness: of the soft link in series with each motor along its stroke, N/m: hinges, knee and
            screw; the rods between keep their length.
        motor_speed: share of the robot's full motor speed that is there.
        motor_force: the most that a motor pushes or pulls, N.
        weak_motor: motor of the wire's order whose speed and force are `weak_share` of the others', or None.
        weak_share: see `weak_motor`.
        ground_tilt: (about x, about y) slope of the ground, rad.
        body_mass_factor: on the body's mass.
        centre_offset: (x, y) of the body's own centre of mass from its axis, in the robot's axes, m.
        cable_drag: force with which the cable holds a body that moves along the ground back, N.
        backlash: play between a motor and its knee; a motor that turns round moves so far without it, m.
        gravity: m/s².
    """

    name: str
    title: str
    masses: str
    friction: float
    link_stiffness: float
    motor_speed: float
    motor_force: float
    weak_motor: int | None = None
    weak_share: float = 1.0
    ground_tilt: tuple[float, float] = (0.0, 0.0)
    body_mass_factor: float = 1.0
    centre_offset: tuple[float, float] = (0.0, 0.0)
    cable_drag: float = 0.0
    backlash: float = 0.0
    gravity: float = 9.81


@cache
def physics_sets() -> dict[str, PhysicsSet]:
    """The sets that come with the program, by name; the first is the default."""
    return {name: PhysicsSet(name=name, **table) for name, table in data_table("physics.toml").items()}


def physics_set(name: str | None = None) -> PhysicsSet:
    """A set by name, or the default.

    Raises:
        InputError: there is none of that name.
    """
    sets = physics_sets()
    chosen = next(iter(sets)) if name is None else name
    if chosen not in sets:
        raise InputError(f"There is no physics set “{chosen}”; choose one of {', '.join(sets)}.", "physics")
    return sets[chosen]
