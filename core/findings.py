"""What a check found, the verdict it adds up to, and a person's approval of it."""

import hashlib
import json
from dataclasses import dataclass
from datetime import datetime
from enum import StrEnum
from typing import Any

from core.errors import InputError, StateError
from core.names import is_visible, require_kept
from core.overrides import FINAL, MOST_REASON, OVERRIDABLE, OverrideRequest

TOLERANCE = 1e-6
"""What a limit may be passed by before it counts, m."""

VERDICT_FORM = 2
"""Of what a verdict's hash is over. In the first one it was every digit and every sentence."""


def is_simulated(rule: str) -> bool:
    """Whether a rule judges a simulation rather than the plan."""
    return rule.startswith("simulated_")


class Severity(StrEnum):
    """Errors block approval; warnings do not."""

    ERROR = "error"
    WARNING = "warning"


@dataclass(frozen=True)
class Finding:
    """One rule broken at one place.

    Args:
        rule: short name of the rule, for example `stroke`.
        severity: error or warning.
        sentence: foot, time, value, limit and a way out, in words.
        value: what was found, SI; None where it has no number.
        limit: the bound that it broke, SI.
        sample: index of the knot, 0-based, where there is one.
        foot: index of the foot, 0-based, where there is one.
        actuator: index of the motor within the foot, 0-based, where there is one.
        time: of the plan, or of the simulated robot where the rule is about a simulation, s.
        remedy: the way out alone, with which the sentence ends; nothing where it names none.
    """

    rule: str
    severity: Severity
    sentence: str
    value: float | None
    limit: float
    sample: int | None = None
    foot: int | None = None
    actuator: int | None = None
    time: float | None = None
    remedy: str = ""

    @property
    def is_overridable(self) -> bool:
        """Whether it is an error that a person may override."""
        return self.severity is Severity.ERROR and self.rule in OVERRIDABLE

    @property
    def identity(self) -> tuple[str, Severity, int | None, int | None, int | None]:
        """Rule, severity, foot, motor and sample, which distinguish it from other findings.

        A simulated one has no sample here: when a foot slides most is another moment on another computer.
        """
        sample = None if is_simulated(self.rule) else self.sample
        return self.rule, self.severity, self.foot, self.actuator, sample


def found(
    rule: str,
    severity: Severity,
    words: str,
    remedy: str,
    value: float | None,
    limit: float,
    **place: Any,
) -> Finding:
    """A finding whose sentence is what happened and then the way out.

    Args:
        rule: short name of the rule.
        severity: error or warning.
        words: what happened, as one or more sentences.
        remedy: the way out, as one or more sentences.
        value: what was found, SI; None where it has no number.
        limit: the bound that it broke, SI.
        place: `sample`, `foot`, `actuator` and `time` of the finding, those that there are.
    """
    return Finding(rule, severity, f"{words} {remedy}", value, limit, remedy=remedy, **place)


@dataclass(frozen=True)
class RuleMargin:
    """How far the worst place of a rule stays from its limit (negative: broken; None: no number), SI."""

    rule: str
    margin: float | None
    unit: str


@dataclass(frozen=True)
class Outcome:
    """What one rule found, and its distance to the limit."""

    margin: RuleMargin
    findings: tuple[Finding, ...] = ()


@dataclass(frozen=True)
class SendCost:
    """About how long the robot takes under one stop bound, with merged waypoints and with every knot sent.

    Args:
        stop_bound: longest deafness, s; None for any.
        merge: tolerance of the merging, m.
        merged_waypoints: how many are sent.
        merged_seconds: what they take, s.
        every_waypoints: how many are sent where nothing is merged.
        every_seconds: what they take, s.
        stop_seconds: until Stop takes effect at the latest, as merging is chosen, s.
        is_chosen: whether the gait is sent under this bound.
    """

    stop_bound: float | None
    merge: float
    merged_waypoints: int
    merged_seconds: float
    every_waypoints: int
    every_seconds: float
    stop_seconds: float
    is_chosen: bool


@dataclass(frozen=True)
class Verdict:
    """Every rule's outcome for exactly these waypoints.

    Args:
        waypoints_hash: content hash of the waypoints that were checked.
        findings: what was found, errors first.
        margins: the distance to the limit of each rule, also where nothing was found.
        costs: what stop bound and merging cost in robot seconds; empty where only waypoints are
            known, or where they are sent as they are.
        notes: sentences on what the figures leave out.
        robot_hash: of the robot's parameters, so that a verdict on other parameters is another one.
        simulation: key of the simulation that was judged; empty where none was.
    """

    waypoints_hash: str
    findings: tuple[Finding, ...]
    margins: tuple[RuleMargin, ...]
    costs: tuple[SendCost, ...] = ()
    notes: tuple[str, ...] = ()
    robot_hash: str = ""
    simulation: str = ""

    @property
    def warnings(self) -> tuple[Finding, ...]:
        """Findings that do not block approval, but that the person who approves has to have seen."""
        return tuple(f for f in self.findings if f.severity is Severity.WARNING)

    @property
    def errors(self) -> tuple[Finding, ...]:
        """Findings that block approval."""
        return tuple(f for f in self.findings if f.severity is Severity.ERROR)

    @property
    def passed(self) -> bool:
        """Whether no error stands."""
        return not self.errors

    @property
    def content_hash(self) -> str:
        """SHA-256 over what an approval is bound to: waypoints, robot, simulation, rules, what they found.

        Margins, sentences, costs and notes are left out: they change with a processor's last digits, or with
        a word.
        """
        rules = sorted({margin.rule for margin in self.margins})
        found = sorted({finding.identity for finding in self.findings}, key=str)
        content = [VERDICT_FORM, self.waypoints_hash, self.robot_hash, self.simulation, rules, found]
        return hashlib.sha256(json.dumps(content).encode()).hexdigest()


