"""The program of a pose gait: its unknowns and rows, in mm.

Unknowns are the body and the swinging feet at every pose, the footholds, the length of every move, the step,
and body and feet at fractions of every move. A move is straight in motor space: at a fraction m of it the
strokes are (1 − m) h_k + m h_{k+1}, and what body and feet do there has to be found. Standing feet may leave
their footholds a little within a move, since motors that go straight do not keep them exactly.
"""

from itertools import combinations

import numpy as np
from casadi import DM, SX, Function, horzcat, sqrt, sum1, sumsqr, vertcat

from core.arrays import Floats
from core.pose_gaits.pose_gait import PoseGait
from core.pose_gaits.pose_problem import FRACTIONS, MOST_TURN, REST_HEIGHT, SHORTEST_MOVE, PoseProblem
from core.pose_gaits.start_motion import MM, PosesStart, StartMotion
from core.wire.robot_time import RAMP_SPEED
from solver_jobs.pose_gaits.arms import NO_ARMS, ArmPlace, ArmRows, arm_corners
from solver_jobs.pose_gaits.postures import Posture, leg_strokes, plane_height
from solver_jobs.pose_gaits.program import Program, Row
from solver_jobs.pose_gaits.turning import turned
from solver_jobs.pose_gaits.weights import SLACKS

STROKE_ROOM = 0.001
"""Strokes stay this much within their range, so that a rounded file does, mm."""
SHOE_ROOM = 0.05
"""Feet stay this much farther apart at the fractions, so that they do between them, mm."""
TURNED_SHOE_ROOM = 0.2
"""The same in a gait that turns or sways, whose feet swing in arcs, mm."""
HIGHEST_FOOT = 20.0
FAR = 3000.0
"""No unknown is farther than this, mm."""
LEAST_NORMAL = 0.25
"""Least squared length of a plane's normal: one of length 0 would separate nothing."""
LEVER = 80.0
"""Unknown angles stand as the way at this distance from the body's axis, mm: all unknowns are of one size."""


def asked_reach(problem: PoseProblem) -> float:
    """Step a cycle that is given, or on the spot the turn as a way at `LEVER`, mm; 0 for a free step."""
    return abs(problem.turn) * LEVER if problem.on_the_spot else (problem.step or 0.0) * MM


