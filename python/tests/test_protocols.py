import inspect
import re
import runpy
import subprocess
import sys
import time
from pathlib import Path

import pytest

import pytautline as tautline
from mutex import Mutex
from pytautline import Mail, Move, RuleNeverEnds, RuleNotPure, RuleRaised, RuleWrongType
from ring import Ring

LIBRARY = Path(__file__).parents[2] / "docs" / "library.md"


def of_the_library(clause, bound):
    """The verdict and the states of the same rule in Rust, as the page of the library has them."""
    row = rf"^\| {clause} \| published(?: outside its premises)? \| (\w+) \| {re.escape(bound)} \| (\d+) \|"
    verdict, states = re.search(row, LIBRARY.read_text(), re.MULTILINE).groups()
    return verdict, int(states)


@pytest.mark.parametrize("rule", [Ring(5, 5), Ring(5, 4), Ring(5, 3), Ring(4, 2), Mutex(3, 0), Mutex(3, 1), Mutex(2, 1)])
def test_verdicts_and_counts_are_those_of_the_rule_in_rust(rule):
    clauses = {
        (Ring, 5): ["KSTATE-1", "KSTATE-2"],
        (Ring, 4): ["KSTATE-2"],
        (Ring, 3): ["KSTATE-2"],
        (Ring, 2): ["KSTATE-2"],
        (Mutex, 3): ["MUTEX-1"] if rule.bound.endswith("1 lost") else ["MUTEX-1", "MUTEX-2"],
        (Mutex, 2): ["MUTEX-2"],
    }[type(rule), rule.states if isinstance(rule, Ring) else rule.nodes]
    found = tautline.decide_protocol(rule)
    for clause in clauses:
        assert (found[clause].verdict, found[clause].states) == of_the_library(clause, rule.bound)


def test_a_counterexample_is_the_one_that_the_library_draws():
    page = LIBRARY.read_text()
    ring = tautline.decide_protocol(Ring(4, 2))["KSTATE-2"].counterexample
    assert "```text\n" + ring.story + "```" in page
    assert str(ring) == ring.story and "and so on for ever" in ring.story
    assert ring.again[-1].to == ([ring.start, *(move.to for move in ring.moves)])[-1]

    lost = tautline.decide_protocol(Mutex(2, 1))["MUTEX-2"].counterexample
    assert (lost.moves[-1].words, lost.moves[-1].actors) == ("a message is lost", ())
    assert lost.again == [] and "nobody moves any more" in lost.story


def test_random_runs_break_what_is_refuted_and_nothing_else(tmp_path):
    kept = tautline.hunt_protocol(Ring(4, 4), runs=200)
    assert kept == {"KSTATE-1": None, "KSTATE-2": None}

    found, again = (tautline.hunt_protocol(Mutex(3, 1), runs=2000, seed=7) for _ in range(2))
    assert found["MUTEX-1"] is None and found["MUTEX-2"].story == again["MUTEX-2"].story
    path = tmp_path / "found.jsonl"
    found["MUTEX-2"].store(path)
    assert tautline.replay_protocol(Mutex(3, 1), path).moves == found["MUTEX-2"].moves
    assert tautline.hunt_protocol(Mutex(3, 1), runs=2000, seed=7, max_moves=1) == {"MUTEX-1": None, "MUTEX-2": None}

    class Nowhere(Ring):
        def starts(self):
            return []

    with pytest.raises(tautline.InputError, match="no run can begin"):
        tautline.hunt_protocol(Nowhere(3, 3), runs=1)


def test_of_two_numbers_that_are_equal_one_is_smaller():
    found = tautline.decide_protocol(Mutex(3, 0, breaks_ties=False))
    assert found["MUTEX-2"].verdict == "refuted" and found.verdict == "refuted"


