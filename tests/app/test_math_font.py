"""The font of the formulas: every sign that they write is in it, its licence beside it, and it is small."""

from __future__ import annotations

import re
from functools import cache
from html import unescape
from itertools import chain
from pathlib import Path

import pytest
from fontTools.ttLib import TTFont

from app.contract.paper_reply import paper_reply
from heli2dof_core import Structure
from heli2dof_core.export.math_font import face
from heli2dof_core.symbolic.mathml import mathml
from heli2dof_core.symbolic.render import symbolic_report
from tests.children import ROOT

FOLDER = ROOT / "static" / "vendor" / "stix-two-math"
FONT = FOLDER / "stix-two-math.woff2"
MOST = 40_000
"""Bytes."""
STRUCTURES = [
    Structure(),
    Structure("triangular", "yaw"),
    Structure("input-diagonal"),
    Structure("axis-decoupled"),
]


@cache
def font() -> TTFont:
    return TTFont(FONT)


def slanted(letter: str) -> str:
    """The sign that a browser shows of a letter that stands alone in `mi`."""
    code = ord(letter)
    for first, last, italic in ((0x41, 0x5A, 0x1D434), (0x61, 0x7A, 0x1D44E), (0x391, 0x3A9, 0x1D6E2)):
        if first <= code <= last:
            return "ℎ" if letter == "h" else chr(code - first + italic)
    return chr(code - 0x3B1 + 0x1D6FC) if 0x3B1 <= code <= 0x3C9 else letter


def signs(formula: str) -> set[str]:
    """All that a formula shows."""
    found = set(unescape(re.sub(r"<[^>]*>", "", formula)))
    alone = re.findall(r"<mi>(&#x[0-9A-F]+;|[^<])</mi>", formula)
    return found | {slanted(unescape(letter)) for letter in alone}


def formulas_of_the_paper(part: object) -> list[str]:
    """Every MathML text in a reply."""
    if isinstance(part, dict):
        own = [part["mathml"]] if part.get("mathml") else []
        return own + [text for value in part.values() for text in formulas_of_the_paper(value)]
    return (
        [text for value in part for text in formulas_of_the_paper(value)]
        if isinstance(part, list | tuple)
        else []
    )


def test_every_sign_of_every_formula_is_in_the_font():
    texts = formulas_of_the_paper(paper_reply())
    for structure in STRUCTURES:
        report = symbolic_report(structure)
        groups = (report.formulas, report.definitions, report.notation, *report.entries.values())
        texts += [f.mathml for f in chain.from_iterable(group.values() for group in groups)]
    assert len(texts) > 300
    known = font().getBestCmap()
    wanted = set().union(*map(signs, texts)) - {"\n", " "}
    assert len(wanted) > 100
    assert sorted(sign for sign in wanted if ord(sign) not in known) == []


def test_signs_that_the_page_writes_itself_are_in_the_font():
    modules = [*(ROOT / "static").rglob("*.js")]
    texts = [file.read_text("utf-8") for file in modules if "vendor" not in file.parts]
    inline = set("".join(chain.from_iterable(re.findall(r"\$([^$`{}]{1,40})\$", text) for text in texts)))
    symbols = set(
        "".join(chain.from_iterable(re.findall(r"\bsym(?:bol)?\('([^']+)'", text) for text in texts))
    )
    known = font().getBestCmap()
    assert {"θ", "ψ", "τ"} <= inline | symbols
    lost = {
        sign for sign in inline | symbols if len(sign) == 1 and ord(sign) not in known and sign.isprintable()
    }
    assert {
        sign for sign in lost if not ("\u00c0" <= sign <= "\u024f" or "\u1e00" <= sign <= "\u1eff")
    } == set()


def test_it_is_a_font_for_mathematics_and_small():
    assert {"MATH", "glyf", "cmap"} <= set(font().keys())
    variants = font()["MATH"].table.MathVariants
    tall = {font().getBestCmap()[ord(sign)] for sign in "()[]√∫"}
    assert tall <= set(variants.VertGlyphCoverage.glyphs), "brackets and roots grow"
    assert FONT.stat().st_size <= MOST


def test_letters_that_a_slanted_sans_would_confuse_are_different_shapes():
    """a and α, v and ν: a formula has both."""
    shapes, known = font()["glyf"], font().getBestCmap()
    for one, other in (("𝑎", "𝛼"), ("𝑣", "𝜈"), ("𝑤", "𝜔"), ("𝐾", "𝜅")):
        first, second = (shapes[known[ord(sign)]].getCoordinates(shapes)[0] for sign in (one, other))
        assert list(first) != list(second)


@pytest.mark.parametrize(
    "folder", [FOLDER, ROOT / "heli2dof_core" / "export" / "vendor"], ids=["page", "report"]
)
def test_its_licence_stands_beside_it(folder: Path):
    licence = (folder / "LICENSE").read_text("utf-8")
    assert "STIX Fonts Project Authors" in licence and "SIL OPEN FONT LICENSE" in licence.upper()
    names = {record.nameID: str(record) for record in TTFont(folder / FONT.name)["name"].names}
    assert "STIX Fonts Project Authors" in names[0] and "Open Font License" in names[13]


def test_a_report_carries_it_whole_and_names_nothing_outside():
    rule = face()
    assert rule.count("url(") == 1 and "url(data:font/woff2;base64," in rule
    assert len(rule) > 4 / 3 * FONT.stat().st_size


@pytest.mark.parametrize(
    ("latex", "mark"),
    [
        (r"\dot\theta", "˙"),
        (r"\ddot{\psi}", "¨"),
        (r"\hat{G}(s)", "ˆ"),
        (r"\bar A", "¯"),
        (r"\tilde x", "˜"),
        (r"\dot{v}_{p}", "˙"),
    ],
)
def test_an_accent_is_an_accent(latex: str, mark: str):
    made = unescape(mathml(latex))
    assert re.search(rf'<mover accent="true">.*<mo stretchy="false">{mark}</mo></mover>', made)


def test_accents_upon_accents_and_lines_over_products():
    assert unescape(mathml(r"\dot{\hat x}")).count('accent="true"') == 2
    assert '<mover accent="true">' not in mathml(r"\overline{A B}")
    assert "&amp;" not in mathml(r"\frac{a<b}{c}") and "<mo>&#x0003C;</mo>" in mathml("a<b")
