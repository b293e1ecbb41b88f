import hashlib
from collections.abc import Iterator
from typing import Any

import gymnasium
import numpy as np
import pytest
from gymnasium.utils import seeding
from gymnasium.vector import AutoresetMode, SyncVectorEnv

from pytautline import InputError, Layout, in_contact
from pytautline.pettingzoo import parallel_env
from pytautline.vector import VectorEnv

LAYOUTS = ["walls:8x8:0.1", "cells:9x6:0.3", "office:12x9:3x2", "rooms-b", "open:1x1", "open:4x3"]


class Reference:
    """The rule of the environment, written again in Python: a robot at a time, a cell at a time."""

    def __init__(self, layout: str, robots: int, max_cycles: int, seed: int) -> None:
        self.description, self.robots, self.max_cycles = layout, robots, max_cycles
        self.random, _ = seeding.np_random(seed)

    def reset(self) -> list[Any]:
        self.layout = Layout.load(self.description, seed=int(self.random.integers(2**32)))
        width, height = self.layout.width, self.layout.height
        free = [(x, y) for y, row in enumerate(self.layout.blocked.tolist()) for x in range(width) if not row[x]]
        off = [abs(x - (width - 1) / 2) + abs(y - (height - 1) / 2) for x, y in free]
        base = self.layout.base or free[off.index(min(off))]
        self.cells, self.entered, self.cycles = [base] * self.robots, {base}, 0
        self.reached, left = {base}, [base]
        while left:
            beyond = {self.layout.beyond(left[-1], side) for side in "ESWN"} - self.reached - {None}
            left[-1:] = beyond
            self.reached |= beyond
        return self.observed()

    def step(self, actions: list[int]) -> tuple[Any, ...]:
        before = len(self.entered)
        for number, action in enumerate(actions):
            if action:
                self.cells[number] = self.layout.beyond(self.cells[number], ".ESWN"[action]) or self.cells[number]
        self.entered |= set(self.cells)
        self.cycles += 1
        contact = [in_contact(one, other) for one, other in zip(self.cells, self.cells[1:], strict=False)]
        reward = float(len(self.entered) - before - contact.count(False))
        done, cut = self.entered == self.reached, self.cycles >= self.max_cycles
        return self.observed(), reward, done, cut, {"in_contact": all(contact), "explored": len(self.entered)}

    def observed(self) -> list[Any]:
        shut = [[self.layout.beyond(cell, side) is None for side in "ESWN"] for cell in self.cells]
        explored = np.zeros((self.layout.height, self.layout.width), np.int16)
        for x, y in self.entered:
            explored[y, x] = 1
        return [np.array(shut, np.int16), np.array(self.cells, np.int16), explored]


class Team(gymnasium.Env):
    """The single environment, with one action and one observation of the whole team, as Gymnasium has them."""

    def __init__(self, like: VectorEnv, layout: str, robots: int, max_cycles: int) -> None:
        self.env = parallel_env(layout, robots, max_cycles)
        self.observation_space, self.action_space = like.single_observation_space, like.single_action_space

    def reset(self, *, seed=None, options=None):
        observations, _ = self.env.reset(seed, options)
        return self.team(observations), {}

    def step(self, action):
        observations, *outcome = self.env.step(dict(zip(self.env.agents, action, strict=True)))
        return self.team(observations), *(of["robot_1"] for of in outcome)

    @staticmethod
    def team(observations):
        first = observations["robot_1"]
        return first | {"walls": np.stack([own["walls"] for own in observations.values()])}


def actions_of(seed: int, shape: tuple[int, ...]) -> Iterator[np.ndarray]:
    random = np.random.default_rng(seed)
    while True:
        yield random.integers(0, 5, shape)


def assert_same(one: np.ndarray, other: np.ndarray) -> None:
    assert (one.dtype, one.shape, one.tobytes()) == (other.dtype, other.shape, other.tobytes())


