"""What is refused of classes: each with its HTTP status, its code and what to do."""

from __future__ import annotations

from typing import Any


class ClassError(Exception):
    """A call on classes is refused; becomes a problem object (see `app.contract.problems`).

    Args:
        status: of HTTP.
        detail: what is wrong, in words.
        code: stable name for programs.
        hint: what to do.
        retry_after: when to ask again, s.
        more: further members of the problem object.
    """

    def __init__(
        self,
        status: int,
        detail: str,
        code: str,
        *,
        hint: str = "",
        retry_after: int | None = None,
        **more: Any,
    ) -> None:
        super().__init__(detail)
        self.status, self.detail, self.code, self.hint = status, detail, code, hint
        self.retry_after, self.more = retry_after, more


def unknown_class() -> ClassError:
    """There is no class of this code."""
    return ClassError(
        404,
        "There is no class with this code: it may be mistyped, or the class has ended or was deleted.",
        "unknown_class",
        hint="Compare the code's seven letters with the one on the board.",
    )


def unknown_secret(whose: str) -> ClassError:
    """The secret opens nothing in this class; `whose`: `student` or `instructor`."""
    place = "a place in this class" if whose == "student" else "this class"
    hint = (
        "Join again, or ask your instructor for a new personal link."
        if whose == "student"
        else "Use the newest instructor's link; a new one ends those before it."
    )
    return ClassError(
        403, f"This link does not open {place}: it was replaced or deleted.", "unknown_secret", hint=hint
    )


def unknown_student() -> ClassError:
    """No such student is in the class."""
    return ClassError(404, "No such student is in this class: deleted, perhaps.", "unknown_student")


def unknown_step(name: str) -> ClassError:
    """The lab has no such step."""
    return ClassError(422, f"The lab has no step {name[:60]!r}.", "unknown_step", field="step", value=name)


def class_closed(when: str | None) -> ClassError:
    """Nothing is taken any more; `when`: since which time, ISO 8601."""
    since = f" since {when}" if when else ""
    hint = "What you do now is practice; hand it in when your instructor opens the class again."
    error = ClassError(409, f"The class is closed{since}.", "class_closed", hint=hint)
    if when:
        error.more["closed_at"] = when
    return error


def no_database(why: str, hint: str) -> ClassError:
    """Classes cannot be kept here as the server is set."""
    return ClassError(503, f"Classes cannot be kept: {why}", "no_database", hint=hint, retry_after=30)


def database_away() -> ClassError:
    """The database does not answer at the moment; nothing was kept of the call."""
    return ClassError(
        503,
        "The database does not answer at the moment.",
        "database_away",
        hint="Nothing is lost: send it again in a few seconds.",
        retry_after=2,
    )


def too_fast(seconds: float, what: str) -> ClassError:
    """Somebody asks more often than any page does."""
    return ClassError(
        429,
        f"Too many {what} in a short time.",
        "too_many_requests",
        hint=f"Send it again in {int(seconds) + 1} s.",
        retry_after=int(seconds) + 1,
    )
