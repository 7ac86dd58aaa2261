"""The rules of F 3.2 for a pattern told by its events."""

import numpy as np
from ortools.sat.python.cp_model import IntVar, LinearExpr, LinearExprT

from core.patterns.problem import FREE, PatternKind, PatternProblem
from solver_jobs.patterns.balance import Balance
from solver_jobs.patterns.events import EventModel, event_model


def ruled_model(problem: PatternProblem, events: int, row_floors: list[int]) -> EventModel:
    """The model with all its rules; nothing is made small yet.

    Args:
        problem: what is sought.
        events: how many events the pattern has, exactly.
        row_floors: what each limb costs at least; it follows from the rules, and shortens proofs.
    """
    built = event_model(problem, events)
    _add_fixed(built)
    _add_support(built)
    _add_phases(built)
    _add_shares(built)
    if problem.drawing is not None and problem.weights.drawing:
        _add_drawing(built, row_floors)
    if problem.rules.balance is not None:
        _add_balance(built)
    return built


def _add_fixed(built: EventModel) -> None:
    """g1 and locked cells; those of the first and last sample of a transition stand already."""
    problem = built.problem
    inner = problem.kind is PatternKind.TRANSITION
    for limb, sample in np.argwhere(problem.fixed != FREE):
        if not problem.walking[limb] or (inner and sample in (0, problem.sample_count - 1)):
            continue
        for column, cell in enumerate(built.stance[limb]):
            wanted = cell if problem.fixed[limb, sample] else ~cell
            built.model.add_bool_or(*built.not_in(column, int(sample)), wanted)


def _add_support(built: EventModel) -> None:
    """g3, g4, g5."""
    problem, rules = built.problem, built.problem.rules
    for column in zip(*built.stance, strict=True):
        if rules.feet_down is not None:
            built.model.add(LinearExpr.sum(list(column)) >= rules.feet_down)
        if rules.feet_down_each_side is not None:
            for side in problem.sides:
                feet = [cell for cell, counts in zip(column, side, strict=True) if counts]
                built.model.add(LinearExpr.sum(feet) >= rules.feet_down_each_side)


def _add_phases(built: EventModel) -> None:
    """g2, g8, g9, g10."""
    rules, model = built.problem.rules, built.model
    if rules.limb_changes is not None:
        for row in built.switches:
            model.add(LinearExpr.sum(row) <= rules.limb_changes)
    for stands, least in ((False, rules.shortest_swing), (True, rules.shortest_stance)):
        for columns in _inner_stretches(built, least or 0):
            _add_shortest(built, columns, least or 0, stands=stands)


def _inner_stretches(built: EventModel, least: int) -> list[list[int]]:
    """Columns before, of and after each phase that may be too short; each lasts at least one sample."""
    count = built.columns
    widths = range(1, min(least, count))
    if built.is_ring:
        return [[(first + k) % count for k in range(-1, w + 1)] for w in widths for first in range(count)]
    return [list(range(first - 1, first + w + 1)) for w in widths for first in range(1, count - w)]


def _add_shortest(built: EventModel, columns: list[int], least: int, *, stands: bool) -> None:
    before, *phase, after = columns
    long_enough = built.model.new_bool_var("")
    lasts = LinearExpr.sum([built.lengths[column] for column in phase])
    built.model.add(lasts >= least).only_enforce_if(long_enough)
    for limb, row in enumerate(built.stance):
        if built.problem.walking[limb]:
            cells = row if stands else [~cell for cell in row]
            others = [~cells[column] for column in phase]
            built.model.add_bool_or(cells[before], *others, cells[after], long_enough)


def _add_shares(built: EventModel) -> None:
    """g6, g7, g11: how long each walking limb stands; in a gait every one of them steps."""
    problem, model = built.problem, built.model
    rules, count = problem.rules, problem.sample_count
    walkers = [limb for limb in range(problem.leg_count) if problem.walking[limb]]
    least = model.new_int_var(0, count, "least stance")
    for limb in walkers:
        stands = LinearExpr.sum([_time_standing(built, limb, column) for column in range(built.columns)])
        if rules.workload is not None:
            model.add(stands >= least)
            model.add(stands <= least + rules.workload)
        if rules.least_swing is not None:
            model.add(stands <= count - rules.least_swing)
        if problem.kind is PatternKind.PERIODIC:
            model.add_bool_or(built.switches[limb])


def _time_standing(built: EventModel, limb: int, column: int) -> IntVar:
    """The column's length where the limb stands in it, else 0."""
    cell = built.stance[limb][column]
    time = built.model.new_int_var(0, built.problem.sample_count, "")
    built.model.add(time == built.lengths[column]).only_enforce_if(cell)
    built.model.add(time == 0).only_enforce_if(~cell)
    return time


def _add_drawing(built: EventModel, row_floors: list[int]) -> None:
    """What it costs to leave the drawing, limb by limb and column by column."""
    problem, weights = built.problem, built.problem.weights
    drawing = problem.drawing if problem.drawing is not None else problem.fixed
    free = problem.fixed == FREE
    for limb in np.nonzero(problem.walking)[0]:
        costs: list[LinearExprT] = []
        for wrong, stands in ((drawing[limb] == 1, False), (drawing[limb] == 0, True)):
            before = _counts_before(built, wrong & free[limb])
            for column, cell in enumerate(built.stance[limb]):
                redrawn = built.model.new_int_var(0, problem.sample_count, "")
                chosen = cell if stands else ~cell
                built.model.add(redrawn >= _between(built, before, column)).only_enforce_if(chosen)
                costs.append(weights.drawing * redrawn)
        switches = LinearExpr.sum(built.switches[limb])
        built.model.add(LinearExpr.sum(costs) + weights.limb_changes * switches >= row_floors[limb])
        built.costs += costs


def _counts_before(built: EventModel, wrong: np.ndarray) -> list[IntVar]:
    """How many of some samples lie before each column."""
    sums = [0, *(int(total) for total in np.cumsum(wrong))]
    counts = []
    for start in built.starts:
        count = built.model.new_int_var(0, sums[-1], "")
        built.model.add_element(start, sums[:-1], count)
        counts.append(count)
    return [*counts, built.model.new_constant(sums[-1])]


def _between(built: EventModel, before: list[IntVar], column: int) -> LinearExprT:
    inside = before[column + 1] - before[column]
    wraps = built.is_ring and column == built.columns - 1
    return inside + before[0] if wraps else inside


def _add_balance(built: EventModel) -> None:
    """A place for the body at the first and at the last sample of each column.

    Between them it goes straight, at one speed: the column's support polygon is convex, so no other way
    through the column can do what the straight one cannot.
    """
    balance = Balance(built.problem, built.model)
    for column, standing in enumerate(zip(*built.stance, strict=True)):
        entry, leave = balance.place(), balance.place()
        balance.keep_inside([entry, leave], list(standing))
        balance.keep_near(entry, leave, built.lengths[column] - 1)
        built.places.append((entry, leave))
    following = built.places[1:] + (built.places[:1] if built.is_ring else [])
    for (_, leave), (entry, _) in zip(built.places, following, strict=False):
        balance.keep_near(leave, entry, 1)
