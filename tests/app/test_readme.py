"""The README's examples work as they stand there."""

from __future__ import annotations

import json
import re
import shlex
from pathlib import Path

README = (Path(__file__).parents[2] / "README.md").read_text(encoding="utf-8")


def blocks(language: str) -> list[str]:
    return re.findall(rf"```{language}\n(.*?)```", README, re.DOTALL)


def test_curl_lines_get_an_answer(client):
    commands = [c for b in blocks("sh") for c in re.findall(r"^curl (?:.*\\\n)*.*$", b, re.MULTILINE)]
    assert len(commands) == 5
    for command in commands:
        words = shlex.split(command.replace("\\\n", " "))
        url = next(word for word in words if word.startswith("http://127.0.0.1:8000/"))
        header = words[words.index("-H") + 1].split(": ")
        body = words[words.index("-d") + 1]
        reply = client.post(url.removeprefix("http://127.0.0.1:8000"), content=body, headers=dict([header]))
        assert reply.status_code == 200, command
        assert json.loads(reply.text)


def test_python_example_runs(capsys):
    (example,) = blocks("python")
    exec(compile(example, "README.md", "exec"), {})
    shown = capsys.readouterr().out
    assert "51.17" in shown and "1.0069" in shown
