"""How the report looks, on a screen and on paper."""

from pathlib import Path

from .math_font import face

STYLE = face() + (Path(__file__).parent / "templates" / "report.css").read_text("utf-8")
"""Stands in the report itself; the page's policy allows exactly this content."""
