"""A class of the tests: one lab, its instructor, students who join and hand in."""

from __future__ import annotations

import json
import uuid
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from app.ops.settings import Settings
from tests.app.a_lab import A_LAB, SOLVED

API = "/api/v1/classes"
UNSOLVED = {"poles": [-2, -2.5, -9.25, -8.76], "outer": "none"}


def labs_folder(folder: Path) -> Path:
    """A folder with the small lab in it, for HELI2DOF_LABS."""
    own = folder / "labs"
    own.mkdir(exist_ok=True)
    (own / "small.yaml").write_text(A_LAB, encoding="utf-8")
    return own


def class_settings(folder: Path) -> Settings:
    """Of a server with the small lab and a database in the folder."""
    return Settings(
        labs=labs_folder(folder),
        database=f"sqlite:///{folder}/classes.db",
        students_most=30,
        request_rate=2000,
    )


def refused(reply: Any, status: int, code: str) -> dict[str, Any]:
    """What a refusal says."""
    assert (reply.status_code, reply.json().get("code")) == (status, code), reply.text
    return reply.json()


def in_class(client: Any, path: str, value: Any = None) -> tuple[str, Any, dict[str, str]]:
    """A documented path and body, filled in for a class that is there; and the headers that open it."""
    room = ClassRoom.made(client)
    ada = room.join()
    own = path.endswith(("/mine", "/recording"))
    room.hand_in(ada["student"])
    known = {
        "{lab}": "small",
        "{code}": room.code,
        "{student}": str(ada["id"]),
        "{step}": "settle",
        "{hint}": "1",
    }
    for name, part in known.items():
        path = path.replace(name, part)
    text = json.dumps(value).replace("{student}", ada["student"]).replace("one-pair", "small")
    return path, json.loads(text), {"Heli2dof-Secret": ada["student"]} if own else room.key


@dataclass(frozen=True)
class ClassRoom:
    """A class on some server; `client` is one of httpx2 or starlette."""

    client: Any
    code: str
    instructor: str

    @staticmethod
    def made(client: Any, title: str = "Monday", **more: Any) -> ClassRoom:
        reply = client.post(API, json={"lab": "small", "title": title, **more})
        assert reply.status_code == 200, reply.text
        return ClassRoom(client, reply.json()["code"], reply.json()["instructor"])

    @property
    def address(self) -> str:
        return f"{API}/{self.code}"

    @property
    def key(self) -> dict[str, str]:
        return {"Heli2dof-Secret": self.instructor}

    def on(self, client: Any) -> ClassRoom:
        """The same class by another client."""
        return ClassRoom(client, self.code, self.instructor)

    def join(self, name: str = "Ada", **more: Any) -> dict[str, Any]:
        reply = self.client.post(f"{self.address}/join", json={"name": name, **more})
        assert reply.status_code == 200, reply.text
        return reply.json()

    def send(self, student: str, step: str = "settle", design: Any = None, **more: Any) -> Any:
        """An attempt; the answer as it comes."""
        body = {
            "student": student,
            "id": str(uuid.uuid4()),
            "step": step,
            "design": SOLVED if design is None else design,
            "answers": {},
            **more,
        }
        return self.client.post(f"{self.address}/attempts", json=body)

    def hand_in(self, student: str, step: str = "settle", design: Any = None, **more: Any) -> dict[str, Any]:
        reply = self.send(student, step, design, **more)
        assert reply.status_code == 200, reply.text
        return reply.json()

    def draft(self, student: str, seq: int, design: Any = None, step: str = "settle") -> Any:
        body = {"student": student, "step": step, "design": design or SOLVED, "seq": seq}
        return self.client.put(f"{self.address}/draft", json=body)

    def mine(self, student: str) -> dict[str, Any]:
        reply = self.client.get(f"{self.address}/mine", headers={"Heli2dof-Secret": student})
        assert reply.status_code == 200, reply.text
        return reply.json()

    def wall(self) -> dict[str, Any]:
        reply = self.client.get(self.address, headers=self.key)
        assert reply.status_code == 200, reply.text
        return reply.json()

    def change(self, **changes: Any) -> dict[str, Any]:
        reply = self.client.patch(self.address, headers=self.key, json=changes)
        assert reply.status_code == 200, reply.text
        return reply.json()
