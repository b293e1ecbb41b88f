import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

import pytautline as tautline
from followers import Followers
from pytautline import RuleNeverEnds, RuleNotPure, RuleRaised, RuleWrongType


def test_the_rule_of_the_tutorial_is_refuted_in_two_moves_with_one_wall(tmp_path):
    found = tautline.hunt_rule(Followers())
    assert (found.verdict, found.complete, found.given_up) == ("refuted", True, 0)
    first = found.counterexamples[0]
    assert (first.clause, first.run.steps, first.run.clause) == ("FOLLOW-1", 2, "FOLLOW-1")
    assert np.asarray(first.run.layout.east).sum() + np.asarray(first.run.layout.south).sum() == 1
    assert first.run._repr_svg_().startswith("<svg ")
    first.run.store(tmp_path / "found.jsonl")
    assert tautline.replay(tmp_path / "found.jsonl").violations == first.run.violations


def test_repaired_it_holds_in_all_layouts():
    found = tautline.hunt_rule(Followers(leader=(0, 0)))
    assert (found.verdict, found.counterexamples) == ("holds", [])
    # As the rule in Rust of the tutorial: docs/own-rule.md.
    assert found.runs == 24
    assert found.covered == ["a step", "a wall"]
    assert found.levels[0][0] == 1 and sum(runs for runs, _ in found.levels) == found.runs


def test_the_template_comes_out_as_it_says():
    template = Path(__file__).parents[2] / "templates" / "rule.py"
    ran = subprocess.run([sys.executable, template], capture_output=True, text=True, check=True)
    assert ran.stdout.startswith("ours: holds, ") and ran.stdout.endswith("does not look: refuted\n")


class Walker(tautline.Rule):
    """One robot that goes east until it meets a wall, or for ever back and forth."""

    scheme = "walker"
    robots = 1
    size = (3, 1)
    max_walls = 2
    patrols = False

    def start(self):
        return 0, [(0, 0)]

    def step(self, state, cells, blocked):
        if blocked[0]:
            return (1 - state, "EW"[1 - state]) if self.patrols else None
        return state, "EW"[state]

    demands = [tautline.never_endless("WALK-1", "no run comes back")]


def test_each_demand_is_decided_in_its_own_way():
    assert tautline.hunt_rule(Walker()).verdict == "holds"

    class Patrol(Walker):
        patrols = True

    endless = tautline.hunt_rule(Patrol())
    # Once there and back: then it goes on as after its first team move.
    assert endless.counterexamples[0].run.steps == 7
    assert [(found.clause, found.run.stopped) for found in endless.counterexamples] == [("WALK-1", "endless")]

    class Arrives(Walker):
        demands = [tautline.at_the_end("WALK-2", "it arrives", lambda state, cells: cells == ((2, 0),))]

    left = tautline.hunt_rule(Arrives())
    assert left.verdict == "refuted" and left.counterexamples[0].run.steps == 1


def test_a_patrol_owes_visits_again_and_again():
    def unvisited(state, cells):
        return {0, 1, 2} - {x for x, _ in cells}

    class Patrol(Walker):
        patrols = True
        max_walls = 0
        demands = [
            tautline.again_and_again("WALK-5", "every cell is visited again and again", unvisited),
            tautline.again_and_again("WALK-6", "the last cell is left", lambda state, cells: [15] if cells[0] == (2, 0) else []),
        ]

    assert tautline.hunt_rule(Patrol()).verdict == "holds"
    for wrong, is_endless in [({"max_walls": 1}, True), ({"patrols": False}, False)]:
        first = tautline.hunt_rule(type("Wrong", (Patrol,), wrong)()).counterexamples[0]
        assert (first.clause, first.run.stopped == "endless") == ("WALK-5", is_endless)

    Patrol.demands = [tautline.again_and_again("WALK-7", "words", lambda state, cells: [16])]
    with pytest.raises(RuleWrongType, match="WALK-7"):
        tautline.hunt_rule(Patrol())


