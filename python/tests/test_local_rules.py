import pytest

import pytautline as tautline
from convoy import Convoy, steps
from pytautline import InputError, LocalRule, RuleNeverEnds, RuleRaised, RuleWrongType


def test_the_convoy_is_decided_for_every_number_of_robots_as_in_rust():
    found = tautline.decide_every_number(Convoy(), certificate=True)
    assert (found.verdict, found.counterexample) == ("holds", None)
    # As in docs/own-rule.md, but that a robot which stays has one outcome, and not two.
    assert found.note.startswith("the promise is an invariant: 13 of 25 places keep it")
    assert "Tautline" in found.certificate
    hasty = tautline.decide_every_number(Convoy(waits=False), certificate=True)
    assert (hasty.verdict, hasty.certificate) == ("refuted", None)
    assert hasty.counterexample.startswith("start")


class Apart(LocalRule):
    """Robots that leave and enter cells one at a time: never two in one cell."""

    name = "apart"
    reach = 0

    def admits(self, plans):
        one, other = plans
        return one.to not in (other.at, other.to) and other.to != one.at

    def keeps(self, robots):
        return robots[0].at != robots[1].at

    def may_start(self, robots):
        return robots[0].at != robots[1].at

    def start(self, robots):
        return [((robot, 0), None) for robot in range(robots)]


def changed(**change):
    return type("Changed", (Apart,), change)()


def test_a_wrong_rule_is_refuted_by_a_real_team():
    assert tautline.decide_every_number(Apart()).verdict == "holds"

    def only_goals(self, plans):
        return plans[0].to != plans[1].to

    # A wall stops the one ahead, and the other one enters its cell.
    found = tautline.decide_every_number(changed(admits=only_goals))
    assert found.verdict == "refuted" and "wall" in found.counterexample


def test_a_planner_that_knows_the_layout_meets_no_wall():
    goes = {"acts": lambda self, state: [("E", [(True, state)]), (".", [(False, state)])]}
    only_goals = {"admits": lambda self, plans: plans[0].to != plans[1].to}
    with pytest.raises(InputError, match="there may be a wall"):
        tautline.decide_every_number(changed(**goes, **only_goals))
    found = tautline.decide_every_number(changed(meets_walls=False, **goes, **only_goals))
    assert found.verdict == "holds"


def test_states_and_triples_are_decided():
    class Three(Apart):
        """Never three in a cell: whoever would be the third waits."""

        robots = 3
        states = ("goes", "rests")

        def acts(self, state):
            if state == "rests":
                return [(".", [(False, "goes")])]
            return [(letter, [(True, "rests"), (False, "goes")]) for letter in "ESWN"]

        def admits(self, plans):
            cells = [{plan.at, plan.to} for plan in plans]
            return not set.intersection(*cells)

        def keeps(self, robots):
            return len({robot.at for robot in robots}) > 1

        def may_start(self, robots):
            return self.keeps(robots)

        def start(self, robots):
            return [((robot, 0), "goes") for robot in range(robots)]

    assert tautline.decide_every_number(Three()).verdict == "holds"
    careless = type("Careless", (Three,), {"admits": lambda self, plans: True})
    found = tautline.decide_every_number(careless())
    assert found.verdict == "refuted" and "'rests'" in found.counterexample


def test_a_rule_that_knows_where_it_is_is_refused():
    with pytest.raises(InputError, match="not the same everywhere"):
        tautline.decide_every_number(changed(admits=lambda self, plans: plans[0].to[0] >= 0))


def test_a_rule_that_admits_nothing_is_refused():
    with pytest.raises(InputError, match="the promise would be about nothing; let admits say yes") as refused:
        tautline.decide_every_number(changed(admits=lambda self, plans: False))
    assert "admit something" in refused.value.remedy


@pytest.mark.parametrize(
    ("change", "kind"),
    [
        ({"robots": 4}, InputError),
        ({"states": ()}, InputError),
        ({"states": tuple(range(257))}, InputError),
        ({"states": 7}, RuleWrongType),
        ({"states": ([],)}, RuleWrongType),
        ({"reach": 30000}, InputError),
        ({"reach": -1}, InputError),
        ({"reach": 32767}, InputError),
        ({"reach": 2**80}, InputError),
        ({"robots": -1}, InputError),
        ({"robots": property(lambda self: 1 / 0)}, RuleRaised),
        ({"start": lambda self, robots: range(10**14), "admits": lambda self, plans: True}, RuleWrongType),
        ({"reach": "far"}, RuleWrongType),
        ({"name": "<b>"}, InputError),
        ({"acts": lambda self, state: [("X", [(True, None)])]}, RuleWrongType),
        ({"acts": lambda self, state: [("E", [])]}, RuleWrongType),
        ({"acts": lambda self, state: [("E", [(True, 7)])]}, InputError),
        ({"acts": lambda self, state: [("E", [(True, None)])]}, InputError),
        ({"meets_walls": "no"}, RuleWrongType),
        ({"start": lambda self, robots: [((robot % 4, 0), None) for robot in range(robots)]}, InputError),
        ({"admits": lambda self, plans: "yes"}, RuleWrongType),
        ({"admits": lambda self, plans: 1 / 0}, RuleRaised),
        ({"keeps": lambda self, robots: True, "may_start": lambda self, robots: 1 / 0}, RuleRaised),
        ({"may_start": lambda self, robots: True}, InputError),
        ({"start": lambda self, robots: 7}, RuleWrongType),
        ({"start": lambda self, robots: []}, InputError),
        ({"start": lambda self, robots: [((0, 0), None)] * robots}, InputError),
        ({"start": lambda self, robots: 1 / 0}, RuleRaised),
    ],
)
def test_a_rule_that_is_none_is_refused(change, kind):
    with pytest.raises(kind) as refused:
        tautline.decide_every_number(changed(**change))
    assert refused.value.remedy


def test_a_rule_that_never_returns_is_ended():
    def forever(self, plans):
        while True:
            pass

    with pytest.raises(RuleNeverEnds):
        tautline.decide_every_number(changed(admits=forever), patience_s=0.2)


def test_a_leash_that_forgets_walls_is_refuted():
    class Leash(LocalRule):
        reach = 2
        far_is_fine = False

        def admits(self, plans):
            return steps(plans[0].to, plans[1].to) <= 2

        def keeps(self, robots):
            return steps(robots[0].at, robots[1].at) <= 2

        def may_start(self, robots):
            return steps(robots[0].at, robots[1].at) == 1

        def start(self, robots):
            return [((robot, 0), None) for robot in range(robots)]

        in_a_row = True

    found = tautline.decide_every_number(Leash())
    assert found.verdict == "refuted" and "wall" in found.counterexample
