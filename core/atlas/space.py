"""A space of gaits: what varies and how, so that gait k of a space is always the same gait."""

import hashlib
import json
from collections.abc import Mapping
from copy import deepcopy
from dataclasses import dataclass, replace
from enum import StrEnum
from functools import lru_cache
from itertools import permutations
from types import MappingProxyType
from typing import Any

from core.arrays import Floats
from core.atlas.axes import KEYS, ROBOT, Axis, robot_key
from core.atlas.point import AtlasPoint
from core.data.tables import data_table
from core.errors import InputError
from core.gait.foot_orders import named_orders
from core.gait.gait import Orientation
from core.robot.model import RobotModel, load_robot, robot_from_table, robot_table
from core.text.documents import as_written, toml_content
from core.text.numbers import shortened

MOST_SEED = 2**31 - 1
MOST_CHANGE = 10
"""How many times a number of the robot may be larger or smaller than in its parameters file."""
MOST_TABLES = 4
"""Names before the last one in the key of a number of the robot."""
ALL_ORDERS_LEGS = 5
"""Robots with more legs have too many foot orders for “all”; those that have a name stand for them."""


class AtlasKind(StrEnum):
    """How the gaits of a space are made."""

    FAST = "fast"
    """Gaits for the robot's clock."""
    DRAWN = "drawn"
    """Drawn gaits, sampled every 0.4 s."""


@dataclass(frozen=True, eq=False)
class AtlasSpace:
    """What varies.

    Args:
        robot: its name.
        kind: of all gaits.
        seed: of the draw.
        axes: of each key that was given, in the order of the draw.
    """

    robot: str
    kind: AtlasKind
    seed: int
    axes: Mapping[str, Axis]

    @property
    def varying(self) -> tuple[str, ...]:
        """Keys with more than one value, in the order of the draw."""
        return tuple(name for name, axis in self.axes.items() if axis.varies)

    def content(self) -> dict[str, Any]:
        """As JSON content, from which `space_from_table` makes it again."""
        vary = {name: axis.content() for name, axis in self.axes.items()}
        return {"robot": self.robot, "kind": self.kind.value, "seed": self.seed, "vary": vary}

    @property
    def hash(self) -> str:
        """SHA-256 of what is drawn; the robot has a hash of its own."""
        return hashlib.sha256(json.dumps(self.content(), sort_keys=True).encode()).hexdigest()

    @property
    def robot_hash(self) -> str:
        """SHA-256 of the robot's parameters, before any of them varies."""
        return load_robot(self.robot).parameters_hash

    def point(self, number: int, places: Floats) -> AtlasPoint:
        """The gait at some place of the space.

        Args:
            number: of the gait.
            places: (keys that vary,) from 0 up to, not including, 1.
        """
        drawn = dict(zip(self.varying, places.tolist(), strict=True))
        values = {name: axis.value(drawn.get(name, 0.0)) for name, axis in self.axes.items()}
        numbers = tuple((name, value) for name, value in values.items() if name.startswith(ROBOT))
        own = {name: value for name, value in values.items() if not name.startswith(ROBOT)}
        model = self.model(numbers)
        own.setdefault("order", usual_order(model))
        own.setdefault("margin", model.margin)
        return AtlasPoint(number=number, robot=self.robot, numbers=numbers, **own)

    def drawn_by(self, seed: int | None) -> "AtlasSpace":
        """The same space with another seed; None for its own.

        Raises:
            InputError: it is no whole number, or too large.
        """
        return self if seed is None else replace(self, seed=_seed(seed))

    def model(self, numbers: tuple[tuple[str, float], ...]) -> RobotModel:
        """The robot with some numbers of its parameters file changed.

        Args:
            numbers: keys such as `robot.leg.link_length`, and their values.
        """
        return varied_robot(self.robot, numbers)


@lru_cache(maxsize=256)
def varied_robot(name: str, numbers: tuple[tuple[str, float], ...]) -> RobotModel:
    """A robot with some numbers of its parameters file changed.

    Raises:
        InputError: there is no such robot, or no such number.
    """
    if not numbers:
        return load_robot(name)
    table = deepcopy(robot_table(name))
    for key, value in numbers:
        section, last = _place(table, name, key)
        section[last] = value
    return robot_from_table(table, f"{name}.toml")


