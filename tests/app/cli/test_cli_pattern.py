"""`footfall pattern`: transitions, periodic gaits, what is refused, and exit statuses."""

from __future__ import annotations

import shlex
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from app.cli import commands_pattern
from app.cli.pattern_options import PATTERN_RULES
from core.patterns.check import check_pattern
from core.patterns.problem import (
    PatternKind,
    PatternProblem,
    PatternResult,
    PatternStatus,
    Rule,
    index_halves,
    transition_cells,
)
from solver_jobs import solve_pattern
from tests.support.command import run, run_json

SIX = "--legs 6 --samples 20 --from 111001 --to 011011"
FOUR = "--legs 4 --samples 12 --from 1101 --to 1101"
GAIT = "--periodic --legs 6 --samples 12"


def ask(capsys: pytest.CaptureFixture[str], words: str) -> tuple[int, Any]:
    """Exit status and answer of `pattern`."""
    return run_json(capsys, "pattern", *words.split())


def read(capsys: pytest.CaptureFixture[str], words: str) -> tuple[int, list[str]]:
    """Exit status and the lines for people."""
    status, out, _ = run(capsys, "pattern", *words.split())
    return status, out.splitlines()


def stance(rows: list[str]) -> Any:
    return np.array([[cell == "1" for cell in row] for row in rows])


def transition(start: str, end: str, samples: int) -> PatternProblem:
    states = stance([start, end])
    free = np.zeros(len(start), dtype=bool)
    cells = transition_cells(states[0], states[1], samples, free)
    return PatternProblem(PatternKind.TRANSITION, cells, ~free, index_halves(len(start)))


def test_a_transition_is_proven_and_checked(capsys: pytest.CaptureFixture[str]) -> None:
    status, answer = ask(capsys, SIX)
    assert (status, answer["status"], answer["objective"]) == (0, "optimal", 3)
    rows = stance(answer["pattern"])
    assert rows.shape == (6, 20)
    assert check_pattern(transition("111001", "011011", 20), rows) == ()
    assert answer["objective"] == (rows[:, 1:] != rows[:, :-1]).any(axis=0).sum()
    assert answer["limb_changes"] == (rows[:, 1:] != rows[:, :-1]).sum()
    assert (answer["score"], answer["explanation"]) == (3000 + answer["limb_changes"], [])
    assert answer["solve_seconds"] > 0


def test_the_same_answer_twice(capsys: pytest.CaptureFixture[str]) -> None:
    answers = [{**ask(capsys, f"{SIX} --best 4")[1], "solve_seconds": None} for _ in range(2)]
    assert answers[0] == answers[1]


def test_the_best_patterns_are_distinct_and_in_order(capsys: pytest.CaptureFixture[str]) -> None:
    _, answer = ask(capsys, f"{SIX} --best 4")
    others = answer["alternatives"]
    assert len({tuple(one["pattern"]) for one in (answer, *others)}) == 4
    scores = [one["score"] for one in (answer, *others)]
    assert scores == sorted(scores)


def test_a_locked_foot_keeps_its_value(capsys: pytest.CaptureFixture[str]) -> None:
    _, answer = ask(capsys, f"{SIX} --locked 2,4")
    assert (answer["pattern"][1], answer["pattern"][3]) == ("1" * 20, "0" * 20)


def test_a_periodic_gait_of_four_limbs(capsys: pytest.CaptureFixture[str]) -> None:
    status, answer = ask(capsys, f"{GAIT} --locked 1:swing,4:stance")
    rows = answer["pattern"]
    assert (status, answer["status"], answer["kind"]) == (0, "optimal", "periodic")
    assert (rows[0], rows[3]) == ("0" * 12, "1" * 12)
    assert all("0" in row and "1" in row for row in (rows[1], rows[2], rows[4], rows[5]))


def test_a_rule_can_have_another_number_or_be_off(capsys: pytest.CaptureFixture[str]) -> None:
    short = "--legs 4 --samples 9 --from 1111 --to 1111"
    assert ask(capsys, short)[0] == 3
    assert ask(capsys, f"{short} --feet-down 2")[0] == 0
    status, answer = ask(capsys, f"{short} --least-swing off")
    assert (status, answer["objective"]) == (0, 0)