@pytest.mark.parametrize("layout", LAYOUTS)
@pytest.mark.parametrize("robots", [1, 4])
def test_the_single_environment_is_bit_for_bit_the_rule_written_again_in_python(layout, robots):
    for seed in range(3):
        env, reference = parallel_env(layout, robots, max_cycles=40), Reference(layout, robots, 40, seed)
        actions = actions_of(seed, (robots,))
        for episode in range(3):
            observations, infos = env.reset(seed=seed if episode == 0 else None)
            expected = reference.reset()
            while True:
                for number, own in enumerate(observations.values()):
                    for got, plane in zip(own.values(), [expected[0][number], *expected[1:]], strict=True):
                        assert_same(got, plane)
                assert_same(env.state(), np.concatenate([plane.ravel() for plane in expected[1:]]))
                if not env.agents:
                    break
                action = next(actions).tolist()
                expected, *outcome = reference.step(action)
                observations, *of = env.step(dict(zip(env.agents, action, strict=True)))
                assert of == [dict.fromkeys(observations, value) for value in outcome]
                assert [type(each["robot_1"]) for each in of] == [float, bool, bool, dict]
            assert env.step({}) == ({}, {}, {}, {}, {})


@pytest.mark.parametrize("layout", LAYOUTS)
def test_every_environment_of_a_vector_is_bit_for_bit_the_single_one_under_gymnasiums_own_vector(layout):
    vector = VectorEnv(layout, num_envs=5, robots=3, max_cycles=25)
    singles = SyncVectorEnv(
        [lambda: Team(vector, layout, 3, 25)] * 5, autoreset_mode=AutoresetMode.NEXT_STEP
    )
    for seed in (7, None, [3, None, 1, 4, 1]):
        (observed, infos), (expected, own_infos) = vector.reset(seed=seed), singles.reset(seed=seed)
        resets = 0
        for actions, _ in zip(actions_of(1, (5, 3)), range(120), strict=False):
            for name, value in expected.items():
                assert_same(observed[name], value)
            # Where no environment has anything to say, Gymnasium's vector says nothing, not even that.
            assert infos.keys() == own_infos.keys() or not (own_infos or infos["_explored"].any())
            for name, value in own_infos.items():
                assert_same(infos[name], value)
            assert vector.observation_space.contains(observed)
            observed, *outcome, infos = vector.step(actions)
            expected, *own, own_infos = singles.step(actions)
            for got, value in zip(outcome, own, strict=True):
                assert_same(got, value)
            resets += (~infos["_explored"]).sum()
        assert resets >= 20


def test_observations_are_handed_over_without_a_copy_and_stay_as_they_were():
    vector = VectorEnv("open:5x5", num_envs=2, robots=2)
    first, _ = vector.reset(seed=0)
    before = first["cells"].copy()
    assert np.shares_memory(np.from_dlpack(first["cells"]), first["cells"]) and first["cells"].flags.writeable
    second = vector.step(np.full((2, 2), 1, np.uint8))[0]
    assert (first["cells"] == before).all() and (second["cells"][..., 0] == 3).all()


