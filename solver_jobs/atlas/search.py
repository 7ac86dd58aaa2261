"""Motions of many gaits with one layout: convex steps until every limit is kept, or no step helps."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from core.arrays import SAME, Bools, Floats, first_highest
from core.pose_gaits.pose_problem import SHORTEST_MOVE, PoseBounds
from solver_jobs.atlas.convex_step import ConvexStep
from solver_jobs.atlas.layout import MM, Asked, Layout
from solver_jobs.atlas.postures import Poses, Postures
from solver_jobs.atlas.rows import ROOM, Family, all_rows

FARTHEST = (10.0, 10.0, 8.0, 5.0, 5.0)
"""Largest change of an unknown in each step, mm."""
HOPELESS = (6.0, 2.0, 0.7, 0.3, 0.1)
"""A gait whose linearised limits are missed by more than this in a step is given up, mm."""
LENGTHENING = (5.0, 3.0)
"""Largest change of an unknown in the steps that make short moves longer, mm."""
POLISHING = (2.0, 1.0, 0.5, 0.25)
"""Largest change of an unknown in the steps that follow while a limit is still missed, mm. It becomes smaller
since the two feet that place the body within a move may change from step to step."""
COLLISIONS = ("shoe distance", "arm distance")
"""Limits that keep parts of the robot from colliding."""
KEPT = 0.95 * ROOM
"""A row that is missed by less keeps its limit, mm: it asks for `ROOM` more than that."""
SLIGHT = 1e-2
"""Weight of a change itself, beside that of the motors' moves."""
PRESSES = 1e-6
Places = NDArray[np.intp]


@dataclass(eq=False)
class Found:
    """What the search has of n gaits; changed in place.

    Args:
        unknowns: (n, unknowns) mm.
        missed: (n,) by how much the linearised limits were missed in the last step, mm; inf without one.
        residual: (n,) by how much the limits themselves are missed, mm, where it was looked at last.
        limits: of each gait the limits that pressed in its last step, the hardest first.
    """

    unknowns: Floats
    missed: Floats
    residual: Floats
    limits: list[tuple[str, ...]]

    def copied(self) -> "Found":
        """The same, to be changed apart."""
        return Found(self.unknowns.copy(), self.missed.copy(), self.residual.copy(), list(self.limits))


@dataclass(frozen=True, eq=False)
class _Linearised:
    """All rows of some gaits, and the cost of a change."""

    names: NDArray[np.str_]
    room: Floats
    slopes: Floats
    curvature: Floats
    gradient: Floats