def test_the_shortest_length_is_found(capsys: pytest.CaptureFixture[str]) -> None:
    words = "--legs 4 --from 1111 --to 1111 --samples"
    status, answer = ask(capsys, f"{words} 30 --shortest")
    assert (status, answer["samples"], len(answer["pattern"][0])) == (0, 10, 10)
    assert ask(capsys, f"{words} 9")[0] == 3
    status, answer = ask(capsys, f"{words} 9 --shortest")
    assert (status, answer["samples"]) == (3, 9)


def test_an_impossible_transition_is_explained(capsys: pytest.CaptureFixture[str]) -> None:
    status, answer = ask(capsys, f"{FOUR} --locked 3")
    assert (status, answer["status"]) == (3, "infeasible")
    assert (answer["objective"], answer["pattern"], answer["bound"]) == (None, [], None)
    assert answer["explanation"][0].startswith("Limb 3 is locked in swing and limb 1 must swing")
    freed = answer["relaxations"][-1]
    assert (freed["words"], freed["rule"]) == ("Limb 3 free to walk", "fixed")
    assert freed["cells"][0] == {"limb": 3, "sample": 2}
    assert freed["command"] is None


@pytest.mark.heavy
@pytest.mark.parametrize(
    "words",
    [
        f"{FOUR} --locked 3",
        "--legs 4 --from 1111 --to 1111 --samples=9",
        "--legs 4 --from 1111 --to 1111 --samples 8 --samples 9 --least-swing 2 --best 2",
        "--periodic --legs 6 --samples 9 --locked 3:stance --feet-down 5 --least-swing 4",
        "--periodic --legs 6 --samples 8 --each-side 3 --least-swing 1",
        "--periodic --legs 4 --samples 8 --shortest-stance 8 --each-side 2",
    ],
)
def test_each_command_of_a_relaxation_finds_a_pattern(capsys: pytest.CaptureFixture[str], words: str) -> None:
    status, answer = ask(capsys, words)
    assert status == 3
    commands = [one["command"] for one in answer["relaxations"] if one["command"] is not None]
    assert commands
    _, lines = read(capsys, words)
    at = lines.index("What would help, the mildest change first:") + 1
    told = [line.strip() for line in lines[at:]]
    assert told == [
        text for one in answer["relaxations"] for text in (f"{one['words']}.", one["command"]) if text
    ]
    for command in commands:
        program, *arguments = shlex.split(command)
        assert program == "footfall"
        status, found = run_json(capsys, *arguments)
        assert (status, found["relaxations"]) == (0, [])


def test_every_rule_has_its_option() -> None:
    for option, (rule, _) in PATTERN_RULES.items():
        assert commands_pattern.RULE_OPTIONS.get(Rule(rule), f"--{rule.replace('_', '-')}") == option


def test_a_state_that_breaks_a_rule_is_infeasible(capsys: pytest.CaptureFixture[str]) -> None:
    status, lines = read(capsys, "--legs 4 --samples 20 --from 0000 --to 1111")
    assert status == 3
    assert lines[0].startswith("No transition of 20 samples for 4 limbs keeps the rules (proven")
    assert lines[1:] == [
        "Every limb swings at sample 1: no foot is down there, and at least 3 must be.",
        "No change of one rule mends this: choose another state at sample 1.",
    ]


def test_the_drawing_has_a_row_a_limb(capsys: pytest.CaptureFixture[str]) -> None:
    status, lines = read(capsys, "--periodic --legs 4 --samples 12 --locked 2:stance")
    assert status == 0
    assert lines[0].startswith("Periodic gait of 12 samples for 4 limbs, proven optimal in ")
    assert lines[3] == "sample   1   5    10"
    assert lines[5] == "limb 2   ████████████  locked"
    assert set(lines[4].removeprefix("limb 1   ")) == {"█", "·"}
    objective = int(lines[2].split()[1].rstrip(":"))
    assert lines[8].startswith("changes")
    assert lines[8].count("^") == objective


