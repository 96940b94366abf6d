"""The laboratory report on paper: two pages, on either continent's, with its formulas' own font and room to write."""

from __future__ import annotations

import re
from dataclasses import replace

import pytest
from playwright.sync_api import Browser, expect

from heli2dof_core import PoleSet, Rotor, Rotors, Scenario, Spec, preset
from heli2dof_core.export import FORMATS, Beside

BASE = Spec.from_preset(preset())
UNSTABLE = replace(
    BASE, poles=PoleSet([-3 + 4j, -3 - 4j, -5, -6]), scenario=Scenario(theta=0.6, duration=8.0)
)
SIX = replace(BASE, rotors=Rotors(Rotor(0.16), Rotor(0.16)), place_rotors=True)
LINK = "http://127.0.0.1:8000/#v1&" + "&".join(f"at{i}=-12.345678,-9.87654" for i in range(30))
PINS = [(f"{letter} as before", spec) for letter, spec in zip("ABCDEF", [BASE, UNSTABLE] * 3, strict=True)]
ASKED = {"settling": 1.0, "overshoot": 5.0, "lag": 0.2}
CASES = {"default": (BASE, []), "unstable": (UNSTABLE, []), "pins": (BASE, PINS), "six-pins": (SIX, PINS)}


@pytest.mark.parametrize("name", CASES)
def test_the_report_is_two_pages(chromium: Browser, name: str):
    spec, pins = CASES[name]
    page = chromium.new_page()
    page.set_content(FORMATS["report"].content(spec, LINK, Beside(pins, ASKED)).decode())
    page.evaluate("async () => { await document.fonts.ready; }")
    for paper in ("A4", "Letter"):
        made = page.pdf(format=paper)
        assert len(re.findall(rb"/Type\s*/Page\b", made)) == 2, paper
        assert b"STIXTwoMath" in made
    assert page.evaluate("() => document.querySelectorAll('link, script, img, iframe').length") == 0
    page.close()


def test_answers_are_typed_and_printed(chromium: Browser):
    page = chromium.new_page()
    page.set_content(FORMATS["report"].content(BASE).decode())
    for field, text in (("Name", "Ada"), ("Date", "1 May"), ("Answers", "Because\nthe poles moved.")):
        box = page.get_by_role("textbox", name=field)
        box.fill(text)
        expect(box).to_contain_text(text.split("\n")[0])
    assert "the poles moved." in page.content()  # so that a saved page keeps it
    page.close()
