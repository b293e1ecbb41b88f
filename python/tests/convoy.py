"""The followers of the tutorial, however many: each robot goes to the cell of the one ahead, which leaves nobody behind."""

import pytautline as tautline


def steps(one, other):
    return abs(one[0] - other[0]) + abs(one[1] - other[1])


class Convoy(tautline.LocalRule):
    name = "convoy"
    in_a_row = True
    reach = 2
    far_is_fine = False

    def __init__(self, waits=True):
        self.waits = waits

    def admits(self, plans):
        ahead, behind = plans
        follows = behind.step == "." or behind.to == ahead.at
        return follows and (not self.waits or steps(ahead.to, behind.at) <= 2)

    def keeps(self, robots):
        return steps(robots[0].at, robots[1].at) <= 2

    def may_start(self, robots):
        return robots[0].at == robots[1].at

    def start(self, robots):
        return [((0, 0), None)] * robots
