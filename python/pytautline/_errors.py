"""What can be wrong, each with what it is and what would be right."""

import ctypes


class Error(Exception):
    """Something is wrong: ``what`` it is, and what to do, the ``remedy``."""

    def __init__(self, what: str, remedy: str) -> None:
        # Both are `args`, by which an exception is pickled.
        super().__init__(what, remedy)
        self.what = what
        self.remedy = remedy

    def __str__(self) -> str:
        return f"{self.what}; {self.remedy}"


class InputError(Error, ValueError):
    """What was given is wrong: a file, a description, an array, a number."""


class RuleError(Error):
    """A rule written in Python cannot be hunted."""


class RuleRaised(RuleError):
    """The rule raised an exception, which is the ``__cause__``."""


class RuleWrongType(RuleError, TypeError):
    """The rule returned, or has, what no rule may."""


class RuleNeverEnds(RuleError):
    """A call of the rule has not returned in time."""


class RuleNotPure(RuleError):
    """The rule does not answer the same to the same."""


class Overdue(BaseException):
    """Is raised within a rule that has not returned in time. A rule does not catch it."""


def interrupt(thread: int) -> None:
    """Raises :class:`Overdue` in the thread of this number, as soon as it executes Python code."""
    ctypes.pythonapi.PyThreadState_SetAsyncExc(ctypes.c_ulong(thread), ctypes.py_object(Overdue))