def test_the_same_seed_makes_the_same_bytes_on_every_machine():
    vector, digest = VectorEnv("walls:9x7:0.2", num_envs=6, robots=3, max_cycles=30), hashlib.sha256()
    vector.reset(seed=4)
    for step in range(100):
        observed, rewards, *_ = vector.step(np.arange(18).reshape(6, 3) * (step + 1) // 7 % 5)
        for plane in observed.values():
            digest.update(plane.astype("<i2").tobytes())
        digest.update(rewards.astype("<f8").tobytes())
    assert digest.hexdigest()[:16] == "990fce45e34c00cf"


def test_a_refused_step_changes_nothing():
    def episode(refused: bool) -> list[bytes]:
        vector = VectorEnv(num_envs=3, robots=2, max_cycles=2)
        vector.reset(seed=5)
        planes = []
        for _ in range(7):
            if refused:
                with pytest.raises(InputError):
                    vector.step(np.full((3, 2), 5))
            planes.append(vector.step(np.ones((3, 2), int))[0]["walls"].tobytes())
        return planes

    assert episode(refused=True) == episode(refused=False)


@pytest.mark.parametrize(
    ("actions", "said"),
    [
        (np.zeros((4, 3), int), r"shape \[4, 3\].*3 environments by 4 robots"),
        (np.zeros(12, int), r"shape \[12\]"),
        (np.zeros((3, 4)), "are float64.*integers from 0 to 4"),
        (np.zeros((3, 4), bool), "are bool"),
        (None, "are object"),
        ([[0] * 4, [0, 0, 5, 0], [0] * 4], r"actions\[1, 2\] is 5"),
        ([[0] * 4, [0] * 4, [-1, 0, 0, 0]], r"actions\[2, 0\] is -1"),
        (np.full((3, 4), 2**63, np.uint64), r"actions\[0, 0\] is 9223372036854775808"),
    ],
)
def test_actions_that_are_none_are_refused_with_their_place(actions, said):
    vector = VectorEnv(num_envs=3)
    vector.reset(seed=0)
    with pytest.raises(InputError, match=said):
        vector.step(actions)


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        ({"num_envs": 0}, "num_envs is 0"),
        ({"robots": 0}, "robots is 0"),
        ({"robots": -1}, "robots is -1"),
        ({"max_cycles": 0}, "max_cycles is 0"),
        ({"num_envs": 10**7}, "10000000 environments of 8x8 cells.*at most 223696 of them"),
        ({"robots": 2**62}, "1 environment of 8x8 cells.*fewer robots, or a smaller layout"),
        ({"robots": 2**64}, "robots is 18446744073709551616"),
        ({"layout": "walls:8x8"}, "walls"),
    ],
)
def test_environments_that_cannot_be_are_refused(wrong, said):
    with pytest.raises(InputError, match=said):
        VectorEnv(**wrong)


def test_a_step_needs_a_reset_before_it():
    with pytest.raises(InputError, match="environment 0 is over, or has not begun; call reset"):
        VectorEnv().step([[0] * 4])
    with pytest.raises(InputError, match="call reset"):
        parallel_env().step({})
    ended = parallel_env("open:4x4", max_cycles=1)
    ended.reset()
    ended.step(dict.fromkeys(ended.agents, 0))
    ended.agents = ended.possible_agents
    with pytest.raises(InputError, match="environment 0 is over"):
        ended.step(dict.fromkeys(ended.agents, 0))
    with pytest.raises(InputError, match="there are 2 seeds"):
        VectorEnv(num_envs=3).reset(seed=[1, 2])
    with pytest.raises(InputError, match="reset_mask"):
        VectorEnv().reset(options={"reset_mask": np.ones(1, bool)})


def test_a_refused_reset_changes_nothing_and_seeds_are_whole_numbers_of_any_kind():
    def planes(refused: Any, *seeds: Any) -> list[bytes]:
        vector = VectorEnv("walls:6x6:0.2", num_envs=3, robots=2)
        vector.reset(seed=1)
        if refused is not None:
            with pytest.raises((gymnasium.error.Error, InputError, TypeError)):
                vector.reset(seed=refused)
        return [vector.reset(seed=seed)[0]["walls"].tobytes() for seed in seeds]

    for refused in ([7, 8, -1], [], [1, 2], 1.5, [1, 2.5, 3]):
        assert planes(refused, None) == planes(None, None)
    of_numpy = planes(None, np.int64(3), np.array([1, 2, 3]), [1, np.uint8(2), None])
    assert of_numpy == planes(None, 3, [1, 2, 3], [1, 2, None])
    one, other = parallel_env(), parallel_env()
    assert_same(one.reset(np.int64(3))[0]["robot_1"]["walls"], other.reset(3)[0]["robot_1"]["walls"])


def test_whoever_steps_environments_that_another_one_steps_is_told_so():
    vector = VectorEnv()
    vector.reset()

    class Meddler:
        @property
        def dtype(self):
            with pytest.raises(InputError, match="one thread at a time"):
                vector.layout(0)
            return "meddled with"

    with pytest.raises(InputError, match="are meddled with"):
        vector._teams.step(Meddler(), {})


def test_actions_of_the_single_environment_are_integers_of_any_kind():
    env = parallel_env(robots=2)
    env.reset()
    env.step({"robot_1": np.int8(1), "robot_2": np.uint64(2)})
    with pytest.raises(InputError, match="are float64"):
        env.step({"robot_1": 0.5, "robot_2": 1})
    with pytest.raises(InputError, match="render_mode is 'nope'"):
        parallel_env(render_mode="nope")
