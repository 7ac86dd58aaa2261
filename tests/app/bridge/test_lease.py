"""Who holds the robot: taking, asking, giving, and holders who are gone."""

import pytest
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, invariant, rule

from app.bridge.lease import ASK_SECONDS, GONE_SECONDS, Lease, Person, policy
from core.errors import StateError

ADA, GRACE, ALAN = Person("a", "Ada"), Person("g", "Grace"), Person("n", "Alan")
SCRIPT = Person("api", is_script=True)


class Clock:
    """A clock that a test sets."""

    def __init__(self) -> None:
        self.time = 0.0

    def __call__(self) -> float:
        return self.time


@pytest.fixture
def clock() -> Clock:
    return Clock()


@pytest.fixture
def lease(clock: Clock) -> Lease:
    return Lease(clock)


def holder(lease: Lease) -> str | None:
    person = lease.now.holder
    return None if person is None else person.name or person.page


def test_the_first_deed_takes_the_robot_and_its_doer_goes_on(lease: Lease) -> None:
    assert lease.admit(ADA, is_idle=True)
    assert not lease.admit(ADA, is_idle=False)
    assert holder(lease) == "Ada"


@pytest.mark.parametrize("is_idle", [True, False])
def test_another_page_is_refused_with_the_holders_name_and_what_to_do(lease: Lease, is_idle: bool) -> None:
    lease.admit(ADA, is_idle=is_idle)
    with pytest.raises(StateError, match=r"Ada is in control\. Ask Ada for control; everybody can stop"):
        lease.admit(GRACE, is_idle=is_idle)
    assert holder(lease) == "Ada"


@pytest.mark.parametrize(("is_away", "is_gone"), [(True, False), (False, True), (False, False)])
def test_the_robot_of_a_holder_is_theirs_unless_they_are_gone_and_its_line_is_lost(
    lease: Lease, clock: Clock, is_away: bool, is_gone: bool
) -> None:
    lease.admit(ADA, is_idle=True)
    clock.time += GONE_SECONDS + 1.0 if is_gone else 0.0
    with pytest.raises(StateError, match="Ada is in control"):
        lease.admit(GRACE, is_idle=True, is_away=is_away)


def test_who_connects_after_a_lost_line_holds_the_robot_of_one_who_is_gone(
    lease: Lease, clock: Clock
) -> None:
    lease.admit(ADA, is_idle=True)
    clock.time += GONE_SECONDS + 1.0
    assert lease.admit(GRACE, is_idle=True, is_away=True)
    assert holder(lease) == "Grace"


def test_only_the_holder_lets_the_robot_go_for_everybody(lease: Lease) -> None:
    lease.admit(ADA, is_idle=True)
    lease.ask(GRACE)
    with pytest.raises(StateError, match="Ada is in control"):
        lease.drop(GRACE)
    lease.drop(ADA)
    assert holder(lease) is None


def test_two_tabs_of_one_person_are_two(lease: Lease) -> None:
    lease.admit(ADA, is_idle=True)
    with pytest.raises(StateError, match="Ada is in control"):
        lease.admit(Person("b", "Ada"), is_idle=True)


def test_a_holder_without_a_name_keeps_the_one_that_was_known(lease: Lease) -> None:
    lease.admit(ADA, is_idle=True)
    lease.admit(Person("a"), is_idle=True)
    assert holder(lease) == "Ada"


def test_who_asks_is_given_the_robot_by_its_holder(lease: Lease) -> None:
    lease.admit(ADA, is_idle=True)
    lease.ask(GRACE)
    assert lease.now.asker == GRACE
    with pytest.raises(StateError, match="Ada is in control, and decides"):
        lease.give(GRACE)
    lease.give(ADA)
    assert holder(lease) == "Grace"
    assert lease.now.asker is None
    with pytest.raises(StateError, match="Grace is in control"):
        lease.admit(ADA, is_idle=True)


def test_the_holder_may_say_no(lease: Lease) -> None:
    lease.admit(ADA, is_idle=True)
    lease.ask(GRACE)
    lease.keep(ADA)
    assert lease.now.asker is None
    with pytest.raises(StateError, match="Nobody asks"):
        lease.give(ADA)


def test_the_second_who_asks_waits(lease: Lease) -> None:
    lease.admit(ADA, is_idle=True)
    lease.ask(GRACE)
    lease.ask(GRACE)
    with pytest.raises(StateError, match="Grace has asked for control before you"):
        lease.ask(ALAN)


def test_a_question_that_nobody_answers_is_forgotten(lease: Lease, clock: Clock) -> None:
    lease.admit(ADA, is_idle=True)
    lease.ask(GRACE)
    clock.time = ASK_SECONDS + 1.0
    lease.heard("a")
    assert lease.now.asker is None
    lease.ask(ALAN)
    assert lease.now.asker == ALAN


def test_a_robot_that_is_let_go_is_whose_who_asked(lease: Lease) -> None:
    lease.admit(ADA, is_idle=True)
    lease.release(ADA)
    assert holder(lease) is None
    lease.ask(GRACE)
    assert holder(lease) == "Grace"
    lease.ask(ADA)
    lease.release(GRACE)
    assert holder(lease) == "Ada"


