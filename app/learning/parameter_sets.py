"""Named, versioned sets of physics parameters that were learned from trials; any thread may ask."""

import time
from dataclasses import dataclass

from app.common.json import Json
from app.simulation.problem import fitting_sets, physics_content, physics_from_content
from app.store.database import Database
from app.store.tables.learning_store import LearningStore
from core.errors import InputError, NotFoundError
from core.physics.masses import default_physics
from core.physics.parameters import PhysicsSet, physics_sets
from core.robot.model import RobotModel


@dataclass(frozen=True)
class ParameterSet:
    """A set of parameters that a person named.

    Args:
        name: as given.
        version: counts the sets of a name from 1.
        robot: name of the robot whose trials they were.
        physics: the parameters; their name is the set's with its version.
        learning: which course of learning it came from.
        made: when, s since the epoch.
        by: who named it.
        note: in a few words, from what.
    """

    name: str
    version: int
    robot: str
    physics: PhysicsSet
    learning: str
    made: float
    by: str
    note: str

    @property
    def line(self) -> Json:
        """As pages and scripts get it; the parameters are SI."""
        words = {key: value for key, value in vars(self).items() if key != "physics"}
        parameters = physics_content(self.physics)
        return {**words, "key": self.physics.name, "title": self.physics.title, "physics": parameters}


class ParameterSets:
    """The sets.

    Args:
        database: where they are kept.
    """

    def __init__(self, database: Database) -> None:
        self._store = LearningStore(database)

    def found(self, *, deleted: bool = False) -> tuple[ParameterSet, ...]:
        """All sets, or the deleted ones, the newest first."""
        return self._store.sets(_set, deleted=deleted).rows

    def unreadable(self, *, deleted: bool = False) -> list[Json]:
        """Sets that cannot be read."""
        return self._store.sets(_set, deleted=deleted).unreadable

    def physics(self) -> tuple[PhysicsSet, ...]:
        """Every set of parameters there is: those of the program, then the learned ones."""
        return (*physics_sets().values(), *(one.physics for one in self.found()))

    def fitting(self, model: RobotModel) -> tuple[PhysicsSet, ...]:
        """Those that fit a robot, its usual one first; learned ones fit the robot they were learned of."""
        learned = (one.physics for one in self.found() if one.robot == model.name)
        return (*fitting_sets(model), *learned)

    def chosen(self, model: RobotModel, name: str | None) -> PhysicsSet:
        """A set by name for a robot, or its usual one.

        Raises:
            InputError: there is none of that name for it.
        """
        if name is None:
            return default_physics(model)
        sets = {one.name: one for one in (*physics_sets().values(), *self.fitting(model))}
        if name not in sets:
            raise InputError(
                f"There is no physics set “{name}” for {model.title}; choose one of {', '.join(sets)}.",
                "physics",
            )
        return sets[name]

    def save(
        self, name: str, by: str, robot: str, physics: PhysicsSet, learning: str, note: str
    ) -> ParameterSet:
        """Keeps parameters as the next version of a name.

        Args:
            name: of the set.
            by: who names it.
            robot: whose trials they were.
            physics: the parameters.
            learning: which course of learning they came from.
            note: in a few words, from what.

        Raises:
            InputError: the name is empty.
        """
        name = " ".join(name.split())
        if not name:
            raise InputError("The set has no name; give it one.", "name")
        content = {
            "name": name,
            "robot": robot,
            "physics": physics_content(physics),
            "learning": learning,
            "made": time.time(),
            "by": by,
            "note": note,
        }
        version = self._store.add_set(name, content)
        return _set({**content, "version": version})

    def delete(self, name: str, version: int) -> None:
        """Takes a set out of the list; what was simulated with it counts as stale.

        Raises:
            NotFoundError: there is none.
        """
        self._put(name, version, time.time())

    def restore(self, name: str, version: int) -> ParameterSet:
        """Brings a deleted set back.

        Raises:
            NotFoundError: there is none.
        """
        self._put(name, version, None)
        return next(one for one in self.found() if (one.name, one.version) == (name, version))

    def _put(self, name: str, version: int, deleted: float | None) -> None:
        if not self._store.put_set_deleted(name, version, deleted):
            raise NotFoundError(f"There is no set “{name}”, version {version}.", "name")


def _set(content: Json) -> ParameterSet:
    key = f"{content['name']}, version {content['version']}"
    named = {**content["physics"], "name": key, "title": f"{key} ({content['note']})"}
    physics = physics_from_content(named)
    return ParameterSet(**{**content, "physics": physics})
