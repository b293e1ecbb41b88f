"""Many environments of :mod:`pytautline.pettingzoo` at once, as a Gymnasium vector environment.

Needs ``gymnasium`` and ``numpy``. Environment ``k`` is bit for bit the single one; all of them are stepped in one call, without
Python's lock. An observation owns its arrays: a later step does not change it, and ``__dlpack__`` hands it over without a copy.
"""

import operator
from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
from gymnasium import spaces
from gymnasium.utils import seeding
from gymnasium.vector import AutoresetMode, VectorEnv as GymnasiumVectorEnv
from gymnasium.vector.utils import batch_space
from numpy.typing import NDArray

from ._errors import InputError
from ._native import Environments, Layout

ACTIONS = 5
"""Stay, east, south, west, north."""

SEEDS = 2**32
"""Layouts that one description can make here."""

Observation = dict[str, NDArray[np.int16]]


def team_space(layout: Layout, robots: int, walls: tuple[int, ...]) -> spaces.Dict:
    """The observations of a team, with walls of this shape."""
    most = max(layout.height, layout.width)
    return spaces.Dict(
        {
            "walls": spaces.Box(0, 1, walls, np.int16),
            "cells": spaces.Box(0, most, (robots, 2), np.int16),
            "explored": spaces.Box(0, 1, (layout.height, layout.width), np.int16),
        }
    )


def observed(planes: Iterable[memoryview]) -> Observation:
    """The planes as arrays, which are not copied."""
    return dict(zip(("walls", "cells", "explored"), map(np.asarray, planes), strict=True))


def integers(actions: Any) -> NDArray[Any]:
    """Integers of any width as the native half takes them; what are none, it refuses."""
    array = np.asarray(actions)
    wide = {"i": np.int64, "u": np.uint64}.get(array.dtype.kind)
    return array if wide is None else array.astype(wide, copy=False)


class VectorEnv(GymnasiumVectorEnv[Observation, NDArray[np.int64], NDArray[Any]]):
    """Teams that explore a layout each; a reward is that of a whole team.

    A team whose episode has ended begins the next one at the next step, whatever its action (``AutoresetMode.NEXT_STEP``). Seed
    ``s`` seeds environment ``k`` by ``s + k``; before any seed is given, ``s`` is 0. One thread at a time may step or reset it.
    """

    metadata = {"name": "tautline_v0", "autoreset_mode": AutoresetMode.NEXT_STEP}

    def __init__(
        self, layout: str = "walls:8x8:0.1", num_envs: int = 1, robots: int = 4, max_cycles: int = 200
    ) -> None:
        self._teams = Environments(layout, num_envs, robots, max_cycles)
        self.num_envs = num_envs
        self.single_observation_space = team_space(self._teams.layout(0), robots, (robots, 4))
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self.single_action_space = spaces.MultiDiscrete([ACTIONS] * robots)
        self.action_space = batch_space(self.single_action_space, num_envs)
        self._randoms = [seeding.np_random(number)[0] for number in range(num_envs)]
        self._drawn: dict[int, int] = {}
        self._is_over = np.zeros(num_envs, np.bool_)

    def layout(self, number: int) -> Layout:
        """The layout of this environment's episode."""
        return self._teams.layout(number)

    def reset(
        self, *, seed: int | Sequence[int | None] | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Observation, dict[str, Any]]:
        """Begins an episode in every environment."""
        if options and "reset_mask" in options:
            raise InputError("reset_mask is for environments that do not reset themselves", "reset all of them")
        given: Any = seed
        if given is None:
            seeds: Sequence[int | None] = [None] * self.num_envs
        elif np.ndim(given):
            seeds = [None if own is None else operator.index(own) for own in given]
        else:
            seeds = range(operator.index(given), operator.index(given) + self.num_envs)
        if len(seeds) != self.num_envs:
            raise InputError(f"there are {len(seeds)} seeds", f"give one, or {self.num_envs}")
        # All are made before one is taken: a reset that is refused leaves the others as they were.
        pairs = zip(self._randoms, seeds, strict=True)
        randoms = [random if own is None else seeding.np_random(own)[0] for random, own in pairs]
        drawn = {number: int(random.integers(SEEDS)) for number, random in enumerate(randoms)}
        planes = self._teams.reset(drawn)
        self._randoms, self._drawn, self._is_over = randoms, {}, np.zeros(self.num_envs, np.bool_)
        return observed(planes), {}

    def step(
        self, actions: Any
    ) -> tuple[Observation, NDArray[Any], NDArray[Any], NDArray[Any], dict[str, Any]]:
        """Steps every environment by an array of integers, environments by robots."""
        fresh = self._draw(np.flatnonzero(self._is_over).tolist())
        planes, outcomes = self._teams.step(integers(actions), fresh)
        rewards, done, cut, explored, contact = map(np.asarray, outcomes)
        went = ~self._is_over
        self._drawn, self._is_over = {}, done | cut
        infos = {"in_contact": contact, "_in_contact": went, "explored": explored, "_explored": went.copy()}
        return observed(planes), rewards, done, cut, infos

    def _draw(self, numbers: Iterable[int]) -> dict[int, int]:
        """Seeds of the next layouts, drawn once, however often a step is refused."""
        for number in numbers:
            if number not in self._drawn:
                self._drawn[number] = int(self._randoms[number].integers(SEEDS))
        return self._drawn
