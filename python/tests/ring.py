"""Dijkstra's ring of K-state machines (Communications of the ACM 17, 1974): from any states, one privilege goes round in the end."""

from itertools import product

import pytautline as tautline
from pytautline import Move


class Ring(tautline.Protocol):
    name = "published"

    def __init__(self, machines: int, states: int) -> None:
        self.machines, self.states = machines, states
        self.bound = f"{machines} machines of {states} states, all starts, one at a time in any order"
        one_stays = lambda before, after: len(self.privileged(before)) != 1 or len(self.privileged(after)) == 1
        self.demands = [
            tautline.always("KSTATE-1", "one privilege stays one", one_stays),
            tautline.eventually("KSTATE-2", "there is one privilege", lambda ring: len(self.privileged(ring)) == 1),
        ]

    def privileged(self, ring):
        """Machine 0 has the privilege if it equals its left neighbour, another one if it differs."""
        return [machine for machine in range(self.machines) if (ring[machine] == ring[machine - 1]) == (machine == 0)]

    def starts(self):
        return product(range(self.states), repeat=self.machines)

    def moves(self, ring):
        """All machines are one actor: nobody need be fair to them."""
        for machine in self.privileged(ring):
            copied = (ring[machine - 1] + (machine == 0)) % self.states
            yield Move.of(0, "acts", (*ring[:machine], copied, *ring[machine + 1 :]), by=machine)

    def draw(self, ring):
        marks = ("*" if machine in self.privileged(ring) else " " for machine in range(self.machines))
        return "".join(f"{state}{mark}" for state, mark in zip(ring, marks))


if __name__ == "__main__":
    for states in (5, 3):
        found = tautline.decide_protocol(Ring(5, states))["KSTATE-2"]
        print(states, found.verdict, found.states, found.counterexample or "")