def test_a_run_that_was_stored_is_replayed_by_its_rule_alone(tmp_path):
    path = tmp_path / "found.jsonl"
    found = tautline.decide_protocol(Ring(4, 2))["KSTATE-2"].counterexample
    found.store(path)
    again = tautline.replay_protocol(Ring(4, 2), path)
    assert (again.clause, again.start, again.moves, again.again, again.story) == (
        found.clause,
        found.start,
        found.moves,
        found.again,
        found.story,
    )
    with pytest.raises(tautline.InputError, match="bound"):
        tautline.replay_protocol(Ring(4, 3), path)
    with pytest.raises(tautline.InputError, match='no rule that is known here has the clause "KSTATE-2"; play it by its own rule'):
        tautline.replay_protocol(Mutex(2, 0), path)

    class Other(Ring):
        """Its moves come in another order."""

        def moves(self, ring):
            return [*super().moves(ring)][:1]

    with pytest.raises(tautline.InputError, match="here there"):
        tautline.replay_protocol(Other(4, 2), path)
    with pytest.raises(tautline.InputError):
        found.store(path / "no" / "folder")
    with pytest.raises(tautline.InputError, match="no such file; name a file that StateRun.store wrote"):
        tautline.replay_protocol(Ring(4, 2), path / "none")
    text = path.read_text()
    assert '"demand":"there is one privilege"' in text
    path.write_text(text.replace('"taken":0', '"taken":1', 1))
    with pytest.raises(tautline.InputError, match="store it again with StateRun.store"):
        tautline.replay_protocol(Ring(4, 2), path)


def test_the_example_comes_out_as_it_says(capsys):
    runpy.run_module("ring", run_name="__main__")
    holds, refuted = capsys.readouterr().out.split("\n", 1)
    assert holds.startswith("5 holds 3125") and refuted.startswith("3 refuted 243 start")


class Lamp(tautline.Protocol):
    """Two lamps, each switched by an actor of its own."""

    demands = (tautline.eventually("LAMP-1", "both are on", all),)

    def starts(self):
        return [(False, False)]

    def moves(self, lamps):
        for lamp in range(2):
            if not lamps[lamp]:
                yield Move.of(lamp, "switches on", (*lamps[:lamp], True, *lamps[lamp + 1 :]))


def test_who_is_fair_and_what_is_bound_to_happen():
    assert tautline.decide_protocol(Lamp()).verdict == "holds"

    class Blinks(Lamp):
        """The first lamp can be switched for ever."""

        def moves(self, lamps):
            yield Move.of(0, "switches", (not lamps[0], lamps[1]))
            if not lamps[1]:
                yield Move.of(1, "switches on", (lamps[0], True))

    assert tautline.decide_protocol(Blinks()).verdict == "holds"

    class Owned(Blinks):
        """One actor switches both, and need not be fair to the second."""

        def moves(self, lamps):
            return [Move.of_all(1, words, to) for _, words, to in super().moves(lamps)]

    unfair = tautline.decide_protocol(Owned())["LAMP-1"].counterexample
    assert (unfair.moves, len(unfair.again)) == ([], 2)

    class Lucky(Lamp):
        """The second lamp goes on by a fault alone."""

        def moves(self, lamps):
            return [move if move.actors == (0,) else Move.fault(*move[1:]) for move in super().moves(lamps)]

    still = tautline.decide_protocol(Lucky())["LAMP-1"].counterexample
    assert [move.to for move in still.moves] == [(True, False)] and still.again == []

    class Owes(Blinks):
        demands = (tautline.again_and_again("LAMP-2", "the first is off", lambda lamps: [3] if lamps[1] else []),)

    owes = tautline.decide_protocol(Owes())["LAMP-2"].counterexample
    assert owes.moves[-1].to[1] and len(owes.again) == 2


def test_states_that_are_alike_are_one():
    class Alike(Lamp):
        demands = (tautline.always("LAMP-3", "none goes off", lambda before, after: sum(before) <= sum(after)),)

        def moves(self, lamps):
            return [Move.of_all(1, words, to) for _, words, to in super().moves(lamps)]

        def alike(self, lamps):
            return [lamps[::-1]]

    found = tautline.decide_protocol(Alike())
    assert (found.verdict, found["LAMP-3"].states) == ("holds", 3)

    class Unlike(Alike):
        def alike(self, lamps):
            return [(True, True)]

    with pytest.raises(RuleWrongType, match=r"\(False, False\) and \(True, True\) are taken for one"):
        tautline.decide_protocol(Unlike())


def test_states_without_end_are_searched_up_to_a_budget_by_default():
    class Grows(tautline.Protocol):
        demands = [tautline.always("GROW-1", "it grows", lambda before, after: after > before)]

        def starts(self):
            return [0]

        def moves(self, state):
            yield Move.of(0, "grows", state + 1)

    default = inspect.signature(tautline.decide_protocol).parameters["budget"].default
    assert default == 10_000_000
    found = tautline.decide_protocol(Grows(), budget=1000)["GROW-1"]
    assert (found.verdict, found.complete) == ("open", False)
    assert found.note.startswith(f"budget has ended the search after {found.states} states: give it more, bound the rule")


