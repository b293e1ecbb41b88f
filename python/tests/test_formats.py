import io
import json
from pathlib import Path

import itf_py
import numpy as np
import pytest
from mcap.reader import make_reader
from mcap_ros2.decoder import DecoderFactory

import pytautline as tautline

DOCS = Path(__file__).parents[2] / "docs"


@pytest.mark.parametrize("file", ["chain-2-published-n4.jsonl", "open-7x7.jsonl", "follow-1-written.jsonl"])
def test_an_itf_trace_reads_back_as_the_run(file):
    run = tautline.replay(DOCS / file)
    read = itf_py.trace_from_json(json.loads(run.itf()))
    first = json.loads(run.trace().splitlines()[0]).get("numbered_from", 1)
    assert set(read.vars) == {"blocked", "broken", "cells", "kind", "step", "tried"}
    states = [state.values for state in read.states]
    assert states[0]["kind"] == "start" and len(states) == run.steps + 1
    for state, move in zip(states[1:], run.moves(), strict=True):
        assert (state["step"], state["kind"], state["tried"]) == (move["step"], move["kind"], move["tried"])
        assert [list(cell) for cell in state["cells"]] == move["cells"]
        assert [robot for robot, blocked in enumerate(state["blocked"], first) if blocked] == move["blocked"]
    broken = [(clause, state["step"]) for state in states for clause in sorted(state["broken"])]
    assert broken == run.violations
    assert run.itf() == tautline.replay(DOCS / file).itf()


def recorded(run):
    """By topic: the messages of a recording, each with its seconds, as the readers of MCAP and of ROS 2 give them."""
    topics = {}
    reader = make_reader(io.BytesIO(run.mcap()), decoder_factories=[DecoderFactory()])
    for schema, channel, message, content in reader.iter_decoded_messages():
        assert (schema.encoding, channel.message_encoding) == ("ros2msg", "cdr")
        topics.setdefault(channel.topic, []).append((message.log_time / 1e9, content))
    return topics


def grid(message):
    return np.array(message.data, np.int8).reshape(message.info.height, message.info.width)


@pytest.mark.parametrize("file", ["chain-2-published-n4.jsonl", "open-7x7.jsonl", "bricks-4-repaired-n1.jsonl"])
def test_a_recording_reads_back_as_the_run(file):
    run = tautline.replay(DOCS / file)
    topics = recorded(run)
    moves = run.moves()
    for (seconds, read), move in zip(topics["/team_move"], moves, strict=True):
        assert seconds == read.step == read.header.stamp.sec == move["step"]
        assert (read.kind, read.tried) == (move["kind"], move["tried"])
        assert [[cell.column, cell.row] for cell in read.cells] == move["cells"]
        assert [robot for robot, blocked in enumerate(read.blocked, 1) if blocked] == move["blocked"]
    [(_, end)] = topics["/end"]
    assert (end.stopped, end.steps, end.explored, end.cells) == (run.stopped, run.steps, run.explored, run.cells)
    assert [(broken.clause, broken.step) for broken in end.violations] == run.violations
    # Robots stand in the middle of their cells, the maps are those of the layout and of what is explored of it.
    layout = grid(topics["/layout"][0][1])
    assert (layout[1::2, 1::2][::-1] == 100 * np.asarray(run.layout.blocked)).all()
    known = grid(topics["/map"][-1][1])
    assert ((known == layout) | (known == -1)).all()
    assert ((known[1::2, 1::2][::-1] == 0) == (np.asarray(run.order()) >= 0)).all()
    rows = (layout.shape[0] - 1) // 2
    places = [[[pose.position.x, pose.position.y] for pose in poses.poses] for _, poses in topics["/robots"]]
    cells = np.asarray(run.positions())
    assert np.array_equal(places, np.stack([cells[..., 0] + 0.5, rows - cells[..., 1] - 0.5], -1))
    # A robot that has just tried to go north looks north.
    for (_, poses), move in zip(topics["/robots"][1:], moves, strict=True):
        for pose, letter in zip(poses.poses, move["tried"], strict=True):
            turn = {"N": 0.5**0.5, "S": -(0.5**0.5), "W": 1.0}.get(letter, 0.0)
            assert pose.orientation.z == turn
    assert all(len(links.points) == len(links.colors) for _, links in topics.get("/links", []))
    assert run.mcap() == tautline.replay(DOCS / file).mcap()


def test_the_updates_of_a_large_map_lead_to_what_is_explored():
    run = tautline.explore("cells:48x48:0.1", "bricks", seed=2, robots=4, max_moves=400)
    topics = recorded(run)
    known = grid(topics["/map"][0][1]).copy()
    assert len(topics["/map_updates"]) > 500
    for _, update in topics["/map_updates"]:
        values = np.array(update.data, np.int8).reshape(update.height, update.width)
        known[update.y : update.y + update.height, update.x : update.x + update.width] = values
    assert ((known[1::2, 1::2][::-1] == 0) == (np.asarray(run.order()) >= 0)).all()
    assert len(run.mcap()) < 60 * len(run.trace())
