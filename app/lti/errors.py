"""What a launch, a registration or a call of a platform is refused with."""

from __future__ import annotations


class LtiError(Exception):
    """Something that a person is told: what is wrong, and what to do next.

    Args:
        code: stable name for programs.
        message: what is wrong.
        hint: what to do.
        status: HTTP status.
    """

    def __init__(self, code: str, message: str, hint: str = "", status: int = 400) -> None:
        super().__init__(message)
        self.code, self.message, self.hint, self.status = code, message, hint, status


class PlatformError(LtiError):
    """A platform could not be asked, or its answer is of no use.

    Args:
        message: what has happened.
        http_status: what the platform answered with, 0 where it did not answer.
        retry_after: seconds after which it wants to be asked again, 0 where it does not say.
    """

    def __init__(self, message: str, http_status: int = 0, retry_after: float = 0.0) -> None:
        super().__init__("platform_failed", message, "Try again in a minute.", 502)
        self.http_status, self.retry_after = http_status, retry_after