def test_what_is_to_be_so_at_some_time_is_so_before_a_round_in_it_or_at_the_end():
    class Patrol(Walker):
        patrols = True
        max_walls = 0
        demands = [
            tautline.eventually("WALK-8", "it comes to the last cell", lambda state, cells: cells == ((2, 0),)),
            tautline.eventually("WALK-9", "it is in the first cell", lambda state, cells: cells == ((0, 0),)),
        ]

    assert tautline.hunt_rule(Patrol()).verdict == "holds"
    # A wall keeps it from the last cell: it goes back and forth for ever, or stands before it.
    for wrong, is_endless in [({"max_walls": 1}, True), ({"max_walls": 1, "patrols": False}, False)]:
        found = tautline.hunt_rule(type("Wrong", (Patrol,), wrong)())
        assert [example.clause for example in found.counterexamples] == ["WALK-8"]
        run = found.counterexamples[0].run
        assert np.asarray(run.layout.east).sum() == 1 and (run.stopped == "endless") == is_endless

    # It was so before the round: a walker that has left the first cell stays in the last one.
    class Settles(Walker):
        def step(self, state, cells, blocked):
            return (1, ".") if state or blocked[0] else (0, "E")

        demands = [Patrol.demands[1], tautline.eventually("WALK-10", "it knows the wall", lambda state, cells: state == 1)]

    assert tautline.hunt_rule(Settles()).verdict == "holds"
    Settles.demands = [tautline.always("WALK-11", "it moves", lambda moved: moved.tried != "."), *Patrol.demands, *Walker.demands]
    found = tautline.hunt_rule(Settles())
    assert {example.clause for example in found.counterexamples} == {"WALK-1", "WALK-8", "WALK-11"}
    alone = tautline.hunt_rule(type("Alone", (Settles,), {"demands": Walker.demands})()).counterexamples[0]
    assert [example.run.steps for example in found.counterexamples if example.clause == "WALK-1"] == [alone.run.steps]

    Patrol.demands = [tautline.eventually("WALK-12", "words", lambda state: True)]
    with pytest.raises(RuleRaised, match="WALK-12"):
        tautline.hunt_rule(Patrol())


def test_a_demand_is_decided_as_if_it_stood_alone():
    class Patrol(Walker):
        patrols = True
        demands = [tautline.always("WALK-2", "it stays where it is", lambda moved: moved.cells == moved.cells_before), *Walker.demands]

    found = tautline.hunt_rule(Patrol())
    assert [example.clause for example in found.counterexamples] == ["WALK-2", "WALK-1"]
    assert found.complete and found.counterexamples[1].run.stopped == "endless"


@pytest.mark.parametrize("longest_run, verdict", [(2, "open"), (3, "refuted"), (4, "refuted")])
def test_the_last_move_of_a_longest_run_may_break_a_demand(longest_run, verdict):
    class Far(Walker):
        size = (5, 1)
        demands = [tautline.always("WALK-4", "it never comes so far", lambda moved: moved.cells != ((3, 0),))]

    Far.longest_run = longest_run
    found = tautline.hunt_rule(Far())
    assert (found.verdict, [example.run.steps for example in found.counterexamples]) == (verdict, [3][verdict == "open":])


@pytest.mark.parametrize(("wrong", "meant"), [("demand", "demands"), ("max_wals", "max_walls"), ("cover", "covers")])
def test_an_attribute_that_is_nearly_one_of_a_rule_is_refused(wrong, meant):
    change = {wrong: 3, meant: getattr(tautline.Rule, meant), "steps": 5, "leader": (0, 0)}
    rule = type("Misspelt", (tautline.Rule,), {**vars(Walker), **change})
    with pytest.raises(tautline.InputError, match=f"the rule has {wrong}, which no Rule has; call it {meant}, or"):
        tautline.hunt_rule(rule())


def test_a_rule_without_demands_and_a_class_in_its_place_are_refused():
    with pytest.raises(tautline.InputError, match="nothing is demanded"):
        tautline.hunt_rule(type("Modest", (Walker,), {"demands": []})())
    with pytest.raises(RuleWrongType, match=r"the rule is the class Walker; give an instance of it: Walker\(\)"):
        tautline.hunt_rule(Walker)


def test_two_demands_of_one_id_are_refused():
    class Twice(Walker):
        demands = [*Walker.demands, tautline.always("WALK-1", "never", lambda moved: False)]

    with pytest.raises(tautline.InputError, match="two demands have the id WALK-1"):
        tautline.hunt_rule(Twice())


def test_what_is_heard_last_is_known_at_the_end():
    class Counts(Walker):
        """It knows at its end that it has met a wall, as it says."""

        def step(self, state, cells, blocked):
            return (1, None) if blocked[0] else (0, "E")

        demands = [tautline.at_the_end("WALK-3", "it knows of the wall", lambda state, cells: state == 1)]

    found = tautline.hunt_rule(Counts())
    assert (found.verdict, found.complete) == ("holds", True)


def test_a_situation_that_never_occurs_leaves_the_question_open():
    class Uncovered(Walker):
        covers = [("a step north", lambda moved: moved.tried == "N")]

    found = tautline.hunt_rule(Uncovered())
    assert (found.verdict, found.covered) == ("open", [])


def test_a_run_that_neither_ends_nor_comes_back_is_given_up():
    class Counts(Walker):
        longest_run = 50

        def step(self, state, cells, blocked):
            return state + 1, "."

    found = tautline.hunt_rule(Counts())
    assert (found.verdict, found.given_up, found.longest) == ("open", 1, 50)