def test_a_move_is_told_by_the_name_of_whoever_makes_it():
    class Named(tautline.Protocol):
        demands = [tautline.always("NAME-1", "it stays below 3", lambda before, after: after < 3)]

        def starts(self):
            return [0]

        def moves(self, state):
            yield Move.of(0, "acts", 1, by=41) if state == 0 else Move.of(1, "opens", 2) if state == 1 else Move.of_all(2, "both go", 3)

        def actor(self, number):
            return "the door" if number == 1 else f"machine {number}"

    run = tautline.decide_protocol(Named())["NAME-1"].counterexample
    assert run.story.splitlines()[0].split("   ") == ["start", "machine 41 acts", "the door opens", "both go"]
    assert [move.by for move in run.moves] == [41, None, None]
    with pytest.raises(RuleWrongType):
        tautline.decide_protocol(type("Changed", (Named,), {"actor": lambda self, number: number})())


@pytest.mark.parametrize(
    ("change", "complete"), [({"starts": lambda rule: []}, True), ({"covers": ("switches off",)}, True), ({}, False)]
)
def test_a_quantifier_over_nothing_a_move_that_never_occurs_and_a_budget_leave_the_question_open(change, complete):
    rule = type("Changed", (Lamp,), change)()
    found = tautline.decide_protocol(rule, budget=None if complete else 2)
    assert (found.verdict, found["LAMP-1"].complete, found["LAMP-1"].covered) == ("open", complete, [])
    why = "budget has ended the search after " if not complete else "never occurred: switches off" if "covers" in change else "there is no start"
    assert found["LAMP-1"].note.startswith(why)
    with pytest.raises(KeyError):
        found["LAMP-2"]


@pytest.mark.parametrize(
    ("function", "answer"),
    [
        ("starts", 7),
        ("starts", [[]]),
        ("moves", 7),
        ("moves", [7]),
        ("moves", [Move((0,), "goes", [])]),
        ("moves", [Move((16,), "goes", 0)]),
        ("moves", [Move((-1,), "goes", 0)]),
        ("moves", [((0,), 0, "goes")]),
        ("alike", 7),
        ("alike", [{}]),
        ("draw", 7),
        ("actor", 7),
    ],
)
def test_an_answer_that_is_none_is_refused(function, answer):
    rule = type("Wrong", (Lamp,), {function: lambda *_: answer, "demands": (tautline.eventually("LAMP-4", "never", lambda _: False),)})
    with pytest.raises(RuleWrongType, match=function) as refused:
        tautline.decide_protocol(rule())
    assert refused.value.remedy


@pytest.mark.parametrize("answer", ["yes", None, 1])
@pytest.mark.parametrize("made", [tautline.always, tautline.at_the_end, tautline.eventually])
def test_a_demand_that_says_neither_yes_nor_no_is_refused(made, answer):
    rule = type("Wrong", (Lamp,), {"demands": (made("LAMP-5", "words", lambda *_: answer),)})
    with pytest.raises(RuleWrongType, match="LAMP-5"):
        tautline.decide_protocol(rule())


def test_a_message_is_a_tuple():
    with pytest.raises(TypeError, match="0 is no message: send tuples of a sender, a receiver"):
        tautline.Mail().send(0, 1, "asks")


@pytest.mark.parametrize("owed", [7, ["one"], [16]])
def test_what_is_owed_are_numbers(owed):
    rule = type("Wrong", (Lamp,), {"demands": (tautline.again_and_again("LAMP-6", "words", lambda _: owed),)})
    with pytest.raises(RuleWrongType, match="LAMP-6"):
        tautline.decide_protocol(rule())


@pytest.mark.parametrize("demands", [(), 7, [7], [tautline.never_endless("LAMP-7", "words")], [tautline.always("a b", "", all)]])
def test_a_rule_that_demands_nothing_of_states_is_refused(demands):
    with pytest.raises((tautline.InputError, RuleWrongType)) as refused:
        tautline.decide_protocol(type("Wrong", (Lamp,), {"demands": demands})())
    assert refused.value.remedy


