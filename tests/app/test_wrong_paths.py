"""Who comes to a wrong path by a browser gets a page, a program a problem."""

from __future__ import annotations

import pytest


@pytest.mark.parametrize(
    ("path", "status", "root"),
    [
        ("/nothing", 404, "./"),
        ("/a/b", 404, "../"),
        ("/static/none.js", 404, "../"),
        ("/api/v1/gains", 405, "../../"),
    ],
)
def test_a_person_who_comes_to_a_wrong_path_gets_a_page(client, path: str, status: int, root: str):
    asked = {"accept": "text/html,application/xhtml+xml,*/*;q=0.8"}
    reply = client.get(path, headers=asked)
    assert (reply.status_code, reply.headers["content-type"]) == (status, "text/html; charset=utf-8")
    assert f'<a href="{root}">Go to heli2dof</a>' in reply.text
    assert f'href="{root}static/css/login.css"' in reply.text
    assert "script" not in reply.text and "style-src 'self'" in reply.headers["content-security-policy"]
    assert client.head(path, headers=asked).status_code == status
    for accept in ("*/*", "application/json", "image/webp,*/*"):
        reply = client.get(path, headers={"accept": accept})
        assert reply.headers["content-type"] == "application/problem+json"
