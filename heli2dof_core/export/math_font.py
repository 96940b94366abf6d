"""The font of the reports' formulas, which stands in them: a page that is kept needs nothing from elsewhere."""

from base64 import b64encode
from pathlib import Path

FAMILY = "STIX Two Math"
_FILE = Path(__file__).parent / "vendor" / "stix-two-math.woff2"


def face() -> str:
    """The CSS rule that brings the font; none in a checkout from which no wheel has been built."""
    if not _FILE.is_file():
        return ""
    data = b64encode(_FILE.read_bytes()).decode()
    return f'@font-face {{ font-family: "{FAMILY}"; src: url(data:font/woff2;base64,{data}) format("woff2"); }}\n'
