"""A rule written in Python: the class to derive from, and what is demanded of it."""

from collections.abc import Callable, Hashable, Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from inspect import getattr_static
from typing import Any, Literal, TypeAlias

from ._native import Moved

Cell: TypeAlias = tuple[int, int]
"""A column and a row."""


@dataclass(frozen=True)
class Demand:
    """What is demanded, when it is looked at, and by what. Made by ``always`` and its like."""

    id: str
    words: str
    when: Literal["always", "at-the-end", "never-endless", "eventually", "again-and-again"]
    kept: Callable[..., Any] | None


def always(id: str, words: str, kept: Callable[[Moved], bool] | Callable[[Any, Any], bool]) -> Demand:
    """``kept`` is to be so of every team move; of a rule over states, of the states before and after every move."""
    return Demand(id, words, "always", kept)


def at_the_end(
    id: str, words: str, kept: Callable[[Any, Sequence[Cell]], bool] | Callable[[Any], bool]
) -> Demand:
    """``kept`` is to be so of the state and the cells at the end of every run that ends; of a rule over states, of the state."""
    return Demand(id, words, "at-the-end", kept)


def never_endless(id: str, words: str) -> Demand:
    """No run is to come back to where it was. Where this is not demanded, a run that does is over."""
    return Demand(id, words, "never-endless", None)


class Rule:
    """A rule for robots on cells, which :func:`pytautline.hunt_rule` searches in all layouts within its bound.

    A subclass says what it is about, and has two functions that depend on nothing but their arguments.
    """

    scheme: str = "own"
    """The name of what it is a rule of, in files and drawings: letters, digits and hyphens."""
    name: str = "written"
    """The name of the rule."""
    robots: int = 1
    """How many robots there are: at most 8."""
    size: tuple[int, int] = (4, 3)
    """Columns and rows of all layouts: at most 16."""
    max_walls: int = 3
    """Most walls that are met in one run; the border is not counted."""
    longest_run: int = 1000
    """Team moves after which a run is given up, which leaves the question open."""
    demands: Sequence[Demand] = ()
    """What is demanded."""
    covers: Sequence[tuple[str, Callable[[Moved], bool]]] = ()
    """The situations that must occur: where one does not, the question is open."""

    def start(self) -> tuple[Hashable, Sequence[Cell]]:
        """The state before the first team move, and where the robots start.

        The state is all that the team knows: a value that can be hashed and compared, such as a tuple or a frozen dataclass.
        """
        raise NotImplementedError("a rule has a start")

    def step(self, state: Any, cells: Sequence[Cell], blocked: Sequence[bool]) -> tuple[Hashable, str | None] | None:
        """The next state, and one letter for each robot of what it tries next; None when the run is over.

        A rule that learns something from the last team move returns its state and None at its end.

        ``state`` is what the last call returned, ``cells`` are where the robots are now, and ``blocked`` tells which of them have
        met a wall in the last team move.
        """
        raise NotImplementedError("a rule has a step")


def misspelt(rule: object, of: type) -> tuple[str, str] | None:
    """An attribute of the rule that its class does not have, and the one of the class that it may be meant for.

    Only those are meant that the rule leaves as they are: beside a ``step`` of its own it may have ``steps``.
    """
    left = [name for name, value in vars(of).items() if name[0] != "_" and getattr_static(rule, name, None) is value]
    for name in sorted({name for name in dir(rule) if name[0] != "_"} - set(dir(of))):
        for meant in get_close_matches(name, left, n=1, cutoff=0.8):
            return name, meant
    return None
