import json
from pathlib import Path

import itf_py
import pytest

import tautline

DOCS = Path(__file__).parents[2] / "docs"


@pytest.mark.parametrize("file", ["chain-2-published-n4.jsonl", "open-7x7.jsonl", "follow-1-written.jsonl"])
def test_an_itf_trace_reads_back_as_the_run(file):
    run = tautline.replay(DOCS / file)
    read = itf_py.trace_from_json(json.loads(run.itf()))
    assert set(read.vars) == {"blocked", "broken", "cells", "kind", "step", "tried"}
    states = [state.values for state in read.states]
    assert states[0]["kind"] == "start" and len(states) == run.steps + 1
    for state, move in zip(states[1:], run.moves(), strict=True):
        assert (state["step"], state["kind"], state["tried"]) == (move["step"], move["kind"], move["tried"])
        assert [list(cell) for cell in state["cells"]] == move["cells"]
        assert [robot for robot, blocked in enumerate(state["blocked"], 1) if blocked] == move["blocked"]
    broken = [(clause, state["step"]) for state in states for clause in sorted(state["broken"])]
    assert broken == run.violations
    assert run.itf() == tautline.replay(DOCS / file).itf()
