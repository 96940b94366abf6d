"""The page's module of the figures of merit, made of the core's registry: `python -m tests.page_figures` writes it.

As Prettier and TypeScript have it, so that it is checked like any other module; a test holds it to the registry.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from textwrap import wrap

from heli2dof_core.figures import KINDS, RESPONSE, STEP, Figure
from tests.children import ROOT
from tests.page_source import WIDTH, quoted

PAGE = ROOT / "static" / "model" / "figures.js"
HEAD = """/**
 * The figures of merit: names, meanings, units, how they are written and which way is better. Made of
 * heli2dof_core/figures by `python -m tests.page_figures`; not to be changed by hand.
 *
 * @typedef {object} Figure
 * @property {string} name  of its value in replies
 * @property {string} [head]  of its row
 * @property {string} [short]  of its column
 * @property {string} [hint]  what is said of that column
 * @property {string} [meaning]
 * @property {string} [source]  of its definition
 * @property {string} [symbol]  subscripts after _
 * @property {'significant'|'seconds'|'decibel'|'exponent'} [notation]  without: fixed decimals
 * @property {number} digits  decimals, or significant digits
 * @property {number} [scale]  of a value when it is written
 * @property {string} [after]  each number: its unit
 * @property {'higher'|'none'} [better]  without: lower
 * @property {boolean} [signed]  its size alone is better or worse
 * @property {boolean} [detail]  seen only where more figures are asked for
 * @property {number} [least]  values that differ by less are alike
 */
"""


def module() -> str:
    """The whole module."""
    parts = [HEAD, *(f"\n{figure_object(kind, known)}" for kind, known in KINDS.items())]
    parts += (
        "\n/** Rows of an axis' step, in their order. @type {Record<string, Figure>} */\n",
        "export const RESPONSE = {\n",
        *(f"  {_key(name, KINDS[_kind(name)][name])}: {_place(name)},\n" for name in RESPONSE),
        "};\n",
    )
    return "".join(parts)


def _key(name: str, figure: Figure) -> str:
    return figure.key or name


def _kind(name: str) -> str:
    return "step" if name in STEP else "axis"


def _place(name: str) -> str:
    kind = _kind(name)
    return f"{kind.upper()}.{_key(name, KINDS[kind][name])}"


def figure_object(kind: str, known: Mapping[str, Figure]) -> str:
    """The figures of a kind as an object."""
    keys = "|".join(f"'{_key(*item)}'" for item in known.items())
    described = wrap(f"@type {{Record<{keys.replace('|', ' | ')}, Figure>}}", WIDTH - 3)
    lines = (
        [f"/** {described[0]} */"] if len(described) == 1 else ["/**", *(f" * {x}" for x in described), " */"]
    )
    lines.append(f"export const {kind.upper()} = {{")
    for name, figure in known.items():
        lines += [f"  {_key(name, figure)}: {{", *_properties(name, figure), "  },"]
    return "\n".join((*lines, "};", ""))


def _properties(name: str, figure: Figure) -> Iterator[str]:
    unit = figure.shown or figure.unit if figure.notation in ("fixed", "significant") else ""
    bare = figure.measured if figure.notation == "exponent" else figure.meaning  # its cells have no unit
    seen = bool(figure.title)
    told = {
        "name": name,
        "head": figure.titled,
        "short": figure.short,
        "hint": figure.short and (figure.hint or bare),
        "meaning": f"{figure.meaning[:1].upper()}{figure.meaning[1:]}" if seen else "",
        "source": figure.source if seen else "",
        "symbol": figure.symbol,
        "notation": "" if figure.notation in ("fixed", "flag") else figure.notation,
        "digits": figure.digits,
        "scale": figure.scale if figure.scale != 1 else "",
        "after": "" if figure.in_head else unit if unit in ("", "°") else f" {unit}",
        "better": "" if figure.better == "lower" else figure.better,
        "signed": figure.signed,
        "detail": figure.detail,
        "least": figure.least or "",
    }
    for key, value in told.items():
        if value is True:
            yield f"    {key}: true,"
        elif isinstance(value, str) and value:
            yield from _text(key, value)
        elif not isinstance(value, str | bool):
            yield f"    {key}: {repr(value).removesuffix('.0')},"


def _text(key: str, text: str) -> Iterator[str]:
    """A property whose words may need several lines."""
    parts = wrap(text, WIDTH - 12) if len(text) > WIDTH - 9 else [text]
    shown = [quoted(f"{part}{' ' if i < len(parts) - 1 else ''}") for i, part in enumerate(parts)]
    if len(shown) == 1 and len(line := f"    {key}: {shown[0]},") <= WIDTH:
        yield line
        return
    yield f"    {key}:"
    yield " +\n".join(f"      {part}" for part in shown) + ","


if __name__ == "__main__":
    PAGE.write_text(module(), encoding="utf-8")
