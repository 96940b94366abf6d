"""What a platform is asked: a token, a column for grades, a grade into it, the names and roles of a course."""

from __future__ import annotations

import json
import re
import secrets
import threading
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from datetime import UTC, datetime
from time import time
from typing import Any
from urllib.parse import urlencode, urljoin

from .addresses import beneath, with_query
from .errors import PlatformError
from .keys import signed
from .launch import shown
from .outward import Answer, ask
from .platforms import Platform
from .vocabulary import (
    ASSERTION_TYPE,
    LINEITEM_TYPE,
    LINEITEMS_TYPE,
    MEMBERS_TYPE,
    SCOPE_LINEITEM,
    SCOPE_MEMBERS,
    SCOPE_SCORE,
    SCORE_TYPE,
    is_instructor,
)

_ASSERTION_SECONDS = 300
_SPARE_SECONDS = 60
"""By which a token is given up before it ends."""
_MOST_PAGES, _MOST_MEMBERS = 50, 5000
_NEXT = re.compile(r'<([^<>]{1,2000})>\s*;[^,<>]*\brel\s*=\s*"?next\b', re.IGNORECASE)


@dataclass(frozen=True)
class Score:
    """Somebody's grade.

    Attributes:
        subject: the person, as the platform calls them.
        points: so far.
        most: of the whole lab.
        stamp: as of when, seconds since 1970.
        to_mark: answers that nobody has marked yet.
    """

    subject: str
    points: float
    most: float
    stamp: float
    to_mark: int = 0

    def body(self) -> dict[str, Any]:
        """As the platform takes it.

        It is always told as graded: Moodle and others leave the points of what is not aside, and points so far are
        a grade so far.
        """
        done = self.points >= self.most and not self.to_mark
        told: dict[str, Any] = {
            "userId": self.subject,
            "scoreGiven": self.points,
            "scoreMaximum": self.most,
            "timestamp": datetime.fromtimestamp(self.stamp, UTC).isoformat(timespec="milliseconds"),
            "activityProgress": "Completed" if done else "InProgress",
            "gradingProgress": "FullyGraded",
        }
        if self.to_mark:
            answers = "1 answer waits" if self.to_mark == 1 else f"{self.to_mark} answers wait"
            told["comment"] = f"{answers} to be marked by hand."
        return told


@dataclass(frozen=True)
class Member:
    """Somebody in a course: id, name (empty where the platform keeps it to itself), whether they teach."""

    subject: str
    name: str
    instructor: bool


