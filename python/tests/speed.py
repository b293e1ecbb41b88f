"""Robot-steps a second of the single environment and of 1,024 in a vector, the best of five rounds in turn.

``taskset -c 0 python speed.py``, with a release build installed, measures one core.
"""

import time
from collections.abc import Callable, Iterator

import numpy as np

from pytautline.pettingzoo import parallel_env
from pytautline.vector import VectorEnv

LAYOUT, ROBOTS, MANY = "walls:8x8:0.1", 4, 1024
ACTIONS = np.random.default_rng(0).integers(0, 5, (500, MANY, ROBOTS))


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


one, many = map(max, zip(*[(a_second(single), a_second(vector)) for _ in range(5)], strict=True))
print(f"single: {one:,.0f}, vector: {many:,.0f} robot-steps a second, {many / one:.0f} times as many")
