"""What can go wrong, as exceptions that name the field and say what to do.

    Heli2DofError
    ├── InvalidInputError          a value is not a number, out of its range, or unknown
    │   └── ChangedLogError        a flight's log is not what was flown
    ├── UnpairedPolesError         a pair is neither two real poles nor two conjugates
    ├── UncontrollableError        the two motors cannot move the two axes independently
    ├── StructureUnavailableError  the coupling asked for does not exist on this rig
    ├── MethodUnavailableError     a placement method cannot solve this task, or is not installed
    ├── RecordingError             a recorded file, or what it holds, is unusable
    └── CancelledError             whoever asked does not want the answer any more

A design that is legal but unwise raises nothing; it carries findings (see `findings`).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any


class Heli2DofError(ValueError):
    """Base of every error that the core raises on purpose.

    Attributes:
        code: stable machine-readable name of the kind of error.
        field: path of the offending input, by the names of the core's fields: ``J_p`` of `Parameters`,
            ``parameters.J_p`` of a `Spec`; empty if there is no one.
        value: the offending value, as given.
        hint: what to do instead, in one sentence.
    """

    code = "error"

    def __init__(self, message: str, *, field: str = "", value: object = None, hint: str = "") -> None:
        super().__init__(message)
        self.field = field
        self.value = value
        self.hint = hint

    def __reduce__(self) -> tuple[Any, ...]:
        """As processes send it to one another, whatever its kind is made of."""
        return _again, (type(self), self.args), self.__dict__

    def name_field(self, field: str) -> None:
        """Calls the offending input by another path, in the message too."""
        message = str(self)
        if self.field and message.startswith(f"{self.field} "):
            self.args = (field + message[len(self.field) :],)
        self.field = field


def _again(kind: type[Heli2DofError], args: tuple[Any, ...]) -> Heli2DofError:
    return kind.__new__(kind, *args)


class InvalidInputError(Heli2DofError):
    """A single value is unusable."""

    code = "invalid_input"


class ChangedLogError(InvalidInputError):
    """A flight's log is not as it was written: its checksum or the states that it tells do not fit."""

    code = "changed_log"


class UnpairedPolesError(Heli2DofError):
    """Poles 1, 2 or 3, 4 are neither both real nor conjugates: no real gain exists for them."""

    code = "unpaired_poles"


class UncontrollableError(Heli2DofError):
    """The pair (A, B) is not controllable; on this rig exactly where K_pp K_yy = K_py K_yp."""

    code = "uncontrollable"


class StructureUnavailableError(Heli2DofError):
    """The wanted closed-loop structure does not exist for these parameters."""

    code = "structure_unavailable"


class MethodUnavailableError(Heli2DofError):
    """A placement method cannot solve the task, or needs a package that is not installed."""

    code = "method_unavailable"


class RecordingError(Heli2DofError):
    """A file of a recording cannot be read, or a row or column of it is unusable."""

    code = "unusable_recording"


class CancelledError(Heli2DofError):
    """The work was called off by whoever asked for it."""

    code = "cancelled"


@contextmanager
def within_field(path: str) -> Iterator[None]:
    """Whatever is refused in here is called by its path below this one."""
    try:
        yield
    except Heli2DofError as error:
        error.name_field(f"{path}.{error.field}" if error.field else path)
        raise


Wanted = Callable[[], None]
"""Called now and then in long work; raises where nobody waits for the outcome any more."""


def nobody_leaves() -> None:
    """A `Wanted` for whoever waits to the end."""
