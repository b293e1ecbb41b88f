"""A rule over states written in Python: the class to derive from, moves between states, and messages that may be lost."""

from bisect import insort
from collections.abc import Callable, Hashable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, NamedTuple

from ._rule import Cell, Demand

if TYPE_CHECKING:
    from typing_extensions import disjoint_base
else:
    disjoint_base = lambda moves: moves


class _Move(NamedTuple):
    actors: tuple[int, ...]
    """The actors, from 0 to 15. With none of them it is a fault, which no run is bound to meet."""
    words: str
    """The kind of move, in words."""
    to: Any
    """The state to which it leads."""


# A move has an attribute beside those of the tuple, so that it is still taken apart into three.
@disjoint_base
class Move(_Move):
    """A move to another state."""

    by: int | None = None
    """The number of whoever is said to make it, if that is another one than its actor; it may be any."""

    @classmethod
    def of(cls, actor: int, words: str, to: Hashable, by: int | None = None) -> "Move":
        """A move of one actor, or one that is said to be made ``by`` another one."""
        made = cls((actor,), words, to)
        if by is not None:
            made.by = by
        return made

    @classmethod
    def of_all(cls, actors: int, words: str, to: Hashable) -> "Move":
        """A move of so many actors at once."""
        return cls(tuple(range(actors)), words, to)

    @classmethod
    def fault(cls, words: str, to: Hashable) -> "Move":
        """A fault, such as the death of a robot."""
        return cls((), words, to)


Letter = tuple[int, int, Any]
"""A message: its sender, its receiver, and what it says."""


@dataclass(frozen=True)
class Mail:
    """Messages under way between nodes, which arrive in any order, and how many of them may yet be lost."""

    losses: int = 0
    under_way: tuple[Letter, ...] = ()

    def send(self, *letters: Letter) -> "Mail":
        """The mail with these messages, in one order whatever order they were sent in."""
        under_way = list(self.under_way)
        for letter in letters:
            if not isinstance(letter, tuple) or len(letter) != 3:
                raise TypeError(f"{letter!r} is no message: send tuples of a sender, a receiver, and what it says")
            insort(under_way, letter)
        return replace(self, under_way=tuple(under_way))

    def arrivals(self) -> Iterator[tuple[Letter, "Mail"]]:
        """Every message that may arrive next, with the mail that is left then."""
        for place, letter in enumerate(self.under_way):
            yield letter, replace(self, under_way=self.under_way[:place] + self.under_way[place + 1 :])

    def moves(self, hears: Callable[[Letter, "Mail"], Hashable], lost: Callable[["Mail"], Hashable]) -> Iterator[Move]:
        """Every arrival as a move of its receiver, to the state that comes of it; and every loss as a fault."""
        for letter, left in self.arrivals():
            yield Move.of(letter[1], "hears", hears(letter, left))
        if self.losses > 0:
            for _, left in self.arrivals():
                yield Move.fault("a message is lost", lost(replace(left, losses=self.losses - 1)))


def eventually(
    id: str, words: str, is_so: Callable[[Any], bool] | Callable[[Any, Sequence[Cell]], bool]
) -> Demand:
    """``is_so`` is to be so of a state at some time in every run that is weakly fair.

    Of a rule for robots on cells it is asked of a state and of robots in these cells.
    """
    return Demand(id, words, "eventually", is_so)


def again_and_again(
    id: str, words: str, owed: Callable[[Any], Iterable[int]] | Callable[[Any, Sequence[Cell]], Iterable[int]]
) -> Demand:
    """No weakly fair run is to owe one of these numbers, from 0 to 15, from some time on for ever.

    ``owed`` returns those that are owed in a state; of a rule for robots on cells, in a state and with robots in these cells.
    """
    return Demand(id, words, "again-and-again", owed)


class Protocol:
    """A rule over states, all of which :func:`pytautline.decide_protocol` searches.

    A state is a value that can be hashed and compared, such as a tuple or a frozen dataclass. The functions of a subclass depend on
    nothing but their arguments. An actor is awake in a state if one of its moves is possible there. A run is weakly fair if it
    leaves out nobody who is awake throughout.
    """

    name: str = "written"
    """The name of the rule: letters, digits and hyphens."""
    bound: str = "all its states"
    """The bound in words, such as the number of nodes: it stands in files, which are replayed within the same bound."""
    demands: Sequence[Demand] = ()
    """What is demanded: ``always`` of two states, before and after a move, ``at_the_end`` of one, ``eventually``, ``again_and_again``."""
    covers: Sequence[str] = ()
    """The moves that must occur, by their words: where one does not, the question is open."""

    def starts(self) -> Iterable[Hashable]:
        """The states in which runs begin; the smallest ones first, as they are told first."""
        raise NotImplementedError("a rule over states has starts")

    def moves(self, state: Any) -> Iterable[Move]:
        """Every move that is possible in a state, always in the same order. If there is none, the run is over."""
        raise NotImplementedError("a rule over states has moves")

    def alike(self, state: Any) -> Iterable[Hashable]:
        """The other states that are taken for one with a state, such as the floor in its turns; none, unless there is more to tell.

        From each of them the same moves of the same actors, in the same words, lead to states that are taken for one, and each
        demand says the same of them.
        """
        return ()

    def actor(self, number: int) -> str:
        """The name of an actor, or of whoever else a move is said to be made ``by``, above a drawing of the move."""
        return str(number)

    def draw(self, state: Any) -> str:
        """A drawing of a state, in lines."""
        return repr(state)