class PoseProgram:
    """The compiled program of a problem.

    The unknowns of its planes between arms come last, so that a program with other planes has the same
    unknowns before them.

    Args:
        problem: what is asked.
        step_guess: step a cycle from which the search starts, m.
        arms: that have to keep apart.
        start: from which the search starts; None for a body that goes on evenly.
    """

    def __init__(
        self,
        problem: PoseProblem,
        step_guess: float,
        arms: ArmRows = NO_ARMS,
        start: StartMotion | PosesStart | None = None,
    ) -> None:
        self.problem = problem
        self.arms = arms
        self.program = Program()
        self._model = problem.model
        self._bounds = problem.bounds
        self._guess = start or StartMotion(problem, step_guess * MM)
        self._turn_guess = self._guess.headings[-1] - self._guess.headings[0]
        self._longest = problem.largest_move * MM
        self._shortest = min(SHORTEST_MOVE * MM, self._longest)
        self._deviations: list[SX] = []
        self._within: dict[tuple[int, float], Posture] = {}
        self._slack_symbols = {
            name: self.program.variable(f"slack {name}", [0.0], [0.0], [0.0]) for name in SLACKS
        }
        self.reach_place = self.program.variable_count
        self.step, self.turn, self.reach = self._way(step_guess)
        count = problem.move_count
        self.lengths = self.program.variable(
            "lengths",
            [self._shortest] * count,
            [self._longest + 40.0] * count,
            [min(8.0, self._longest)] * count,
        )
        self.program.bound(
            self.lengths - self._slack_symbols["stop bound"], -np.inf, self._longest, Row("stop bound")
        )
        self._add_poses()
        self._add_moves()
        self._add_fractions()
        self.own_count = self.program.variable_count
        self._keep_arms_apart()
        self._compile()

    def _way(self, step_guess: float) -> tuple[SX | float, SX | float, SX]:
        """Step and turn a cycle, mm and rad, and whichever of them is an unknown, as a way in mm."""
        problem = self.problem
        if not problem.on_the_spot:
            step = self.program.variable("step", [1.0], [200.0], [step_guess * MM])
            return step, problem.turn, step
        sign = 1.0 if problem.turn > 0.0 else -1.0
        start = abs(self._turn_guess) / problem.all_cycles * LEVER
        reach = self.program.variable("turn", [1.0], [MOST_TURN * LEVER], [start])
        return 0.0, sign * reach / LEVER, reach

    # Poses

    def _add_poses(self) -> None:
        problem = self.problem
        low, high = (height * MM for height in self._bounds.plane_height)
        first = self.program.variable_count
        self.bodies = [
            self.program.variable(f"body {pose}", [-FAR, -FAR, low], [FAR, FAR, high], start.tolist())
            for pose, start in enumerate(self._guess.bodies)
        ]
        self.body_places = tuple(range(first, self.program.variable_count, 3))
        self.headings = [
            self._heading(f"sway {pose}", pose / problem.move_count, heading)
            for pose, heading in enumerate(self._guess.headings)
        ]
        self._add_ends()
        self.feet = self._pose_feet()
        self.strokes = [
            vertcat(*(leg_strokes(self._model, leg, body, foot, heading) for leg, foot in enumerate(feet)))
            for feet, body, heading in zip(self.feet, self.bodies, self.headings, strict=True)
        ]
        for pose in range(problem.move_count + 1):
            self._bound_strokes(pose)
            self._keep_apart(self.feet[pose], None)
            if not problem.airborne[pose].any():
                self._balance(self.bodies[pose], self.feet[pose], list(range(self._model.leg_count)), None)

    def _heading(self, name: str, share: float, start: float) -> SX | float:
        """The heading after a share of the way, rad: an even turn, and an unknown where it may sway.

        Args:
            name: of the unknown.
            share: of the way, 0 to 1.
            start: heading from which the search starts, rad.
        """
        even = share * self.problem.all_cycles * self.turn
        if self.problem.sway == 0.0:
            return even
        most = self.problem.sway * LEVER
        away = start - share * self._turn_guess
        return even + self.program.variable(name, [-most], [most], [away * LEVER]) / LEVER

    def _add_ends(self) -> None:
        """Where the body ends and how it is turned there; from rest to rest also the height of both ends."""
        problem, first, last = self.problem, self.bodies[0], self.bodies[-1]
        travel = self._travel()
        self.program.bound(first[:2], 0.0, 0.0)
        self.program.bound(last[:2] - travel, 0.0, 0.0)
        self.program.bound(last[2] - first[2], 0.0, 0.0)
        if problem.sway > 0.0:
            turn = self.headings[-1] - self.headings[0] - problem.all_cycles * self.turn
            self.program.bound(SX(turn * LEVER), 0.0, 0.0)
            if problem.cycles is not None:
                self.program.bound(SX(self.headings[0] * LEVER), 0.0, 0.0)
        for pin in problem.pinned:
            even = travel * ((pin.pose - 1) / problem.move_count)
            away = self.bodies[pin.pose - 1][:2] - even - DM(problem.pinned_offset(pin) * MM)
            self.program.bound(away, 0.0, 0.0)
        if problem.cycles is not None:
            self.program.bound(first[2], REST_HEIGHT * MM, REST_HEIGHT * MM)

    def _travel(self) -> SX:
        """From the first place of the body to the last."""
        return SX(self.step) * DM(self.problem.whole_travel())

    def _pose_feet(self) -> list[list[SX]]:
        """Each foot at each pose: its foothold, the same for as long as it stands, or a place in the air."""
        problem, legs = self.problem, self._model.leg_count
        feet: list[list[SX]] = [[] for _ in range(problem.move_count + 1)]
        for leg in range(legs):
            first = self._first_foothold(leg)
            last = self._last_foothold(leg, first)
            foothold: SX | None = first
            for pose in range(problem.move_count + 1):
                start = list(self._guess.feet[pose][leg])
                if problem.airborne[pose, leg]:
                    lowest = problem.floor[pose, leg] * MM
                    foot = self.program.variable(
                        f"air {pose} {leg}", [-FAR, -FAR, -1.0], [FAR, FAR, HIGHEST_FOOT], start
                    )
                    self.program.bound(
                        foot[2] + self._slack_symbols["clearance"],
                        lowest,
                        row=Row("clearance", min(pose, problem.move_count - 1), leg),
                    )
                    foothold = None
                else:
                    if foothold is None:
                        is_last = not problem.airborne[pose:, leg].any()
                        foothold = last if is_last else self._foothold(pose, leg, start)
                    foot = vertcat(foothold, 0.0)
                feet[pose].append(foot)
        return feet

    def _foothold(self, pose: int, leg: int, start: list[float]) -> SX:
        return self.program.variable(f"foothold {pose} {leg}", [-FAR] * 2, [FAR] * 2, start[:2])

    def _first_foothold(self, leg: int) -> SX:
        home = self._model.module_centres_robot[leg, :2] * MM
        if self.problem.cycles is not None:
            return SX(DM(home))
        return self._foothold(0, leg, list(self._guess.feet[0][leg]))

    def _last_foothold(self, leg: int, first: SX) -> SX:
        """Where a foot ends: where it began, moved on with the body."""
        away = first - self.bodies[0][:2]
        return self.bodies[-1][:2] + turned(away, self.turn * self.problem.all_cycles)

    def _bound_strokes(self, pose: int) -> None:
        stroke = self._model.stroke
        for leg in range(self._model.leg_count):
            row = Row("stroke", min(pose, self.problem.move_count - 1), leg)
            strokes = self.strokes[pose][3 * leg : 3 * leg + 3]
            self.program.bound(strokes, stroke.lower * MM + STROKE_ROOM, stroke.upper * MM - STROKE_ROOM, row)
        coupling = self._model.coupling
        for column in coupling.T:
            shared = np.nonzero(column)[0]
            for motor in shared[1:]:
                difference = self.strokes[pose][int(motor)] - self.strokes[pose][int(shared[0])]
                self.program.bound(difference, 0.0, 0.0, Row("coupling", None, int(motor) // 3))

    # Moves

    def _add_moves(self) -> None:
        """No motor goes farther than its move is long; standing feet balance the body at both ends."""
        self.changes: list[slice] = []
        for move in range(self.problem.move_count):
            change = self.strokes[move + 1] - self.strokes[move]
            self.program.bound(self.lengths[move] - change, 0.0)
            self.program.bound(self.lengths[move] + change, 0.0)
            self.changes.append(self.program.bound(change, -np.inf))
            standing = self._standing(move)
            if len(standing) < self._model.leg_count:
                for pose in (move, move + 1):
                    self._balance(self.bodies[pose], self.feet[pose], standing, move)

    def _standing(self, move: int) -> list[int]:
        return [int(leg) for leg in np.nonzero(~self.problem.moving[move])[0]]

    def _balance(self, body: SX, feet: list[SX], standing: list[int], move: int | None) -> None:
        """The body's point keeps the margin inside every edge between standing neighbours."""
        slack = self._slack_symbols["margin"]
        for first, second in zip(standing, standing[1:] + standing[:1], strict=True):
            edge = feet[second][:2] - feet[first][:2]
            area = edge[0] * (body[1] - feet[first][1]) - edge[1] * (body[0] - feet[first][0])
            inside = area / sqrt(sumsqr(edge))
            self.program.bound(inside + slack, self._bounds.margin * MM, row=Row("margin", move, first))

    def _keep_apart(self, feet: list[SX], move: int | None) -> None:
        """Shoes that can meet keep their distance: those of neighbours, and on four legs of any two."""
        least, legs = self._bounds.shoe_distance * MM, self._model.leg_count
        if least <= 0.0:
            return
        least += TURNED_SHOE_ROOM if self.problem.is_turned else SHOE_ROOM
        slack = self._slack_symbols["shoe distance"]
        for first, second in combinations(range(legs), 2):
            if min(second - first, first + legs - second) > 2:
                continue
            squared = sumsqr(feet[first][:2] - feet[second][:2]) / least
            self.program.bound(squared + slack, least, row=Row("shoe distance", move, first))

    # Within moves

    def _add_fractions(self) -> None:
        problem, legs = self.problem, self._model.leg_count
        slip = self._bounds.slip * MM
        for move in range(problem.move_count):
            standing = self._standing(move)
            for share in FRACTIONS:
                start_body, start_feet, start_heading = self._guess.within(move, share)
                name = f"{move} {share}"
                place = (move + share) / problem.move_count
                heading = self._heading(f"sway {name}", place, start_heading)
                body = self.program.variable(
                    f"body {name}", [-FAR, -FAR, 40.0], [FAR, FAR, 70.0], start_body.tolist()
                )
                feet = [
                    self.program.variable(
                        f"foot {name} {leg}", [-FAR, -FAR, -20.0], [FAR, FAR, 30.0], start_feet[leg].tolist()
                    )
                    for leg in range(legs)
                ]
                mixed = (1 - share) * self.strokes[move] + share * self.strokes[move + 1]
                self._within[move, share] = Posture(body, feet, mixed, heading)
                for leg in range(legs):
                    asked = mixed[3 * leg : 3 * leg + 3]
                    self.program.bound(
                        leg_strokes(self._model, leg, body, feet[leg], heading) - asked, 0.0, 0.0
                    )
                    if leg in standing:
                        away = feet[leg] - self.feet[move][leg]
                        row = Row("slip", move, leg)
                        self.program.bound(away[:2], -slip, slip, row)
                        self.program.bound(away[2], -slip / 2, slip / 2, row)
                        self._deviations.append(away)
                    else:
                        height = feet[leg][2] - plane_height(feet[leg], [feet[i] for i in standing])
                        asked_height = problem.required_height(move, leg, share) * MM
                        row = Row("clearance", move, leg)
                        self.program.bound(height + self._slack_symbols["clearance"], asked_height, row=row)
                self._balance(body, feet, standing, move)
                self._keep_apart(feet, move)

    def _keep_arms_apart(self) -> None:
        """A plane between two arms leaves half of their distance to the corners of either."""
        half = (self._model.shape.rod_diameter + self.arms.distance) * MM / 2
        for place, plane in self.arms.planes.items():
            unit = self.program.variable(f"normal {place}", [-1.0] * 3, [1.0] * 3, plane.normal)
            offset = self.program.variable(f"offset {place}", [-FAR], [FAR], [plane.offset])
            self.program.bound(sumsqr(unit), LEAST_NORMAL, 1.0)
            for leg, arm, side in zip(place.legs, place.arms, (1, -1), strict=True):
                posture = self._posture(place)
                stroke = posture.strokes[3 * leg + arm]
                row = Row("arm distance", place.move, leg)
                for corner in arm_corners(
                    self._model, leg, arm, posture.body, posture.feet[leg], stroke, posture.heading
                ):
                    self.program.bound(side * (unit.T @ corner - offset), half, row=row)

    def _posture(self, place: ArmPlace) -> Posture:
        move = place.move
        if place.share == 0.0:
            return Posture(self.bodies[move], self.feet[move], self.strokes[move], self.headings[move])
        return self._within[move, place.share]

    # The cost, and what comes of it

    def _compile(self) -> None:
        weights = SX.sym("weights", 6)
        count = self.problem.move_count
        # A ramp of d mm lasts 2 d / v: moves are shorter than 15 mm.
        seconds = count * self.problem.law.message + 2.0 / (RAMP_SPEED * MM) * sum1(self.lengths)
        self.seconds_row = self.program.bound(seconds, -np.inf)
        even = np.diff(self._guess.bodies, axis=0)[:, :2]
        sways = [sumsqr(self.bodies[k + 1][:2] - self.bodies[k][:2] - DM(even[k])) for k in range(count)]
        cost = (
            weights[0] * seconds
            + weights[1] * seconds * 30.0 / (self.reach * self.problem.all_cycles)
            + weights[2] * sum(sumsqr(away) for away in self._deviations)
            + weights[3] * sum(sways)
            - weights[4] * self.reach
            + weights[5] * sum(self._slack_symbols.values())
        )
        self.program.compile(cost, weights)
        self._values = Function(
            "values",
            [self.program.unknowns],
            [
                self.step,
                horzcat(*self.bodies).T,
                horzcat(*(vertcat(*feet) for feet in self.feet)).T,
                horzcat(*self.strokes).T,
                seconds,
                vertcat(*self.headings),
            ],
        )

    def seconds(self, values: Floats) -> float:
        """Robot seconds of a solution as the program counts them: every move at least `SHORTEST_MOVE`."""
        return float(self._values(values)[4])

    def gait(self, values: Floats) -> PoseGait:
        """A solution as a gait, SI."""
        step, bodies, feet, strokes, _, headings = (np.array(value) for value in self._values(values))
        poses, legs = self.problem.airborne.shape
        return PoseGait(
            self.problem,
            step.item() / MM,
            bodies / MM,
            headings.ravel(),
            feet.reshape(poses, legs, 3) / MM,
            strokes.reshape(poses, legs, 3) / MM,
        )