def test_signs_of_life_keep_the_robot_and_a_reload_does_not_lose_it(lease: Lease, clock: Clock) -> None:
    lease.admit(ADA, is_idle=True)
    for _ in range(10):
        clock.time += GONE_SECONDS - 0.1
        assert not lease.heard("g")
        assert not lease.heard("a")
        assert not lease.note_gone()
    with pytest.raises(StateError, match="Ada is in control"):
        lease.take(GRACE)


def test_a_holder_who_is_gone_is_noticed_once_and_may_be_followed(lease: Lease, clock: Clock) -> None:
    lease.admit(ADA, is_idle=True)
    clock.time = GONE_SECONDS + 1.0
    assert lease.note_gone()
    assert not lease.note_gone()
    with pytest.raises(StateError, match=r"Ada is in control and has been gone for 16 s\. Take control"):
        lease.admit(GRACE, is_idle=False)
    with pytest.raises(StateError, match="Take control"):
        lease.ask(GRACE)
    lease.take(GRACE)
    assert holder(lease) == "Grace"
    assert not lease.now.is_gone


def test_a_holder_who_comes_back_still_holds_the_robot(lease: Lease, clock: Clock) -> None:
    lease.admit(ADA, is_idle=True)
    clock.time = GONE_SECONDS + 1.0
    lease.note_gone()
    assert lease.heard("a")
    assert not lease.now.is_gone
    clock.time += GONE_SECONDS + 1.0
    assert lease.note_gone()


def test_a_script_holds_the_robot_only_while_it_is_armed_or_moves(lease: Lease, clock: Clock) -> None:
    lease.admit(SCRIPT, is_idle=True)
    with pytest.raises(StateError, match=r"A script is in control\. Take over, or wait"):
        lease.admit(ADA, is_idle=False)
    clock.time = 10 * GONE_SECONDS
    assert not lease.note_gone()
    assert lease.admit(ADA, is_idle=True)
    assert holder(lease) == "Ada"


def test_a_script_cannot_be_asked_so_it_may_be_taken_over(lease: Lease) -> None:
    lease.admit(Person("api", "Alan", is_script=True), is_idle=False)
    with pytest.raises(StateError, match="A script of Alan is in control"):
        lease.ask(ADA)
    lease.take(ADA)
    assert holder(lease) == "Ada"


@pytest.mark.parametrize("act", ["give", "keep", "release"])
def test_nobody_can_hand_over_what_nobody_holds(lease: Lease, act: str) -> None:
    with pytest.raises(StateError, match="No one is in control"):
        getattr(lease, act)(ADA)


def test_the_policy_says_what_happens_to_a_run() -> None:
    assert "pauses at the next pose with all feet down" in policy(ADA)
    assert "Ada" in policy(ADA)
    assert "goes on to its end" in policy(SCRIPT)
    assert all("disarmed" in policy(holder) for holder in (ADA, SCRIPT))


def test_a_lease_is_abandoned_when_nobody_was_there_for_a_while(lease: Lease, clock: Clock) -> None:
    for holder in (ADA, SCRIPT):
        lease.take(holder)
        clock.time += GONE_SECONDS
        assert not lease.is_abandoned
        clock.time += 1.0
        assert lease.is_abandoned
        lease.at_work()
        assert lease.is_abandoned is not holder.is_script
        lease.take(holder)
        lease.drop(holder)
        assert not lease.is_abandoned
    clock.time += GONE_SECONDS + 1.0
    assert lease.is_abandoned


class HandsOver(RuleBasedStateMachine):
    """Whatever three pages do: one holds the robot at most, and only that one may move it."""

    def __init__(self) -> None:
        super().__init__()
        self.clock = Clock()
        self.lease = Lease(self.clock)
        self.people = (ADA, GRACE, SCRIPT)

    @rule(who=st.integers(0, 2), verb=st.sampled_from(["take", "ask", "give", "keep", "release"]))
    def hand_over(self, who: int, verb: str) -> None:
        before, person = self.lease.now, self.people[who]
        try:
            getattr(self.lease, verb)(person)
        except StateError:
            assert self.lease.now == before
            return
        after = self.lease.now.holder
        if before.holder not in (None, after):
            taken = verb == "take" and before.can_be_taken
            assert taken or person == before.holder

    @rule(who=st.integers(0, 2), is_idle=st.booleans())
    def move_the_robot(self, who: int, is_idle: bool) -> None:
        before, person = self.lease.now.holder, self.people[who]
        free = before is None or before == person or (before.is_script and is_idle)
        try:
            self.lease.admit(person, is_idle=is_idle)
        except StateError:
            assert not free
        else:
            assert free
            assert self.lease.now.holder == person

    @rule(seconds=st.floats(0.1, 2 * GONE_SECONDS), who=st.integers(0, 2))
    def time_passes(self, seconds: float, who: int) -> None:
        self.clock.time += seconds
        self.lease.heard(self.people[who].page)

    @invariant()
    def who_asks_does_not_hold(self) -> None:
        now = self.lease.now
        assert now.asker is None or now.asker != now.holder
        assert now.holder is not None or now.asker is None


TestHandsOver = HandsOver.TestCase
