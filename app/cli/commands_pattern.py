"""`pattern`."""

import shlex
import threading
from argparse import ArgumentParser, Namespace
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress

from app.cli.commands_gait import without_option
from app.cli.common.command import set_command
from app.cli.common.output import INFEASIBLE, end_on_signals, show
from app.cli.pattern_options import add_pattern_options, asked_pattern
from app.cli.pattern_text import CHANGE, STANCE, SWING, drawn_pattern
from app.common.json import Json
from app.common.signals import Interrupted, ignore_endings
from core.patterns.check import broken_rules, check_pattern, weighted_sum
from core.patterns.numerals import counted
from core.patterns.problem import (
    Pattern,
    PatternKind,
    PatternProblem,
    PatternResult,
    PatternStatus,
    Relaxation,
    Rule,
)
from solver_jobs import shortest_problem, solve_pattern

FAILED = 4
TICK_SECONDS = 0.1
"""Between looks for Ctrl-C."""
RULE_OPTIONS = {Rule.FEET_DOWN_EACH_SIDE: "--each-side"}
"""Options of rules that are not called like their rule."""
NOTHING: Json = {"objective": None, "limb_changes": None, "score": None, "pattern": []}


def pattern_command(parser: ArgumentParser) -> None:
    """Makes the parser of `pattern`."""
    text = "The best footfall pattern: a transition between two states, or a periodic gait."
    set_command(parser, run_pattern, text)
    add_pattern_options(parser)


def run_pattern(options: Namespace) -> int:
    """Finds the best footfall pattern, draws it, or says why there is none."""
    end_on_signals()
    problem, result, failure = solved_pattern(options)
    content = pattern_content(problem, result, failure, options.words)
    show(options, content, _lines(problem, result, failure, content))
    if failure is not None:
        return FAILED
    return INFEASIBLE if result.status is PatternStatus.INFEASIBLE else 0


def solved_pattern(options: Namespace) -> tuple[PatternProblem, PatternResult, str | None]:
    """What is asked, what the solver found, and why there is no checked answer, if there is none."""
    problem = asked_pattern(options)
    if options.shortest:
        problem = shortest_problem(problem)
    result = _solved(problem, options)
    return problem, result, pattern_failure(problem, result, options.seconds)


def _solved(problem: PatternProblem, options: Namespace) -> PatternResult:
    """The result, found in a thread of its own, so that Ctrl-C and SIGTERM are heard and end the search."""
    left = threading.Event()
    with ThreadPoolExecutor(1, "pattern") as pool:
        try:
            search = pool.submit(
                solve_pattern,
                problem,
                count=options.best,
                seconds=options.seconds,
                progress=lambda known: not left.is_set(),
            )
            while True:
                with suppress(TimeoutError):
                    return search.result(TICK_SECONDS)
        except (KeyboardInterrupt, Interrupted):
            # A process that leaves the solver's thread behind is aborted.
            ignore_endings()
            raise
        finally:
            left.set()


def pattern_failure(problem: PatternProblem, result: PatternResult, seconds: float) -> str | None:
    """Why there is no checked answer; None where there is one."""
    broken = {
        rule
        for pattern in result.patterns
        for rule in broken_rules(check_pattern(problem, pattern.stance, pattern.body_xy))
    }
    if broken:
        names = ", ".join(sorted(broken))
        return f"The solver's pattern breaks {names}, so it is not shown. Please report this as a defect."
    if result.status is PatternStatus.INFEASIBLE or result.patterns:
        return None
    return (
        f"In {seconds:g} s no pattern was found, and none was proven impossible. Give more --seconds, or "
        "fewer samples."
    )


