import numpy as np
from pettingzoo.test import parallel_api_test, parallel_seed_test

from pytautline.pettingzoo import parallel_env


def test_the_api_of_parallel_environments():
    parallel_api_test(parallel_env(), num_cycles=500)


def test_the_same_seed_makes_the_same_500_steps():
    parallel_seed_test(parallel_env, num_cycles=500)


def test_rewards_are_cells_less_broken_contacts():
    env = parallel_env("open:5x5", robots=2)
    _, infos = env.reset(seed=1)
    assert infos == {"robot_1": {}, "robot_2": {}}
    observed, rewards, done, cut, infos = env.step({"robot_1": 0, "robot_2": 1})
    assert (rewards, infos["robot_1"]["in_contact"]) == ({"robot_1": 1.0, "robot_2": 1.0}, True)
    assert observed["robot_2"]["cells"].tolist() == [[2, 2], [3, 2]]
    assert not any(done.values()) and not any(cut.values())
    _, rewards, _, _, infos = env.step({"robot_1": 3, "robot_2": 1})
    assert (rewards["robot_1"], infos["robot_1"]["in_contact"]) == (1.0, False)
    assert np.asarray(observed["robot_1"]["explored"]).sum() == 2
