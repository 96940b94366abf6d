"""A lab in a class, in a real browser: joined, closed and opened, without a network, in two tabs, elsewhere."""

from __future__ import annotations

from playwright.sync_api import Browser, expect

from tests.browser import state
from tests.e2e.conftest import App
from tests.e2e.lab_pages import Class, goal, handed_in, joined, lab, ready, secret, server, solved
from tests.patience import until

__all__ = ["server"]


def test_a_class_from_joining_to_its_end(chromium: Browser, server: App):
    group = Class(server)
    with lab(chromium, group.url, clock=True) as visit:
        page = visit.page
        expect(page.get_by_test_id("join-title")).to_have_text("Monday, group A")
        joined(page, "Ada Lovelace")
        solved(page)
        page.get_by_test_id("lab-q-why-input").fill("It dies away last.")
        handed_in(page, "Handed in:")
        (ada,) = group.students
        assert (ada["name"], ada["steps"]["settle"]["attempts"]) == ("Ada Lovelace", 1)
        # an answer in words is marked by hand, with a comment
        mark = {"step": "settle", "question": "why", "points": 2, "comment": "Well said."}
        group.call("POST", f"/students/{ada['id']}/marks", json=mark)
        page.clock.fast_forward(61_000)
        expect(page.get_by_test_id("lab-q-why-told")).to_contain_text("2 of 2. Well said.")
        # closed: told, practice goes on, nothing is lost; opened again: it heals by itself
        group.call("PATCH", json={"open": False})
        page.get_by_test_id("lab-hand-in").click()
        expect(page.get_by_test_id("lab-standing")).to_contain_text("closed")
        expect(page.get_by_test_id("lab-standing")).to_contain_text("1 attempt waits here")
        expect(page.get_by_test_id("lab-verdict")).to_contain_text("handed in if the class opens again")
        goal(page, "rise-time-theta", "met")
        assert group.attempts(ada["id"]) == 1
        group.call("PATCH", json={"open": True})
        page.clock.fast_forward(21_000)
        expect(page.get_by_test_id("lab-standing")).to_be_empty()
        until(lambda: group.attempts(ada["id"]) == 2, "the attempt that waited")
        expect(page.get_by_test_id("lab-verdict")).to_contain_text("Handed in:")
        expect(page.get_by_test_id("lab-verdict")).not_to_contain_text("Kept here")
        # who is deleted is told
        group.call("DELETE", f"/students/{ada['id']}")
        page.get_by_test_id("lab-hand-in").click()
        expect(page.get_by_test_id("lab-standing")).to_contain_text("does not know you any more")


def test_without_a_network_nothing_is_lost_and_nothing_counts_twice(chromium: Browser, server: App):
    group = Class(server)
    with lab(chromium, group.url) as visit:
        page = visit.page
        joined(page, "Emmy Noether")
        (emmy,) = group.students
        other = visit.context.new_page()
        other.goto(group.url)
        expect(other.get_by_test_id("lab-who")).to_have_text("Emmy Noether")
        ready(other)
        visit.context.set_offline(True)
        page.get_by_test_id("lab-hand-in").click()
        expect(page.get_by_test_id("lab-standing")).to_contain_text("1 attempt waits here")
        other.get_by_test_id("lab-hand-in").click()
        expect(other.get_by_test_id("lab-standing")).to_contain_text("2 attempts wait here")
        visit.context.set_offline(False)
        for tab in (page, other):
            expect(tab.get_by_test_id("lab-standing")).to_be_empty()
        until(lambda: group.attempts(emmy["id"]) == 2, "both attempts")
        page.reload()
        expect(page.get_by_test_id("lab-best")).to_contain_text("2 attempts")
        assert group.attempts(emmy["id"]) == 2


def test_another_machine_by_the_personal_link_and_another_student_on_this_one(chromium: Browser, server: App):
    group = Class(server)
    with lab(chromium, group.url) as visit:
        page = visit.page
        joined(page, "Ada")
        solved(page)
        page.get_by_test_id("lab-q-who-2").check()
        handed_in(page, "Handed in:")
        page.get_by_test_id("lab-q-slowest-input").fill("6")
        poles = state(page)["poles"]
        (ada,) = group.students
        until(lambda: group.draft(ada["id"]).get("answers") == {"who": 2, "slowest": "6"}, "a draft")
        own = group.rig(page)
        with lab(chromium, f"{group.url}&me={secret(page, group.code)}") as elsewhere:
            there = elsewhere.page
            expect(there.get_by_test_id("lab-who")).to_have_text("Ada")
            ready(there)
            assert "me=" not in there.url
            assert state(there)["poles"] == poles
            expect(there.get_by_test_id("lab-q-slowest-input")).to_have_value("6")
            expect(there.get_by_test_id("lab-q-who-told")).to_have_text("✓ right")
            expect(there.get_by_test_id("lab-q-slowest-told")).to_be_empty()  # it was not handed in
        page.get_by_test_id("lab-not-me").click()
        joined(page, "Grace" + "e" * 75)  # as long as a name may be, and in sight
        body = page.get_by_test_id("lab-body")
        assert body.evaluate("(node) => node.scrollWidth <= node.clientWidth")
        assert state(page)["poles"][0]["re"] == -2
        assert sorted(one["name"][:5] for one in group.students) == ["Ada", "Grace"]
        assert group.rig(page) != own, "their rigs differ"


def test_a_class_that_is_not_there(chromium: Browser, server: App):
    with lab(chromium, f"{server.url}#class=ZZZZZZZ") as visit:
        expect(visit.page.get_by_test_id("lab-refused")).to_contain_text("no class with this code")
