"""Mutual exclusion by Ricart and Agrawala (Communications of the ACM 24, 1981), with messages that may be lost."""

from dataclasses import dataclass, replace

import pytautline as tautline
from pytautline import Mail, Move


@dataclass(frozen=True)
class Node:
    """Its phase, the number of its request, the largest one that it knows, who has replied, and who waits."""

    phase: str = "idle"
    own: int = 0
    known: int = 0
    replies: frozenset[int] = frozenset()
    waiting: frozenset[int] = frozenset()


class Mutex(tautline.Protocol):
    name = "published"
    covers = ("asks", "hears", "enters", "leaves")
    demands = (
        tautline.always("MUTEX-1", "at most one node is inside", lambda _, to: [node.phase for node in to[0]].count("inside") <= 1),
        tautline.at_the_end("MUTEX-2", "every node has been inside", lambda state: all(node.phase == "done" for node in state[0])),
    )

    def __init__(self, nodes: int, losses: int, breaks_ties: bool = True) -> None:
        self.nodes, self.losses, self.breaks_ties = nodes, losses, breaks_ties
        self.bound = f"{nodes} nodes, each enters once, every order of messages, at most {losses} lost"

    def starts(self):
        return [((Node(),) * self.nodes, Mail(self.losses))]

    def moves(self, state):
        nodes, mail = state
        for me, node in enumerate(nodes):
            others = [other for other in range(self.nodes) if other != me]
            number = node.known + 1
            if node.phase == "idle":
                asks = mail.send(*((me, other, number) for other in others))
                yield Move.of(me, "asks", (put(nodes, me, Node("wants", number, number)), asks))
            elif node.phase == "wants" and len(node.replies) == len(others):
                yield Move.of(me, "enters", (put(nodes, me, replace(node, phase="inside")), mail))
            elif node.phase == "inside":
                replies = mail.send(*((me, other, 0) for other in node.waiting))
                yield Move.of(me, "leaves", (put(nodes, me, Node("done", node.own, node.known)), replies))
        yield from mail.moves(lambda letter, left: self.receive(nodes, letter, left), lambda left: (nodes, left))

    def receive(self, nodes, letter, mail):
        """A number is that of a request, 0 is a reply."""
        sender, me, number = letter
        node = replace(nodes[me], known=max(nodes[me].known, number))
        is_first = node.own < number or node.own == number and (me < sender or not self.breaks_ties)
        if number == 0:
            node = replace(node, replies=node.replies | {sender})
        elif node.phase == "inside" or node.phase == "wants" and is_first:
            node = replace(node, waiting=node.waiting | {sender})
        else:
            mail = mail.send((me, sender, 0))
        return put(nodes, me, node), mail


def put(nodes, me, node):
    return (*nodes[:me], node, *nodes[me + 1 :])