def robot_number(name: str, key: str) -> float:
    """A number of a robot's parameters file.

    Raises:
        InputError: there is no such robot, or no such number.
    """
    section, last = _place(robot_table(name), name, key)
    return float(section[last])


def _place(table: dict[str, Any], name: str, key: str) -> tuple[dict[str, Any], str]:
    """The table that has a number of a robot, and the number's key in it."""
    *path, last = key.removeprefix(ROBOT).split(".")
    section: Any = table
    for part in path:
        section = section.get(part) if isinstance(section, dict) else None
    is_number = isinstance(section, dict) and isinstance(section.get(last), float | int)
    if not is_number or isinstance(section[last], bool):
        raise InputError(
            f"{shortened(key)} is no number of {name}.toml. Write robot.TABLE.KEY, such as "
            "robot.leg.link_length.",
            key,
        )
    return section, last


def space_from_toml(text: str | bytes, where: str) -> AtlasSpace:
    """Reads a space file.

    Raises:
        InputError: it is no TOML of plain numbers, or `space_from_table` refuses it.
    """
    return space_from_table(toml_content(text, where), where)


def space_from_table(table: Mapping[str, Any], where: str) -> AtlasSpace:
    """Makes a space of what a file holds.

    Args:
        table: `robot`, `kind`, `seed` and `vary`.
        where: the file, for sentences.

    Raises:
        InputError: a key is unknown, a range is empty, or a value does not fit.
    """
    for key in sorted(map(str, set(table) - {"robot", "kind", "seed", "vary"})):
        raise InputError(
            f"{where} has the unknown key {shortened(key)}. A space has robot, kind, seed and [vary].", key
        )
    robot = table.get("robot", "deltawalker")
    if not isinstance(robot, str):
        raise InputError(f"robot is {as_written(robot)}; it must be the name of a robot.", "robot")
    model = load_robot(robot)
    kinds = [kind.value for kind in AtlasKind]
    if table.get("kind", "fast") not in kinds:
        raise InputError(
            f"kind is {as_written(table['kind'])}; it must be one of {', '.join(kinds)}.", "kind"
        )
    kind, seed = AtlasKind(table.get("kind", "fast")), _seed(table.get("seed", 0))
    vary = table.get("vary")
    if not isinstance(vary, Mapping) or not vary:
        raise InputError(f"{where} has no table [vary], which says what varies.", "vary")
    axes = _axes(vary, model, where)
    _require_fitting(axes, kind, model)
    return AtlasSpace(robot, kind, seed, MappingProxyType(axes))


def _seed(value: Any) -> int:
    if isinstance(value, bool) or not isinstance(value, int) or not 0 <= value <= MOST_SEED:
        raise InputError(
            f"seed is {as_written(value)}; it must be a whole number from 0 to {MOST_SEED}.", "seed"
        )
    return value


def default_space(robot: str) -> AtlasSpace:
    """The space that comes with the program for a robot.

    Raises:
        InputError: there is no such robot, or none of its gaits can walk.
    """
    model = load_robot(robot)
    table = data_table("atlas.toml")
    found = table.get(robot, table["deltawalker"] if model.leg_count == 4 else table["other"])
    if model.leg_count < 4:
        raise InputError(
            f"{model.title} has {model.leg_count} legs. A gait for the robot's clock needs four; give a "
            'space with kind = "drawn" (--space).',
            "--robot",
        )
    return space_from_table({**found, "robot": robot}, "the default space")


def usual_order(model: RobotModel) -> tuple[int, ...]:
    """The foot order where a space has none."""
    return named_orders(model, Orientation.FBS)[0].feet


def _axes(vary: Mapping[str, Any], model: RobotModel, where: str) -> dict[str, Axis]:
    """The axes in the order of the draw: the gait's keys, then the robot's numbers by name."""
    flat = {str(name): value for name, value in vary.items() if name != "robot"}
    flat |= _flat(ROBOT.rstrip("."), vary.get("robot", {}))
    unknown = [name for name in flat if name not in KEYS and not name.startswith(ROBOT)]
    if unknown:
        raise InputError(
            f"[vary] in {where} has the unknown key {shortened(unknown[0])}. It may have {', '.join(KEYS)}, "
            "and robot.TABLE.KEY for a number of the robot's parameters file.",
            unknown[0],
        )
    axes = {name: key.axis(flat[name]) for name, key in KEYS.items() if name in flat}
    if "order" in axes:
        axes["order"] = _orders(axes["order"], model)
    for name in sorted(name for name in flat if name.startswith(ROBOT)):
        usual = robot_number(model.name, name)
        axes[name] = robot_key(name).axis(flat[name])
        for value in axes[name].ends:
            _require_near(name, value, usual)
            varied_robot(model.name, ((name, value),))
    _require_legs(axes, model)
    return axes