class Services:
    """The services of all platforms, with the tokens for them. Blocks; safe for threads.

    Args:
        key: returns the private key that signs now.
        send: how platforms are asked.
        clock: seconds since 1970.
    """

    def __init__(
        self,
        key: Callable[[], Mapping[str, Any]],
        send: Callable[..., Answer] = ask,
        clock: Callable[[], float] = time,
    ) -> None:
        self._key, self._send, self._clock = key, send, clock
        self._lock = threading.Lock()
        self._tokens: dict[tuple[int, str, str], tuple[str, float]] = {}

    def put_score(self, platform: Platform, lineitem: str, score: Score) -> None:
        """Puts a grade into its column.

        Raises:
            LtiError: the column is at no host of the platform.
            PlatformError: it could not be put there.
        """
        answer = self._call(
            platform,
            SCOPE_SCORE,
            beneath(lineitem, "scores"),
            {"Content-Type": SCORE_TYPE},
            score.body(),
        )
        self._require(answer, "does not take the grade")

    def lineitem(self, platform: Platform, lineitems: str, link: str, title: str, most: float) -> str:
        """The column of a link: the one that is there, or a new one.

        Raises:
            LtiError: it is at no host of the platform.
            PlatformError: there is none, and none could be made.
        """
        where = with_query(lineitems, urlencode({"resource_link_id": link}))
        answer = self._call(platform, SCOPE_LINEITEM, where, {"Accept": LINEITEMS_TYPE})
        self._require(answer, "does not show its columns of grades")
        listed = answer.json()
        for item in listed if isinstance(listed, list) else []:
            if (
                isinstance(item, dict)
                and item.get("resourceLinkId") == link
                and isinstance(item.get("id"), str)
            ):
                return item["id"]
        body = {"scoreMaximum": most, "label": title, "resourceLinkId": link}
        headers = {"Content-Type": LINEITEM_TYPE, "Accept": LINEITEM_TYPE}
        answer = self._call(platform, SCOPE_LINEITEM, lineitems, headers, body)
        self._require(answer, "makes no column of grades")
        made = answer.json()
        if not isinstance(made, dict) or not isinstance(made.get("id"), str):
            raise PlatformError(
                "The platform does not say which column of grades it has made.", answer.status
            )
        return made["id"]

    def members(self, platform: Platform, address: str) -> list[Member]:
        """Names and roles of a course, those who have left aside.

        Raises:
            LtiError: a page of them is at no host of the platform.
            PlatformError: they could not be had.
        """
        found: dict[str, Member] = {}
        for _ in range(_MOST_PAGES):
            answer = self._call(platform, SCOPE_MEMBERS, address, {"Accept": MEMBERS_TYPE})
            self._require(answer, "does not show the members of the course")
            told = answer.json()
            listed = told.get("members") if isinstance(told, dict) else None
            if not isinstance(listed, list):
                raise PlatformError("The platform's list of members cannot be read.", answer.status)
            for member in filter(None, map(_member, listed)):
                found[member.subject] = member
            # Link's header says where the next page is (RFC 8288).
            following = _NEXT.search(answer.headers.get("link", ""))
            if following is None or len(found) >= _MOST_MEMBERS:
                break
            address = urljoin(address, following.group(1))
        return list(found.values())

    def _call(
        self,
        platform: Platform,
        scope: str,
        address: str,
        headers: Mapping[str, str],
        body: Mapping[str, Any] | None = None,
    ) -> Answer:
        """Asks with a token; once more with a new one, where the platform does not know the old one any more."""
        method, content = "GET", None
        if body is not None:
            method, content = "POST", json.dumps(body, ensure_ascii=False).encode()
        for fresh in (False, True):
            with_token = {**headers, "Authorization": f"Bearer {self._token(platform, scope, fresh)}"}
            answer = self._send(method, address, platform.hosts, headers=with_token, body=content)
            if answer.status != 401:
                break
        return answer

    def _token(self, platform: Platform, scope: str, fresh: bool) -> str:
        kept, now = (platform.id, platform.token_url, scope), self._clock()
        with self._lock:
            token, ends = self._tokens.get(kept, ("", 0.0))
        if token and not fresh and now < ends:
            return token
        assertion = {
            "iss": platform.client_id,
            "sub": platform.client_id,
            "aud": platform.audience,
            "iat": int(now),
            "exp": int(now) + _ASSERTION_SECONDS,
            "jti": secrets.token_urlsafe(16),
        }
        form = {
            "grant_type": "client_credentials",
            "client_assertion_type": ASSERTION_TYPE,
            "client_assertion": signed(assertion, self._key()),
            "scope": scope,
        }
        headers = {"Content-Type": "application/x-www-form-urlencoded", "Accept": "application/json"}
        answer = self._send(
            "POST", platform.token_url, platform.hosts, headers=headers, body=urlencode(form).encode()
        )
        self._require(answer, "gives no token for its services")
        told = answer.json()
        token = told.get("access_token") if isinstance(told, dict) else None
        if not isinstance(token, str) or not re.fullmatch(r"[\x21-\x7e]{1,16384}", token):
            raise PlatformError("The platform's token for its services cannot be read.", answer.status)
        lasts = told.get("expires_in")
        seconds = float(lasts) if isinstance(lasts, (int, float)) and 0 < lasts < 86400 else 3600.0
        with self._lock:
            self._tokens[kept] = token, now + seconds - _SPARE_SECONDS
        return token

    @staticmethod
    def _require(answer: Answer, what: str) -> None:
        """Raises PlatformError unless the platform has done it."""
        if 200 <= answer.status < 300:
            return
        wait = answer.headers.get("retry-after", "")
        raise PlatformError(
            f"The platform {what} (it answers with {answer.status}).",
            answer.status,
            float(wait) if wait.isascii() and wait.isdigit() and len(wait) < 7 else 0.0,
        )


def _member(told: Any) -> Member | None:
    if not isinstance(told, dict) or told.get("status", "Active") != "Active":
        return None
    subject, roles = told.get("user_id"), told.get("roles")
    if not isinstance(subject, str) or not subject:
        return None
    listed = tuple(role for role in roles if isinstance(role, str)) if isinstance(roles, list) else ()
    return Member(subject, shown(told.get("name")), is_instructor(listed))
