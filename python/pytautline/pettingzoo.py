"""An exploration as a PettingZoo parallel environment: robots on cells that must stay in contact.

Needs ``pettingzoo`` and ``numpy``. The robots move at once; one that meets a wall stays. All get the same reward: the number of
cells that were entered for the first time, less one for each pair of neighbours in the chain that is out of contact (CHAIN-1). An
episode ends when every cell in reach is explored, and is cut short after ``max_cycles``.
"""

from typing import Any

import numpy as np
from gymnasium import spaces
from gymnasium.utils import seeding
from numpy.typing import NDArray
from pettingzoo import ParallelEnv

from ._native import Layout, in_contact
from ._rule import Cell

LETTERS = ".ESWN"
"""What the actions 0 to 4 try."""

SEEDS = 2**32
"""Layouts that one description can make here."""


class parallel_env(ParallelEnv[str, dict[str, NDArray[np.int16]], int]):
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
        self.description = layout
        self.max_cycles = max_cycles
        self.render_mode = render_mode
        self.possible_agents = [f"robot_{number}" for number in range(1, robots + 1)]
        self.agents: list[str] = []
        first = Layout.load(layout)
        self._shape = (first.height, first.width)
        most = max(self._shape)
        self._space = spaces.Dict(
            {
                "walls": spaces.Box(0, 1, (4,), np.int16),
                "cells": spaces.Box(0, most, (robots, 2), np.int16),
                "explored": spaces.Box(0, 1, self._shape, np.int16),
            }
        )
        self._spaces = {agent: spaces.Discrete(len(LETTERS)) for agent in self.possible_agents}
        self._observations = {agent: self._space for agent in self.possible_agents}
        self._random, _ = seeding.np_random(0)
        self.layout = first

    def observation_space(self, agent: str) -> spaces.Dict:
        return self._observations[agent]

    def action_space(self, agent: str) -> spaces.Discrete[Any]:
        return self._spaces[agent]

    def reset(
        self, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[dict[str, dict[str, NDArray[np.int16]]], dict[str, dict[str, Any]]]:
        if seed is not None:
            self._random, _ = seeding.np_random(seed)
        self.layout = Layout.load(self.description, seed=int(self._random.integers(SEEDS)))
        self.agents = list(self.possible_agents)
        self._cells = [self._base()] * len(self.agents)
        self._explored = np.zeros(self._shape, np.int16)
        self._explored[self._cells[0][1], self._cells[0][0]] = 1
        self._due = self._reachable(self._cells[0])
        self._cycles = 0
        return self._observed(), {agent: {} for agent in self.agents}

    def step(
        self, actions: dict[str, int]
    ) -> tuple[
        dict[str, dict[str, NDArray[np.int16]]],
        dict[str, float],
        dict[str, bool],
        dict[str, bool],
        dict[str, dict[str, Any]],
    ]:
        before = int(self._explored.sum())
        for number, agent in enumerate(self.agents):
            letter = LETTERS[int(actions[agent])]
            if letter != ".":
                self._cells[number] = self.layout.beyond(self._cells[number], letter) or self._cells[number]
        for x, y in self._cells:
            self._explored[y, x] = 1
        self._cycles += 1
        contact = [in_contact(one, other) for one, other in zip(self._cells, self._cells[1:], strict=False)]
        explored = int(self._explored.sum())
        reward = float(explored - before - contact.count(False))
        is_done, is_cut = explored >= self._due, self._cycles >= self.max_cycles
        agents = self.agents
        result = (
            self._observed(),
            {agent: reward for agent in agents},
            {agent: is_done for agent in agents},
            {agent: is_cut for agent in agents},
            {agent: {"in_contact": all(contact), "explored": explored} for agent in agents},
        )
        if is_done or is_cut:
            self.agents = []
        return result

    def render(self) -> str:
        """The layout, drawn as text."""
        return str(self.layout)

    def state(self) -> NDArray[np.int16]:
        """Where the robots are, and what is explored, in one row."""
        return np.concatenate([np.asarray(self._cells, np.int16).ravel(), self._explored.ravel()])

    def _base(self) -> Cell:
        if self.layout.base is not None:
            return self.layout.base
        free = np.argwhere(~np.asarray(self.layout.blocked))
        centre = (np.asarray(self._shape) - 1) / 2
        y, x = free[np.abs(free - centre).sum(axis=1).argmin()]
        return int(x), int(y)

    def _reachable(self, base: Cell) -> int:
        reached, left = {base}, [base]
        while left:
            cell = left.pop()
            for letter in LETTERS[1:]:
                beyond = self.layout.beyond(cell, letter)
                if beyond is not None and beyond not in reached:
                    reached.add(beyond)
                    left.append(beyond)
        return len(reached)

    def _observed(self) -> dict[str, dict[str, NDArray[np.int16]]]:
        cells = np.asarray(self._cells, np.int16)
        observed = {}
        for number, agent in enumerate(self.agents):
            shut = [self.layout.beyond(self._cells[number], letter) is None for letter in LETTERS[1:]]
            observed[agent] = {
                "walls": np.asarray(shut, np.int16),
                "cells": cells.copy(),
                "explored": self._explored.copy(),
            }
        return observed