@pytest.mark.parametrize(
    ("words", "where", "said"),
    [
        ("--legs 4 --samples 9 --from 110 --to 1111", "--from", "3 characters; it needs one for each of 4"),
        ("--legs 4 --samples 9 --from 1111 --to 11x1", "--to", "“x” for foot 3; it must be 1 (stance)"),
        ("--legs 4 --samples 9 --to 1111", "--from", "A transition needs --from"),
        ("--legs 4 --samples 9 --from 1111", "--to", "A transition needs --to"),
        ("--legs 4 --samples 9 --from 1111 --to 1111 --locked 5", "--locked", "the feet are 1 to 4"),
        ("--legs 4 --samples 9 --from 1111 --to 1111 --locked 0", "--locked", "the feet are 1 to 4"),
        ("--legs 4 --samples 9 --from 1111 --to 1111 --locked 2,2", "--locked", "foot 2 twice"),
        ("--legs 4 --samples 9 --from 1111 --to 1111 --locked 1,", "--locked", "“” where a foot's number"),
        ("--legs 4 --samples 9 --from 1111 --to 1111 --locked 1:swing", "--locked", "Write 1 alone"),
        ("--legs 4 --samples 9 --from 0111 --to 1111 --locked 1", "locked", "Limb 1 is locked, but"),
        ("--legs 4 --samples 9 --periodic --from 1111", "--from", "belongs to a transition"),
        ("--legs 4 --samples 9 --periodic --to 1111", "--to", "leave out --periodic"),
        ("--legs 4 --samples 9 --periodic --locked 1", "--locked", "1:swing,4:stance"),
        ("--legs 4 --samples 9 --periodic --locked 1:up", "--locked", "1:swing,4:stance"),
        ("--legs 1 --samples 9 --periodic", "command line", "--legs: 1 must lie between 2 and 16"),
        ("--legs 4 --samples 1 --periodic", "command line", "--samples: 1 must lie between 2 and 240"),
        ("--legs 4 --samples 9 --periodic --feet-down x", "command line", "--feet-down: “x” is not a whole"),
        ("--legs 4 --samples 9 --periodic --best 0", "command line", "--best: 0 must lie between 1 and 50"),
        ("--legs 4 --periodic", "command line", "--samples"),
    ],
)
def test_bad_input_names_the_option_and_the_remedy(
    capsys: pytest.CaptureFixture[str], words: str, where: str, said: str
) -> None:
    status, answer = ask(capsys, words)
    assert (status, answer["where"]) == (2, where)
    assert said in answer["error"]


def test_a_search_that_runs_out_of_time_has_failed(capsys: pytest.CaptureFixture[str]) -> None:
    words = "--periodic --legs 16 --samples 100 --feet-down 13 --least-swing 19 --seconds 0.05"
    status, answer = ask(capsys, words)
    assert (status, answer["status"], answer["pattern"]) == (4, "failed", [])
    assert answer["explanation"][0].startswith("In 0.05 s no pattern was found, and none was proven")


def test_a_pattern_that_the_check_refuses_is_not_shown(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def broken(problem: PatternProblem, **words: Any) -> PatternResult:
        result = solve_pattern(problem, **words)
        lifted = np.array(result.patterns[0].stance)
        lifted[:, 7] = False
        return replace(result, patterns=(replace(result.patterns[0], stance=lifted),))

    monkeypatch.setattr(commands_pattern, "solve_pattern", broken)
    status, answer = ask(capsys, SIX)
    assert (status, answer["status"], answer["pattern"], answer["objective"]) == (4, "failed", [], None)
    assert "feet_down" in answer["explanation"][0]


def test_a_pattern_without_proof_is_feasible(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def unproven(problem: PatternProblem, **words: Any) -> PatternResult:
        return replace(solve_pattern(problem, **words), status=PatternStatus.FEASIBLE, bound=2000.0)

    monkeypatch.setattr(commands_pattern, "solve_pattern", unproven)
    status, lines = read(capsys, SIX)
    assert status == 0
    assert "the best found (weighted sum 3010, none is below 2000)" in lines[0]
    assert ask(capsys, SIX)[1]["status"] == "feasible"
