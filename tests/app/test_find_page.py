"""What the page's tests take for the server's answer is one."""

from __future__ import annotations

from app.contract.find_replies import FindReply
from tests.children import ROOT


def test_the_recorded_reply_is_what_the_contract_says():
    text = (ROOT / "tests/page/fixtures/find_reply.json").read_text("utf-8")
    reply = FindReply.model_validate_json(text)
    assert reply.met and reply.designs and reply.present
    assert all(len(design.figures) == len(reply.figures) for design in reply.designs)
