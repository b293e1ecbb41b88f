"""Steps a second on one core, from an installed release build: ``python speed.py``. The best of five rounds, the kinds in turn.

``reference`` is the rule written in Python, ``single`` the PettingZoo environment, ``vector`` 1,024 of them; four robots each.
"""

import time
from collections.abc import Callable, Iterator

import numpy as np
from test_vector import Reference

from pytautline.pettingzoo import parallel_env
from pytautline.vector import VectorEnv

LAYOUT, ROBOTS, MANY = "walls:8x8:0.1", 4, 1024
ACTIONS = np.random.default_rng(0).integers(0, 5, (500, MANY, ROBOTS))


def reference() -> Iterator[int]:
    env = Reference(LAYOUT, ROBOTS, 200, 0)
    is_over = True
    for action in ACTIONS.reshape(-1, ROBOTS)[:5000].tolist():
        if is_over:
            env.reset()
        _, _, done, cut, _ = env.step(action)
        is_over = done or cut
        yield ROBOTS


def single() -> Iterator[int]:
    env = parallel_env(LAYOUT, ROBOTS)
    for action in ACTIONS.reshape(-1, ROBOTS)[:20000].tolist():
        if not env.agents:
            env.reset()
        env.step(dict(zip(env.agents, action, strict=True)))
        yield ROBOTS


def vector() -> Iterator[int]:
    env = VectorEnv(LAYOUT, MANY, ROBOTS)
    env.reset(seed=0)
    for actions in ACTIONS:
        env.step(actions)
        yield MANY * ROBOTS


def a_second(steps: Callable[[], Iterator[int]]) -> float:
    begun = time.perf_counter()
    return sum(steps()) / (time.perf_counter() - begun)


rounds = [[a_second(kind) for kind in (reference, single, vector)] for _ in range(5)]
for kind, best in zip(("reference", "single", "vector"), map(max, zip(*rounds, strict=True)), strict=True):
    print(f"{kind}: {best:,.0f} robot-steps a second")