def test_two_demands_of_one_id_are_refused():
    class Twice(Lamp):
        demands = [tautline.always("LAMP-7", "ever", all), tautline.at_the_end("LAMP-7", "never", lambda _: False)]

    for asked in (tautline.decide_protocol, lambda rule: tautline.hunt_protocol(rule, runs=1)):
        with pytest.raises(tautline.InputError, match="two demands have the id LAMP-7"):
            asked(Twice())


@pytest.mark.parametrize("function", ["starts", "moves", "alike", "draw", "actor"])
def test_an_exception_of_the_rule_is_its_cause(function):
    def raises(*_):
        raise LookupError("here")
        yield

    rule = type("Raises", (Lamp,), {function: raises if function == "moves" else lambda *_: {}[0]})
    rule.demands = (tautline.eventually("LAMP-8", "never", lambda _: False),)
    with pytest.raises(RuleRaised, match=f"{function} of the rule written raised") as refused:
        tautline.decide_protocol(rule())
    assert isinstance(refused.value.__cause__, LookupError) and refused.value.remedy


def test_a_rule_whose_moves_are_no_function_of_the_state_is_refused():
    class Moody(Lamp):
        calls = 0

        def moves(self, lamps):
            type(self).calls += 1
            return [Move.of(0, "goes", (self.calls,))] if self.calls < 40 else []

    with pytest.raises(RuleNotPure):
        tautline.decide_protocol(Moody())

    class State:
        """It is equal to itself alone."""

    class Fresh(Lamp):
        def moves(self, lamps):
            return [Move.of(0, "goes", State())]

    with pytest.raises(RuleNotPure, match="equal"):
        tautline.decide_protocol(Fresh())


def test_a_function_that_never_ends_is_interrupted():
    class Stuck(Lamp):
        def moves(self, lamps):
            while True:
                yield Move.of(0, "goes", (True, True))

    begun = time.monotonic()
    with pytest.raises(RuleNeverEnds, match="has not returned"):
        tautline.decide_protocol(Stuck(), patience_s=0.2)
    assert time.monotonic() - begun < 5


@pytest.mark.parametrize("function", ["__eq__", "__hash__"])
def test_a_comparison_of_states_that_never_ends_is_interrupted(function):
    def forever(*_):
        while True:
            pass

    state = type("State", (), {"__eq__": lambda *_: True, "__hash__": lambda _: 1, function: forever})

    class Stuck(Lamp):
        def moves(self, lamps):
            return [Move.of(0, "goes", state()), Move.of(0, "goes", state())]

    begun = time.monotonic()
    with pytest.raises(RuleNeverEnds, match="comparing a state that moves returned .* has not returned"):
        tautline.decide_protocol(Stuck(), patience_s=0.2)
    assert time.monotonic() - begun < 5


def test_words_of_moves_are_few():
    class Wordy(Lamp):
        def moves(self, lamps):
            return [Move.of(0, f"goes to {sum(lamps)}", (*lamps, 1))]

    with pytest.raises(tautline.InputError, match="256 different words"):
        tautline.decide_protocol(Wordy())


def test_mail_is_one_whatever_the_order_in_which_it_was_sent():
    mail = Mail(1).send((1, 0, "b"), (0, 1, "a"))
    assert mail == Mail(1).send((0, 1, "a")).send((1, 0, "b")) and hash(mail)
    moves = list(mail.moves(lambda letter, left: letter[2], lambda left: left.losses))
    assert moves == [Move.of(1, "hears", "a"), Move.of(0, "hears", "b"), *[Move.fault("a message is lost", 0)] * 2]
    assert [move.words for move in Mail().send((0, 1, "a")).moves(lambda *_: 0, hash)] == ["hears"]


def test_ctrl_c_ends_a_search():
    endless = """
import pytautline as tautline
from pytautline import Move
class Counts(tautline.Protocol):
    demands = [tautline.always("COUNT-1", "words", lambda before, after: True)]
    def starts(self):
        print("begun", flush=True)
        return [0]
    def moves(self, state):
        return [Move.of(0, "counts", state + 1)]
tautline.decide_protocol(Counts())
"""
    running = subprocess.Popen([sys.executable, "-c", endless], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert running.stdout.readline() == "begun\n"
    running.send_signal(2)
    assert "KeyboardInterrupt" in running.communicate(timeout=10)[1]