def pattern_content(
    problem: PatternProblem, result: PatternResult, failure: str | None, arguments: list[str]
) -> Json:
    """A result as JSON content; `arguments` are the command's, for what would help."""
    patterns = () if failure is not None else result.patterns
    answers = [_answer(problem, pattern) for pattern in patterns]
    best = answers[0] if answers else NOTHING
    return {
        "status": "failed" if failure is not None else result.status.value,
        **best,
        "bound": result.bound,
        "solve_seconds": result.solve_seconds,
        "explanation": [failure] if failure is not None else list(result.explanation),
        "kind": problem.kind.value,
        "legs": problem.leg_count,
        "samples": problem.sample_count,
        "alternatives": answers[1:],
        "relaxations": [
            {**_relaxation(one), "command": _command(one, arguments)} for one in result.relaxations
        ],
    }


def _answer(problem: PatternProblem, pattern: Pattern) -> Json:
    return {
        "objective": pattern.sample_changes,
        "limb_changes": pattern.limb_changes,
        "score": weighted_sum(problem, pattern),
        "pattern": ["".join("1" if cell else "0" for cell in row) for row in pattern.stance],
    }


def _relaxation(one: Relaxation) -> Json:
    cells = [{"limb": limb + 1, "sample": sample + 1} for limb, sample in one.cells]
    return {
        "words": one.words,
        "rule": one.rule.value,
        "value": one.value,
        "samples": one.samples,
        "cells": cells,
        "also": [_relaxation(further) for further in one.also],
    }


def _command(relaxation: Relaxation, arguments: list[str]) -> str | None:
    """The command that asks with a relaxation; None where cells are freed, for which there is no option."""
    changed = [argument for argument in arguments if argument != "--json"]
    for change in (relaxation, *relaxation.also):
        if change.samples is not None:
            option, value = "--samples", str(change.samples)
        elif change.rule is Rule.FIXED:
            return None
        else:
            option = RULE_OPTIONS.get(change.rule, f"--{change.rule.value.replace('_', '-')}")
            value = "off" if change.value is None else f"{change.value:g}"
        changed = [*without_option(changed, option), option, value]
    return shlex.join(["footfall", *changed])


def _relaxation_lines(relaxations: list[Json]) -> list[str]:
    """What would help, each with its command where there is one."""
    if not relaxations:
        return []
    lines = ["What would help, the mildest change first:"]
    for relaxation in relaxations:
        lines.append(f"  {relaxation['words']}.")
        if relaxation["command"] is not None:
            lines.append(f"    {relaxation['command']}")
    return lines


def _lines(problem: PatternProblem, result: PatternResult, failure: str | None, content: Json) -> list[str]:
    name = "transition" if problem.kind is PatternKind.TRANSITION else "periodic gait"
    asked = f"{name} of {problem.sample_count} samples for {problem.leg_count} limbs"
    if failure is not None:
        return [failure]
    if result.status is PatternStatus.INFEASIBLE:
        took = f"proven for the stated model in {result.solve_seconds:.2f} s"
        helps = _relaxation_lines(content["relaxations"])
        return [f"No {asked} keeps the rules ({took}).", *result.explanation, *helps]
    proven = "proven optimal" if result.status is PatternStatus.OPTIMAL else _gap(content)
    lines = [f"{asked.capitalize()}, {proven} in {result.solve_seconds:.2f} s."]
    for number, pattern in enumerate(result.patterns, start=1):
        which = f"{number}. " if len(result.patterns) > 1 else ""
        lines += ["", f"{which}{_scores(pattern)}", *_drawing(problem, pattern)]
    return [
        *lines,
        "",
        f"{STANCE} stance, {SWING} swing, {CHANGE} a limb has changed since the sample before.",
    ]


def _gap(content: Json) -> str:
    return f"the best found (weighted sum {content['score']}, none is below {content['bound']:g})"


def _scores(pattern: Pattern) -> str:
    return (
        f"Objective {pattern.sample_changes}: {counted(pattern.sample_changes, 'moment')} of change, "
        f"{counted(pattern.limb_changes, 'foot change')}."
    )


def _drawing(problem: PatternProblem, pattern: Pattern) -> list[str]:
    marks = ["" if walks else "locked" for walks in problem.walking]
    return drawn_pattern(pattern.stance, marks, cyclic=problem.kind is PatternKind.PERIODIC)
