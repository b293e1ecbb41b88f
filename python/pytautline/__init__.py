"""Robot teams that must stay in radio contact: maps, runs, hunts for counterexamples, rules of one's own.

Cells are (column, row), counted from 0; columns go east, rows go south. Steps are the letters E, S, W and N, and "." for a robot
that stays.
"""

from ._errors import (
    Error,
    InputError,
    RuleError,
    RuleNeverEnds,
    RuleNotPure,
    RuleRaised,
    RuleWrongType,
)
from ._native import (
    Counterexample,
    Estimate,
    HuntReport,
    Layout,
    Moved,
    OwnCounterexample,
    OwnHuntReport,
    Run,
    Sweep,
    estimate,
    estimate_ratio,
    estimate_share,
    explore,
    hunt,
    hunt_rule,
    in_contact,
    replay,
    schemes,
    sweep,
)
from ._rule import Cell, Demand, Rule, always, at_the_end, never_endless

__all__ = [
    "Cell",
    "Counterexample",
    "Demand",
    "Error",
    "Estimate",
    "HuntReport",
    "InputError",
    "Layout",
    "Moved",
    "OwnCounterexample",
    "OwnHuntReport",
    "Rule",
    "RuleError",
    "RuleNeverEnds",
    "RuleNotPure",
    "RuleRaised",
    "RuleWrongType",
    "Run",
    "Sweep",
    "always",
    "at_the_end",
    "estimate",
    "estimate_ratio",
    "estimate_share",
    "explore",
    "hunt",
    "hunt_rule",
    "in_contact",
    "never_endless",
    "replay",
    "schemes",
    "sweep",
]