class Search:
    """The search for the motions of n gaits.

    Args:
        layout: their unknowns.
        asked: what is asked of each.
        bounds: limits that all have in common.
        height_room: how far the actuator plane of a pose may be from the height that is asked, mm.
    """

    def __init__(self, layout: Layout, asked: Asked, bounds: PoseBounds, height_room: float) -> None:
        self.layout, self.asked, self.bounds = layout, asked, bounds
        low, high = (height * MM for height in bounds.plane_height)
        self._lowest = np.maximum(asked.height - height_room, low)
        self._highest = np.minimum(asked.height + height_room, high)
        self._solver: ConvexStep | None = None

    def run(self) -> Found:
        """Searches, and then makes short moves longer where that is possible."""
        count = self.asked.count
        nothing = np.full(count, np.inf)
        found = Found(self.layout.start(self.asked), nothing.copy(), nothing.copy(), [()] * count)
        alive = np.ones(count, dtype=np.bool_)
        for farthest, hopeless in zip(FARTHEST, HOPELESS, strict=True):
            self._step(found, alive, farthest, None)
            alive &= (found.missed < hopeless) & ~(found.residual < KEPT)
            if not alive.any():
                break
        self._polish(found, found.missed < HOPELESS[-1], None)
        kept = found.residual < KEPT
        if not kept.any():
            return found
        longer, wanted = found.copied(), self._wanted_moves(found, kept)
        for farthest in LENGTHENING:
            self._step(longer, kept, farthest, wanted)
        self._polish(longer, kept & (longer.missed < KEPT), wanted)
        for gait in np.nonzero(kept & (longer.missed < KEPT) & (longer.residual < KEPT))[0]:
            found.unknowns[gait] = longer.unknowns[gait]
        return found

    def with_arms_farther(self, found: Found, places: Sequence[int], distance: float) -> Found:
        """Goes on with some gaits until their arms are so much farther apart than asked.

        Args:
            found: of the search; it stays as it is.
            places: of these gaits.
            distance: mm.
        """
        chosen = np.zeros(self.asked.count, dtype=np.bool_)
        chosen[list(places)] = True
        farther, bounds = found.copied(), self.bounds
        farther.residual[chosen], farther.missed[chosen] = np.inf, 0.0
        self.bounds = replace(bounds, arm_distance=bounds.arm_distance + distance / MM)
        self._polish(farther, chosen, None)
        self.bounds = bounds
        return farther

    def _polish(self, found: Found, chosen: Bools, wanted: Floats | None) -> None:
        """Steps until the limits themselves are kept; tells the residual of all that are chosen."""
        for farthest in (*POLISHING, 0.0):
            if not chosen.any():
                return
            self._step(found, chosen, farthest, wanted)
            chosen = chosen & (found.residual >= KEPT) & (found.missed < KEPT)

    def _step(self, found: Found, chosen: Bools, farthest: float, wanted: Floats | None) -> None:
        """One convex step of the gaits that are chosen and do not keep their limits yet.

        Args:
            found: changed in place.
            chosen: (n,).
            farthest: largest change of an unknown, mm; 0 only looks at the residual.
            wanted: (n, moves, motors) 1 or −1 where a motor is to go as far as a move needs; 0 elsewhere.
        """
        gaits = np.nonzero(chosen)[0]
        rows = self._linearised(found, gaits, wanted)
        found.residual[gaits] = np.maximum(-rows.room.min(axis=1), 0.0)
        if farthest == 0.0:
            return
        collides = np.isin(rows.names, COLLISIONS)
        if self._solver is None or rows.room.shape[1] != self._solver.given:
            self._solver = ConvexStep(self.layout.unknowns, rows.room.shape[1])
        for place, gait in enumerate(gaits):
            if found.residual[gait] < KEPT and np.isfinite(found.missed[gait]):
                continue
            step = self._solver.solve(
                rows.curvature[place],
                rows.gradient[place],
                rows.room[place],
                rows.slopes[place],
                collides,
                farthest,
            )
            if step is None:
                found.missed[gait] = np.inf
                continue
            found.unknowns[gait] += step.change
            found.missed[gait] = step.missed
            found.residual[gait] = np.inf
            found.limits[gait] = _pressing(rows.names, step.pressures)

    def _linearised(self, found: Found, gaits: Places, wanted: Floats | None) -> _Linearised:
        postures = Postures(self.layout, self.asked.of(gaits))
        unknowns = found.unknowns[gaits]
        poses = postures.poses(unknowns)
        families = all_rows(postures, self.bounds, poses, postures.within(poses))
        families.append(self._heights(unknowns, gaits))
        change, slopes = self._changes(poses)
        if wanted is not None:
            families.append(self._long_moves(change, slopes, wanted[gaits], gaits))
        flat = slopes.reshape(len(gaits), -1, self.layout.unknowns)
        transposed = np.swapaxes(flat, 1, 2)
        return _Linearised(
            names=np.concatenate([[family.limit] * family.room.shape[1] for family in families]),
            room=np.concatenate([family.room for family in families], axis=1),
            slopes=np.concatenate(
                [np.broadcast_to(f.slopes, (len(gaits), *f.slopes.shape[1:])) for f in families], axis=1
            ),
            curvature=transposed @ flat + SLIGHT * np.eye(self.layout.unknowns),
            gradient=(transposed @ change.reshape(len(gaits), -1, 1))[..., 0],
        )

    def _changes(self, poses: Poses) -> tuple[Floats, Floats]:
        """How far each motor goes in each move, (n, moves, motors) mm, and the slopes of that."""
        count, moves = len(poses.strokes), self.layout.move_count
        change = np.diff(poses.strokes, axis=1).reshape(count, moves, -1)
        slopes = np.diff(poses.stroke_slopes, axis=1)
        return change, slopes.reshape(*change.shape, self.layout.unknowns)

    def _heights(self, unknowns: Floats, gaits: Places) -> Family:
        """The actuator plane of each pose."""
        heights = unknowns[:, self.layout.height_places]
        rows = np.zeros((heights.shape[1], self.layout.unknowns))
        rows[np.arange(len(rows)), self.layout.height_places] = 1.0
        lowest, highest = self._lowest[gaits][:, None] + ROOM, self._highest[gaits][:, None] - ROOM
        room = [heights - lowest, highest - heights]
        return Family("body height", np.concatenate(room, axis=1), np.concatenate([rows, -rows])[None])

    def _wanted_moves(self, found: Found, chosen: Bools) -> Floats:
        """(n, moves, motors) the sign of the motor that goes farthest in each move, 0 elsewhere."""
        gaits = np.nonzero(chosen)[0]
        poses = Postures(self.layout, self.asked.of(gaits)).poses(found.unknowns[gaits])
        change, _ = self._changes(poses)
        farthest = first_highest(np.abs(change), SAME * MM, axis=-1)[..., None]
        signs = np.sign(np.take_along_axis(change, farthest, axis=-1))
        wanted = np.zeros((self.asked.count, *change.shape[1:]))
        made = np.zeros_like(change)
        np.put_along_axis(made, farthest, signs, axis=-1)
        wanted[gaits] = made
        return wanted

    def _long_moves(self, change: Floats, slopes: Floats, wanted: Floats, gaits: Places) -> Family:
        """The motor that goes farthest goes at least as far as costs no more time."""
        motor = np.abs(wanted).argmax(axis=-1)[..., None]
        sign = np.take_along_axis(wanted, motor, axis=-1)
        far = (sign * np.take_along_axis(change, motor, axis=-1))[..., 0]
        own = sign * np.take_along_axis(slopes, motor[..., None], axis=2)[:, :, 0]
        least = np.minimum(SHORTEST_MOVE * MM, self.asked.longest[gaits] - 2.0 * ROOM)
        return Family("short move", far - least[:, None], own)


def _pressing(names: NDArray[np.str_], pressures: Floats) -> tuple[str, ...]:
    """The limits that press, the hardest first."""
    total: dict[str, float] = {}
    for place in np.nonzero(pressures > PRESSES)[0]:
        total[str(names[place])] = total.get(str(names[place]), 0.0) + float(pressures[place])
    return tuple(sorted(total, key=lambda name: -float(f"{total[name]:.3g}")))
