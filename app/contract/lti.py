"""What is told of the course of a class (LTI's names and roles)."""

from __future__ import annotations

from pydantic import BaseModel, Field


class Member(BaseModel):
    """Somebody in the course."""

    name: str = Field(description="empty where the platform keeps it to itself")
    instructor: bool
    student: int | None = Field(None, description="id in the class; left out where they have not joined")


class MembersReply(BaseModel):
    """Everybody in the course, as the platform tells it at this moment; nothing of it is kept."""

    members: list[Member]
    at: str = Field(description="ISO 8601, UTC")
