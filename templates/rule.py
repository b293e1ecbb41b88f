"""A rule to begin with. Copy this file, and change the rule and what it promises; `python rule.py` decides it.

Two robots go east, one behind the other. The second one waits while the first one is in the cell before it.
"""

import sys

import pytautline as tautline
from pytautline import Moved


class East(tautline.Rule):
    scheme = "east"
    name = "ours"
    robots = 2
    size = (4, 2)  # all layouts of 4x2 cells
    max_walls = 2  # in which a run meets at most two walls
    longest_run = 100  # a round is noticed some 32 moves later

    def __init__(self, looks: bool = True) -> None:
        self.looks = looks  # what can be wrong is a field, so that a mutant is another value

    def start(self):
        return None, [(1, 0), (0, 0)]

    def step(self, state, cells, blocked):
        if blocked[0]:
            return None
        (x, y), behind = cells
        is_near = self.looks and behind == (x - 1, y)
        return state, "E." if is_near else "EE"

    @staticmethod
    def apart(moved: Moved) -> bool:
        return moved.cells[0] != moved.cells[1]

    demands = [
        tautline.always("EAST-1", "the robots are in different cells", apart),
        tautline.never_endless("EAST-2", "every run ends"),
    ]
    covers = [("a step", lambda moved: moved.cells_before[0] != moved.cells[0])]


def main() -> int:
    ours, mutant = tautline.hunt_rule(East()), tautline.hunt_rule(East(looks=False))
    print(f"ours: {ours.verdict}, {ours.runs} runs; does not look: {mutant.verdict}")
    return 0 if (ours.verdict, mutant.verdict) == ("holds", "refuted") else 1


if __name__ == "__main__":
    sys.exit(main())