def test_a_rule_that_raises_is_refused_with_the_cause():
    class Raises(Walker):
        def step(self, state, cells, blocked):
            return {}["missing"]

    with pytest.raises(RuleRaised, match="step of the rule written raised KeyError") as refused:
        tautline.hunt_rule(Raises())
    assert isinstance(refused.value.__cause__, KeyError) and refused.value.remedy

    class Demanding(Walker):
        demands = [tautline.always("WALK-3", "words", lambda moved: 1 / 0)]

    with pytest.raises(RuleRaised, match="WALK-3"):
        tautline.hunt_rule(Demanding())


class Unlike:
    """A state that cannot be compared."""

    def __hash__(self):
        return 0

    def __eq__(self, other):
        return 1 / 0


@pytest.mark.parametrize(
    ("change", "kind", "said", "cause"),
    [
        ({"step": lambda *_: (Unlike(), "E"), "start": lambda _: (Unlike(), [(0, 0)])}, RuleRaised, "comparing", ZeroDivisionError),
        ({"start": lambda _: ([], [(0, 0)])}, RuleWrongType, "cannot be hashed", TypeError),
        ({"robots": property(lambda _: 1 / 0)}, RuleRaised, "robots of the rule raised", ZeroDivisionError),
        ({"demands": [1]}, RuleWrongType, "the demand 1 has no id", None),
        ({"size": (100000, 1)}, tautline.InputError, "100000; .* from 1 to 16", None),
        ({"size": 7}, RuleWrongType, "1 to 16 columns", None),
        ({"robots": -1}, tautline.InputError, "robots is -1; give robots a whole number from 1 to 8", None),
    ],
)
def test_a_rule_is_refused_with_its_cause_and_its_bound(change, kind, said, cause):
    with pytest.raises(kind, match=said) as refused:
        tautline.hunt_rule(type("Wrong", (Walker,), change)())
    assert type(refused.value.__cause__) is (cause or type(None))


@pytest.mark.parametrize(
    "answer", [7, "E", (0,), (0, 1), (0, "EE"), (0, "X"), (0, "E", 1), ([], "E"), object()]
)
def test_a_rule_that_returns_a_wrong_type_is_refused(answer):
    class Wrong(Walker):
        def step(self, state, cells, blocked):
            return answer

    with pytest.raises(RuleWrongType) as refused:
        tautline.hunt_rule(Wrong())
    assert refused.value.remedy and isinstance(refused.value, TypeError)


@pytest.mark.parametrize("answer", [None, 7, (0, [(0, 0), (1, 0)]), (0, [(5, 5)]), (0, ["a"]), ([], [(0, 0)])])
def test_a_wrong_start_is_refused(answer):
    class Wrong(Walker):
        def start(self):
            return answer

    with pytest.raises(RuleWrongType):
        tautline.hunt_rule(Wrong())


def test_a_demand_that_says_neither_yes_nor_no_is_refused():
    class Wrong(Walker):
        demands = [tautline.always("WALK-3", "words", lambda moved: "yes")]

    with pytest.raises(RuleWrongType, match="True or False"):
        tautline.hunt_rule(Wrong())


@pytest.mark.parametrize(
    "change",
    [
        {"size": (17, 1)},
        {"size": (0, 1)},
        {"size": "large"},
        {"robots": 9},
        {"robots": 0},
        {"max_walls": 99},
        {"max_walls": -1},
        {"robots": -1},
        {"robots": 2**80},
        {"size": (100000, 1)},
        {"demands": range(10**14)},
        {"scheme": "chain"},
        {"scheme": "<b>"},
        {"demands": [7]},
        {"demands": 7},
        {"covers": [("a", 1, 2)]},
    ],
)
def test_a_rule_that_is_none_is_refused(change):
    wrong = type("Wrong", (Walker,), change)
    with pytest.raises((tautline.InputError, RuleWrongType)) as refused:
        tautline.hunt_rule(wrong())
    assert refused.value.remedy


def test_a_rule_that_never_ends_is_interrupted():
    class Stuck(Walker):
        def step(self, state, cells, blocked):
            while True:
                pass

    begun = time.monotonic()
    with pytest.raises(RuleNeverEnds, match="has not returned") as refused:
        tautline.hunt_rule(Stuck(), patience_s=0.2)
    assert time.monotonic() - begun < 5
    assert "patience_s" in refused.value.remedy
    with pytest.raises(tautline.InputError):
        tautline.hunt_rule(Walker(), patience_s=0)


def test_a_rule_that_is_not_pure_is_refused():
    class Moody(Walker):
        calls = 0

        def step(self, state, cells, blocked):
            type(self).calls += 1
            return (0, "E") if type(self).calls < 3 else None

        demands = [tautline.always("WALK-3", "words", lambda moved: moved.cells != ((2, 0),))]

    with pytest.raises(RuleNotPure):
        tautline.hunt_rule(Moody())


def test_a_budget_leaves_the_question_open():
    found = tautline.hunt_rule(Followers(leader=(0, 0)), budget=5)
    assert (found.verdict, found.complete) == ("open", False)
