import json
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest

import pytautline as tautline
from pytautline import InputError

DOCS = Path(__file__).parents[2] / "docs"
FIGURES = Path(__file__).parent / "figures"


def test_the_json_is_byte_for_byte_that_of_the_program():
    for line in (FIGURES / "explore.jsonl").read_text().splitlines(keepends=True):
        kept = json.loads(line)
        run = tautline.explore(
            kept["layout"], kept["scheme"], rule=kept["rule"], robots=kept["robots"], seed=kept["seed"]
        )
        assert run.json() == line


def test_the_trace_is_byte_for_byte_that_of_the_program(tmp_path):
    run = tautline.explore("open:7x7", robots=4)
    assert run.trace() == (DOCS / "open-7x7.jsonl").read_text()
    run.store(tmp_path / "run.jsonl")
    again = tautline.replay(tmp_path / "run.jsonl")
    assert (again.trace(), again.steps, again.stopped) == (run.trace(), run.steps, run.stopped)


def test_a_whole_exploration_as_arrays():
    run = tautline.explore("open:15x15", robots=8)
    assert (run.steps, run.explored, run.cells, run.stopped, run.violations) == (62, 225, 225, "explored", [])
    assert run.milestones[100] == 62
    positions, order = np.asarray(run.positions()), np.asarray(run.order())
    assert positions.shape == (63, 8, 2) and order.shape == (15, 15)
    assert (positions[0] == (7, 7)).all() and (positions[:, 0] == (7, 7)).all()
    for step in range(63):
        for x, y in positions[step]:
            assert 0 <= order[y, x] <= step
    assert np.bincount(order.ravel(), minlength=63).sum() == 225
    moves = run.moves()
    assert [move["step"] for move in moves] == list(range(1, 63))
    assert [move["cells"] for move in moves] == positions[1:].tolist()


def test_every_scheme_and_every_rule_runs():
    for scheme, rules in tautline.schemes().items():
        for rule in rules:
            run = tautline.explore("open:4x4", scheme, rule=rule, robots=2, max_moves=200)
            assert (run.scheme, run.rule) == (scheme, rule)
            assert 0 < run.explored <= run.cells
            assert [move["step"] for move in run.moves()] == list(range(1, run.steps + 1))


def test_the_rule_is_the_repaired_one_or_the_only_one():
    assert tautline.explore("open:4x4").rule == "repaired"
    assert tautline.explore("open:4x4", "mdfs").rule == tautline.hunt("mdfs", size=(2, 1)).rule == "published"
    assert tautline.sweep(["open:4x4"], "mdfs").to_dict()["rule"] == ["published"]


def test_a_counterexample_is_hunted_drawn_made_minimal_and_stored(tmp_path):
    found = tautline.hunt(rule="published", robots=4, max_walls=2)
    assert (found.verdict, found.complete) == ("refuted", True)
    first = found.counterexamples[0]
    assert first.clause.startswith("CHAIN-")
    run = first.run
    assert run is not None and run.clause == first.clause
    assert run.violations[-1][0] == first.clause
    smaller = run.minimise()
    assert smaller.clause == first.clause
    assert smaller.layout.width * smaller.layout.height <= run.layout.width * run.layout.height
    assert first.clause in smaller.story()
    smaller.store(tmp_path / "small.jsonl")
    assert tautline.replay(tmp_path / "small.jsonl").clause == first.clause
    holds = tautline.hunt(robots=3, max_walls=1)
    assert (holds.verdict, holds.counterexamples) == ("holds", [])


class Tags(HTMLParser):
    def __init__(self):
        super().__init__()
        self.tags, self.frames = [], []

    def handle_starttag(self, tag, attrs):
        self.tags.append(tag)
        self.frames.extend(value for name, value in attrs if name == "srcdoc")


def test_a_notebook_draws_a_run():
    run = tautline.explore("open:5x5", robots=3)
    assert run._repr_svg_().startswith("<svg ")
    assert run.svg(moves=(1, 3)) != run.svg()
    cell = Tags()
    cell.feed(run._repr_html_())
    assert cell.tags == ["iframe"] and cell.frames == [run.html()]
    assert run.html().startswith("<!doctype html>")
    with pytest.raises(InputError, match="fewer moves"):
        tautline.explore("walls:15x15:0.1", rule="published", seed=7).svg(moves=(1, 300))


def test_what_does_not_fit_is_refused_with_what_to_do(tmp_path):
    cases = [
        (lambda: tautline.explore("open:5x5", "walks"), "take one of chain"),
        (lambda: tautline.explore("open:5x5", rule="perfect"), "published"),
        (lambda: tautline.explore("open:5x5", robots=1), "robots"),
        (lambda: tautline.explore("open:5x5", miss=0.5), "leave out"),
        (lambda: tautline.explore("open:5x5", "ants", miss=2.0), "from 0 to 1"),
        (lambda: tautline.explore("open:5x5", until=60), "50, 75 or 100"),
        (lambda: tautline.hunt(max_misses=1), "max_walls"),
        (lambda: tautline.replay(tmp_path / "nothing.jsonl"), "nothing.jsonl"),
        (lambda: tautline.explore("open:5x5", robots=3).minimise(), "break"),
        (lambda: tautline.estimate_share(3, 2), "no more hits"),
        (lambda: tautline.estimate([]), "at least one"),
        (lambda: tautline.estimate_ratio([(1, -1)]), "the second values of 1 pairs sum up to -1; "),
        (lambda: tautline.estimate_ratio([(1, float("nan"))]), "sum up to more than 0"),
        (lambda: tautline.estimate([float("nan")]), "not finite"),
        (lambda: tautline.estimate([1e308, 1e308]), "not finite"),
        (lambda: tautline.explore("open:5x5", message_range=0), "message_range says nothing"),
        (lambda: tautline.explore("open:5x5", "kit", message_range=0), "give message_range 2 to 5"),
        (lambda: tautline.hunt("kit", error=0.5), "max_walls, message_range"),
        (lambda: tautline.replay(tmp_path / "nothing.jsonl"), "name a file that Run.store or"),
        (lambda: tautline.Run.parse("{}"), "Run.store"),
        (lambda: tautline.explore("open:5x5", robots=3).minimise(), "take a run of hunt, or one that has violations"),
    ]
    for call, said in cases:
        with pytest.raises(InputError) as refused:
            call()
        assert said in str(refused.value), refused.value


def test_a_file_of_others_is_not_overwritten(tmp_path):
    file = tmp_path / "mine.txt"
    file.write_text("mine")
    run = tautline.explore("open:3x3", robots=2)
    with pytest.raises(InputError, match="force"):
        run.store(file)
    assert file.read_text() == "mine"
    run.store(file, force=True)
    assert file.read_text() == run.trace()
