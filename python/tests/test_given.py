"""What is given: numbers and lists that are out of bounds, and copies."""

import _thread
import copy
import pickle
import signal
import threading
import time

import numpy as np
import pytest

import pytautline as tautline
from followers import Followers
from pytautline import InputError
from pytautline.vector import VectorEnv

ERRORS = [getattr(tautline, name) for name in tautline.__all__ if name == "Error" or "Error" in name or "Rule" in name]
RUN = tautline.explore("open:3x3", robots=2)
MANY = range(10**12)


def copies(of):
    return [copy.copy(of), copy.deepcopy(of), pickle.loads(pickle.dumps(of))]


@pytest.mark.parametrize("kind", [kind for kind in ERRORS if issubclass(kind, tautline.Error)])
def test_errors_travel(kind):
    for error in copies(kind("it is wrong", "put it right")):
        assert type(error) is kind and str(error) == "it is wrong; put it right"
        assert (error.what, error.remedy) == ("it is wrong", "put it right")


def test_layouts_runs_and_estimates_travel():
    found = tautline.hunt(rule="published", robots=4, max_walls=2).counterexamples[0].run
    own = tautline.hunt_rule(Followers()).counterexamples[0].run
    for run in [tautline.explore("walls:6x6:0.2", seed=3, robots=3), found, own]:
        for again in copies(run):
            assert (again.trace(), again.json(), again.clause) == (run.trace(), run.json(), run.clause)
        for layout in copies(run.layout):
            assert layout == run.layout and repr(layout) == repr(run.layout)
    for estimate in [tautline.estimate([1, 2, 4]), tautline.estimate([1])]:
        for again in copies(estimate):
            assert (str(again), again.count, again.interval) == (str(estimate), estimate.count, estimate.interval)


@pytest.mark.parametrize(
    "call",
    [
        lambda: tautline.estimate(MANY),
        lambda: tautline.estimate(range(2**70)),
        lambda: tautline.estimate_ratio(MANY),
        lambda: tautline.explore("open:5x5", starts=MANY),
        lambda: tautline.sweep(["open:3x3"], seeds=MANY),
        lambda: tautline.sweep(["open:3x3"], seeds=range(2**62)),
        lambda: tautline.sweep(["open:3x3"] * 100, seeds=range(2**18)),
    ],
)
def test_lists_that_are_too_long_are_refused_before_they_are_read(call):
    with pytest.raises(InputError, match="more than 16777216 (entries|runs)"):
        call()


@pytest.mark.parametrize(
    ("call", "said"),
    [
        (lambda: tautline.explore("open:5x5", robots=-1), "robots is -1; give robots a whole number from 2 to "),
        (lambda: tautline.explore("open:5x5", max_moves=0), "max_moves is 0; give max_moves a whole number from 1"),
        (lambda: tautline.explore("open:5x5", max_moves=2**32), "max_moves is 4294967296"),
        (lambda: tautline.explore("open:5x5", max_moves=2**200), "max_moves is 1701"),
        (lambda: tautline.explore("open:5x5", until=-1), "until is -1; give until 50, 75 or 100"),
        (lambda: tautline.explore("open:5x5", base=(40000, 0)), r"\(40000, 0\) is no cell"),
        (lambda: tautline.explore("open:5x5", starts=[(0, -40000)]), r"\(0, -40000\) is no cell"),
        (lambda: tautline.explore("open:5x5", seed=-1), "seed is -1"),
        (lambda: tautline.explore("open:5x5", "ants", message_range=2**16), "message_range is 65536"),
        (lambda: tautline.in_contact((0, 0), (40000, 0)), "is no cell"),
        (lambda: tautline.hunt(max_misses=256), "max_misses is 256; give max_misses a whole number from 0 to 255"),
        (lambda: tautline.hunt(size=(-1, 3)), "size is -1"),
        (lambda: tautline.hunt(budget=-1), "budget is -1"),
        (lambda: tautline.hunt_rule(Followers(), budget=-1), "budget is -1"),
        (lambda: tautline.sweep(["open:3x3"], robots=[-1]), "robots is -1"),
        (lambda: tautline.sweep(["open:3x3"], seeds=[-1]), "a seed is -1"),
        (lambda: tautline.Layout.load("open:3x3", seed=2**64), "seed is 18446744073709551616"),
        (lambda: tautline.Layout.from_arrays(np.zeros((2, 2), bool), robots=0), "robots is 0; .* from 1 to 256"),
        (lambda: tautline.Layout.from_arrays(np.zeros((2, 2), bool), base=(2**15, 0)), "is no cell"),
        (lambda: tautline.estimate_share(-1, 5), "hits is -1"),
        (lambda: tautline.estimate([1, 2]).text(18), "decimals is 18; give decimals a whole number from 0 to 17"),
        (lambda: tautline.estimate([1, 2]).text(65536), "decimals is 65536"),
        (lambda: VectorEnv().layout(-1), "environment is -1; give environment a whole number from 0 to 0"),
        (lambda: RUN.svg((0, 2**32)), "moves are 0 to 4294967296 of a run of . team moves"),
        (lambda: RUN.svg((2, 1)), "moves are 2 to 1"),
        (lambda: RUN.svg((1000, 2000)), "moves are 1000 to 2000"),
    ],
)
def test_numbers_that_are_out_of_bounds_are_refused_by_name(call, said):
    with pytest.raises(InputError, match=said):
        call()


@pytest.mark.parametrize("call", [lambda: RUN.svg((1, 2.5)), lambda: tautline.explore("open:5x5", robots="two")])
def test_what_is_no_whole_number_is_a_wrong_type(call):
    with pytest.raises(TypeError):
        call()


@pytest.mark.parametrize(
    "call",
    [
        lambda: tautline.Layout.load("walls:1500x1500:0.1"),
        lambda: tautline.explore("cells:1500x1500:0.2", "ants", robots=1),
        lambda: tautline.sweep(["walls:1500x1500:0.1"], "ants", robots=[1]),
    ],
)
def test_ctrl_c_ends_the_wait_for_a_large_layout(call):
    # A shell that starts the tests in the background has them ignore it.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    threading.Timer(0.2, _thread.interrupt_main).start()
    begun = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        call()
    assert time.monotonic() - begun < 2
