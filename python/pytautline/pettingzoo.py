"""An exploration as a PettingZoo parallel environment: robots on cells that must stay in contact.

Needs ``pettingzoo`` and ``numpy``. The robots move at once; one that meets a wall stays. All get the same reward: the number of
cells that were entered for the first time, less one for each pair of neighbours in the chain that is out of contact (CHAIN-1). An
episode ends when every cell in reach is explored, and is cut short after ``max_cycles``.
"""

import operator
from typing import Any

import numpy as np
from gymnasium import spaces
from gymnasium.utils import seeding
from numpy.typing import NDArray
from pettingzoo import ParallelEnv

from ._errors import InputError
from ._native import Environments
from .vector import ACTIONS, SEEDS, Observation, integers, observed, team_space


class parallel_env(ParallelEnv[str, Observation, int]):
    """Robots that explore a layout; where it is left to chance, each episode has one of its own.

    An observation is ``walls``, whether the robot's four sides E, S, W and N are shut, ``cells``, where the robots are, and
    ``explored``, which cells were entered.
    """

    metadata = {"name": "tautline_v0", "render_modes": ["ansi"], "is_parallelizable": True}

    def __init__(
        self,
        layout: str = "walls:8x8:0.1",
        robots: int = 4,
        max_cycles: int = 200,
        render_mode: str | None = None,
    ) -> None:
        if render_mode not in (None, "ansi"):
            raise InputError(f"render_mode is {render_mode!r}", 'give render_mode None or "ansi"')
        self._team = Environments(layout, 1, robots, max_cycles)
        self.render_mode = render_mode
        self.possible_agents = [f"robot_{number}" for number in range(1, robots + 1)]
        self.agents: list[str] = []
        self.layout = self._team.layout(0)
        space = team_space(self.layout, robots, (4,))
        self._spaces = {agent: spaces.Discrete(ACTIONS) for agent in self.possible_agents}
        self._observations = {agent: space for agent in self.possible_agents}
        self._random, _ = seeding.np_random(0)
        self._seen: Observation = {}

    def observation_space(self, agent: str) -> spaces.Dict:
        return self._observations[agent]

    def action_space(self, agent: str) -> spaces.Discrete[Any]:
        return self._spaces[agent]

    def reset(
        self, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[dict[str, Observation], dict[str, dict[str, Any]]]:
        if seed is not None:
            self._random, _ = seeding.np_random(operator.index(seed))
        self._seen = observed(self._team.reset({0: int(self._random.integers(SEEDS))}))
        self.layout = self._team.layout(0)
        self.agents = list(self.possible_agents)
        return self._observed(), {agent: {} for agent in self.agents}

    def step(
        self, actions: dict[str, int]
    ) -> tuple[
        dict[str, Observation],
        dict[str, float],
        dict[str, bool],
        dict[str, bool],
        dict[str, dict[str, Any]],
    ]:
        if self._seen and not self.agents:
            return {}, {}, {}, {}, {}
        agents = self.agents
        # NumPy makes reals of integers that are signed and integers that are not.
        own = (actions[agent] for agent in agents)
        tried = integers([[int(action) if isinstance(action, np.integer) else action for action in own]])
        planes, ((reward,), (is_done,), (is_cut,), (explored,), (contact,)) = self._team.step(tried, {})
        self._seen = observed(planes)
        result = (
            self._observed(),
            {agent: reward for agent in agents},
            {agent: is_done for agent in agents},
            {agent: is_cut for agent in agents},
            {agent: {"in_contact": contact, "explored": explored} for agent in agents},
        )
        if is_done or is_cut:
            self.agents = []
        return result

    def render(self) -> str:
        """The layout, drawn as text."""
        return str(self.layout)

    def state(self) -> NDArray[np.int16]:
        """Where the robots are, and what is explored, in one row."""
        return np.concatenate([self._seen["cells"].ravel(), self._seen["explored"].ravel()])

    def _observed(self) -> dict[str, Observation]:
        walls, (cells,), (explored,) = self._seen["walls"][0], self._seen["cells"], self._seen["explored"]
        return {
            agent: {"walls": own, "cells": cells.copy(), "explored": explored.copy()}
            for agent, own in zip(self.agents, walls, strict=True)
        }
