"""A local rule in Python: the class to derive from, which is decided for every number of robots and every layout."""

from collections.abc import Hashable, Sequence
from typing import Any, NamedTuple

from ._rule import Cell


class LocalRobot(NamedTuple):
    """A robot as others see it."""

    at: Cell
    """Its cell. Only where robots are from each other may play a part, since the rule is the same everywhere."""
    state: Any
    """Its state."""


class LocalPlan(NamedTuple):
    """A robot and what it plans."""

    at: Cell
    """Its cell."""
    state: Any
    """Its state."""
    step: str
    """The letter of its step."""
    to: Cell
    """The cell to which the step leads."""


class LocalRule:
    """A rule that is local and the same everywhere, which :func:`pytautline.decide_every_number` decides.

    A subclass says what one robot can do, what ``robots`` robots may plan at once, and what is promised of them. Its functions
    depend on nothing but their arguments.
    """

    name: str = "written"
    """The name of the rule."""
    robots: int = 2
    """Of how many robots at once the rule speaks: 2 or 3."""
    in_a_row: bool = False
    """Whether it speaks of each robot and those after it alone, as in a chain, and not of all."""
    states: Sequence[Hashable] = (None,)
    """Every state that a robot may be in."""
    reach: int = 1
    """How many columns and rows the promise looks."""
    far_is_fine: bool = True
    """Whether robots that are farther apart keep the promise."""
    may_fail: bool = False
    """Whether a robot may be kept from going though no wall stands in its way."""
    meets_walls: bool = True
    """Whether a robot that goes may meet a wall: then whoever goes may stay. Without, its planner knows the layout."""

    def acts(self, state: Any) -> Sequence[tuple[str, Sequence[tuple[bool, Hashable]]]]:
        """Whatever a robot in this state can do: a letter of E, S, W, N or ``.``, and all that may come of it.

        What may come of an act is whether the robot goes, and its next state. As it stands, a robot goes to any side, unless a wall
        stops it, or stays, and its state remains.
        """
        return [(letter, [(True, state), (False, state)]) for letter in "ESWN"] + [(".", [(False, state)])]

    def admits(self, plans: Sequence[LocalPlan]) -> bool:
        """Whether robots may plan this at once."""
        raise NotImplementedError("a local rule admits plans")

    def keeps(self, robots: Sequence[LocalRobot]) -> bool:
        """The promise, of robots that are within ``reach``."""
        raise NotImplementedError("a local rule keeps a promise")

    def may_start(self, robots: Sequence[LocalRobot]) -> bool:
        """Whether robots may start so: as they do in :meth:`start`, the first of them in cell (0, 0)."""
        raise NotImplementedError("a local rule says how robots may start")

    def start(self, robots: int) -> Sequence[tuple[Cell, Any]]:
        """The cells and states in which a team of so many robots starts."""
        raise NotImplementedError("a local rule has a start")