@dataclass(frozen=True)
class Override:
    """Errors in spite of which a person approves.

    Args:
        rules: whose errors are overridden.
        reason: why, in the person's words.
        errors: all that stood; the approval does not cover another one.
    """

    rules: tuple[str, ...]
    reason: str
    errors: tuple[Finding, ...]

    def new_error(self, verdict: Verdict) -> Finding | None:
        """The first error of a verdict that did not stand when the person approved."""
        known = {error.identity for error in self.errors}
        return next((error for error in verdict.errors if error.identity not in known), None)


@dataclass(frozen=True)
class Approval:
    """A person's word that these waypoints may move the robot.

    Args:
        verdict_hash: content hash of the verdict that was approved.
        waypoints_hash: content hash of the waypoints.
        by: the person's name.
        when: ISO 8601 time with its offset.
        warnings: sentences of the warnings that stood, and that the person has seen.
        robot_hash: of the robot's parameters; nothing in approvals of the first release.
        form: of the verdict's hash; approvals that name none are of the first.
        override: of the errors in spite of which it was given; None where none stood.
    """

    verdict_hash: str
    waypoints_hash: str
    by: str
    when: str
    warnings: tuple[str, ...] = ()
    robot_hash: str = ""
    form: int = 1
    override: Override | None = None


def approve(
    verdict: Verdict,
    by: str,
    when: datetime,
    *,
    accept_warnings: bool = False,
    override: OverrideRequest | None = None,
) -> Approval:
    """Binds a person to a verdict without errors, or with errors that they override.

    Args:
        verdict: of the waypoints that are approved.
        by: the person's name.
        when: now.
        accept_warnings: whether the person has seen every warning and accepts it.
        override: of the errors that stand.

    Raises:
        StateError: an error stands that is not overridden, or a warning that was not accepted, or no name
            was given, or no error stands of a rule that is overridden.
        InputError: the override has no reason, or is of a rule that may not be overridden.
    """
    if not is_visible(by):
        raise StateError("An approval needs the name of the person who gives it.", "by")
    require_kept(by, "The name", "by")
    overridden = None if override is None else _override(verdict, override)
    left = [one for one in verdict.errors if overridden is None or one.rule not in overridden.rules]
    if left:
        raise StateError(f"Errors block approval ({len(left)}). First: {left[0].sentence}", "verdict")
    if verdict.warnings and not accept_warnings:
        count = len(verdict.warnings)
        raise StateError(
            f"{count} warning{'s are' if count > 1 else ' is'} not accepted yet, the first: "
            f"{verdict.warnings[0].sentence} Read every warning, then approve with accept_warnings.",
            "accept_warnings",
        )
    seen = tuple(finding.sentence for finding in verdict.warnings)
    hashes = (verdict.content_hash, verdict.waypoints_hash)
    when_text = when.isoformat()
    return Approval(*hashes, by.strip(), when_text, seen, verdict.robot_hash, VERDICT_FORM, overridden)


def override_all(verdict: Verdict, reason: str) -> OverrideRequest:
    """The override of every error that stands.

    Args:
        verdict: with its errors.
        reason: why.

    Raises:
        InputError: there is no reason, no error stands, or one that may not be overridden.
    """
    if not verdict.errors:
        raise InputError("No error stands that could be overridden. Leave the override out.", "override")
    final = next((error for error in verdict.errors if not error.is_overridable), None)
    if final is not None:
        raise InputError(f"{final.sentence} {final_words(final.rule)}", "override")
    request = OverrideRequest(tuple(sorted({error.rule for error in verdict.errors})), reason)
    _override(verdict, request)
    return request


def _override(verdict: Verdict, request: OverrideRequest) -> Override:
    reason = request.reason.strip()
    if not is_visible(reason) or len(reason) > MOST_REASON:
        raise InputError(
            f"An override needs a reason of 1 to {MOST_REASON} characters. Write why the robot may move in "
            "spite of these errors.",
            "override",
        )
    require_kept(reason, "The reason", "override")
    if not request.rules:
        raise InputError("An override must name the rules whose errors it is about.", "override")
    standing = {error.rule for error in verdict.errors}
    for rule in request.rules:
        if rule not in OVERRIDABLE:
            raise InputError(final_words(rule), "override")
        if rule not in standing:
            raise StateError(
                f"No error of the rule “{rule}” stands, so there is nothing to override. Look at the check "
                "and approve again.",
                "override",
            )
    return Override(tuple(sorted(set(request.rules))), reason, verdict.errors)


def final_words(rule: str) -> str:
    """Why errors of a rule cannot be overridden, in a sentence."""
    why = FINAL.get(rule)
    if why is None:
        return f"There is no rule “{rule}” that may be overridden. These may be: {', '.join(OVERRIDABLE)}."
    return f"Errors of the rule “{rule}” cannot be overridden. {why}"