def _require_near(name: str, value: float, usual: float) -> None:
    """A number of the robot stays within `MOST_CHANGE` times what the robot's file has.

    Raises:
        InputError: it does not.
    """
    least, most = sorted((usual / MOST_CHANGE, usual * MOST_CHANGE))
    if not least <= value <= most:
        raise InputError(
            f"{name} is {value:g}; it must lie between {least:g} and {most:g}: the robot's parameters file "
            f"has {usual:g}, and it may be {MOST_CHANGE} times larger or smaller.",
            name,
        )


def _require_legs(axes: Mapping[str, Axis], model: RobotModel) -> None:
    """Links are longer than the way from the motors' circle to the platform's, whatever is drawn.

    Raises:
        InputError: they are not.
    """
    base, platform, link = (
        axes[key].ends if key in axes else (robot_number(model.name, key),) * 2
        for key in (f"{ROBOT}leg.{name}" for name in ("base_radius", "platform_radius", "link_length"))
    )
    way = max(base[1] - platform[0], platform[1] - base[0])
    if link[0] <= way:
        raise InputError(
            f"robot.leg.link_length is {link[0]:g} m at least, and a link has to bridge {way:g} m between "
            "robot.leg.base_radius and robot.leg.platform_radius. Make links longer, or the radii alike.",
            f"{ROBOT}leg",
        )


def _flat(prefix: str, value: Any) -> dict[str, Any]:
    """Nested tables as dotted keys; a table of choices is a value."""
    if not isinstance(value, Mapping) or "choices" in value or prefix.count(".") > MOST_TABLES:
        return {prefix: value}
    return {name: one for key, part in value.items() for name, one in _flat(f"{prefix}.{key}", part).items()}


def _orders(axis: Axis, model: RobotModel) -> Axis:
    """Foot orders, with “all” written out; each begins as it is written."""
    legs, listed = model.leg_count, []
    for order in axis.choices:
        if order == "all":
            listed += all_orders(model)
            continue
        if sorted(order) != list(range(1, legs + 1)):
            raise InputError(
                f"order is {shortened(','.join(map(str, order)))}; it must name each foot 1 to {legs} once.",
                "order",
            )
        listed.append(order)
    return Axis(choices=tuple(dict.fromkeys(listed)))


def all_orders(model: RobotModel) -> list[tuple[int, ...]]:
    """Every foot order that begins with foot 1; of robots with many legs those that have a name."""
    legs = model.leg_count
    if legs <= ALL_ORDERS_LEGS:
        return [(1, *rest) for rest in permutations(range(2, legs + 1))]
    named = [order.feet for way in Orientation for order in named_orders(model, way)]
    return list(dict.fromkeys(named))


def _require_fitting(axes: Mapping[str, Axis], kind: AtlasKind, model: RobotModel) -> None:
    """Limbs that are held up are the robot's, and the kind can have what varies.

    Raises:
        InputError: naming the key.
    """
    lost = axes["lost"].choices if "lost" in axes else ((),)
    for limbs in lost:
        if len(set(limbs)) != len(limbs) or not set(limbs) <= set(range(1, model.leg_count + 1)):
            named = shortened(",".join(map(str, limbs)))
            raise InputError(
                f"lost is {named}; it must name limbs 1 to {model.leg_count}, each once.", "lost"
            )
    if kind is AtlasKind.FAST and any(lost):
        raise InputError(
            "lost holds limbs up, and in a gait for the robot's clock every foot steps. Write "
            'kind = "drawn", or leave lost out.',
            "lost",
        )
    if kind is AtlasKind.FAST and model.leg_count < 4:
        raise InputError(
            f"{model.title} has {model.leg_count} legs; a gait for the robot's clock needs at least four. "
            'Write kind = "drawn".',
            "robot",
        )
    for name in ("overlap", "moves") if kind is AtlasKind.DRAWN else ():
        if name in axes:
            raise InputError(f'{name} is for gaits of kind = "fast"; leave it out.', name)
