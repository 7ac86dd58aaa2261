"""How a robot's mass is spread over the parts that move apart: body, knees and feet."""

from dataclasses import dataclass

from core.errors import InputError
from core.physics.parameters import PhysicsSet, physics_set
from core.robot.model import RobotModel

RODS_PER_ARM = 2


@dataclass(frozen=True)
class PartMasses:
    """What each part weighs, kg; half of every rod moves with its knee and half with its foot.

    Args:
        body: everything that does not move against the actuator plane.
        knee: one motor's moving part with its half of two rods.
        foot: one foot with its half of six rods.
    """

    body: float
    knee: float
    foot: float

    def total(self, model: RobotModel) -> float:
        """The whole robot, kg."""
        return self.body + model.motor_count * self.knee + model.leg_count * self.foot


def part_masses(model: RobotModel, physics: PhysicsSet) -> PartMasses:
    """Masses by one of the robot's own sets.

    `model` has body and feet alone. `published` has every part: plate and motors make the body. `scales` is
    one total: knees, rods and feet as published, and the body is what remains, which is about what twelve
    motors of 15 g (data sheet) with frames and board weigh.

    Args:
        model: the robot.
        physics: names the set, and a factor on the body's mass.

    Raises:
        InputError: the robot's file has no such set.
    """
    name, sets = physics.masses, model.mass_sets
    if name not in sets or (name == "scales" and "published" not in sets):
        raise InputError(
            f"{model.title} has no masses “{name}”; choose physics whose masses are one of: "
            f"{', '.join(sets)}.",
            "physics",
        )
    if name == "model":
        masses = PartMasses(model.masses.body, 0.0, model.masses.foot)
    else:
        parts = sets["published"]
        knee = parts["knee"] + RODS_PER_ARM * parts["rod"] / 2
        foot = parts["foot"] + 3 * RODS_PER_ARM * parts["rod"] / 2
        masses = PartMasses(parts["base_plate"] + model.motor_count * parts["motor"], knee, foot)
        if name == "scales":
            body = sets["scales"]["total"] - model.motor_count * knee - model.leg_count * foot
            masses = PartMasses(body, knee, foot)
    return PartMasses(masses.body * physics.body_mass_factor, masses.knee, masses.foot)


def default_physics(model: RobotModel) -> PhysicsSet:
    """The set to simulate a robot with: by the scales where it was weighed, else the optimiser's masses."""
    return physics_set("scales" if "scales" in model.mass_sets else "model")


def physics_for(model: RobotModel, name: str | None = None) -> PhysicsSet:
    """The set of a name, or the robot's default."""
    return default_physics(model) if name is None else physics_set(name)
