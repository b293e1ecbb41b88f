"""The tutorial's rule in Python: two robots, of which the second goes where the first was. As written, it is wrong."""

from dataclasses import dataclass, replace

import pytautline as tautline
from pytautline import Cell, Moved

SIDES = {"E": (1, 0), "S": (0, 1), "W": (-1, 0), "N": (0, -1)}


@dataclass(frozen=True)
class Pair:
    """What the two know."""

    left: Cell = (0, 0)
    heading: str = "E"
    walls: int = 0
    last: tuple[Cell, ...] = ()


class Followers(tautline.Rule):
    scheme = "followers"
    name = "written"
    robots = 2
    size = (4, 3)
    max_walls = 3
    longest_run = 100

    def __init__(self, leader: Cell = (1, 0)) -> None:
        self.leader = leader

    def start(self):
        return Pair(), [self.leader, (0, 0)]

    def step(self, state, cells, blocked):
        if blocked[0]:
            heading = "ESWN"["ESWN".index(state.heading) - 3]
            state = replace(state, heading=heading, walls=(state.walls + 1) % 4)
        elif state.last:
            state = replace(state, left=state.last[0])
        if state.walls >= 3:
            return None
        apart = (state.left[0] - cells[1][0], state.left[1] - cells[1][1])
        follows = next((letter for letter, side in SIDES.items() if side == apart), ".")
        return replace(state, last=cells), state.heading + follows

    @staticmethod
    def near(moved: Moved) -> bool:
        (x, y), (other_x, other_y) = moved.cells
        return abs(x - other_x) + abs(y - other_y) <= 2

    @staticmethod
    def alone(moved: Moved) -> bool:
        return moved.cells_before[1] == moved.cells[1] or moved.cells[0] != moved.cells[1]

    demands = [
        tautline.always("FOLLOW-1", "the robots are at most two steps apart", near),
        tautline.always("FOLLOW-2", "the follower enters no occupied cell", alone),
        tautline.never_endless("FOLLOW-3", "no run comes back to where it was"),
    ]
    covers = [
        ("a step", lambda moved: moved.cells_before[1] != moved.cells[1]),
        ("a wall", lambda moved: moved.cells_before[0] == moved.cells[0]),
    ]
