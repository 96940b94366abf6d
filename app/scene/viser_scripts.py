"""The scripts that viser's page holds, so that a content security policy can allow them and no others.

Viser's index.html has one script with the whole client packed into an attribute (zstd, then base 88, five
characters for four bytes); it unpacks that and runs it as a second inline script.
"""

from __future__ import annotations

import re

import numpy as np
import zstandard

_LOADER = re.compile(
    r'<script data-p="(?P<packed>[^"]*)" data-ss="(?P<style>\d+)" data-cs="(?P<code>\d+)">(?P<script>.*?)</script>',
    re.DOTALL,
)
_ALPHABET = re.compile(r'const A="((?:[^"\\]|\\.)*)"')
_BASE, _DIGITS, _BYTES = 88, 5, 4


def inline_scripts(page: str) -> tuple[bytes, bytes]:
    """Return the script that unpacks the client, and the client's own.

    Raises:
        RuntimeError: if the page is packed in another way.
    """
    loader = _LOADER.search(page)
    alphabet = loader and _ALPHABET.search(loader["script"])
    if loader is None or alphabet is None:
        raise RuntimeError("viser's page is packed in another way: is this viser 1.1.1?")
    packed = _decoded(loader["packed"], alphabet[1].replace("\\\\", "\\"))
    style, code = int(loader["style"]), int(loader["code"])
    try:
        client = zstandard.ZstdDecompressor().decompress(packed, max_output_size=style + code)
    except zstandard.ZstdError as error:
        raise RuntimeError(f"viser's page cannot be unpacked: {error}") from error
    return loader["script"].encode(), client[style:]


def _decoded(text: str, alphabet: str) -> bytes:
    values = np.zeros(256, np.uint64)
    values[np.frombuffer(alphabet.encode("ascii"), np.uint8)] = np.arange(len(alphabet))
    digits = values[np.frombuffer(text.encode("ascii"), np.uint8)]
    whole = len(digits) // _DIGITS * _DIGITS
    powers = np.array([_BASE**k for k in reversed(range(_DIGITS))], np.uint64)
    data = (digits[:whole].reshape(-1, _DIGITS) @ powers).astype(">u4").tobytes()
    rest = digits[whole:]
    last = 0
    for digit in rest:
        last = last * _BASE + int(digit)
    return data + last.to_bytes(max(len(rest) - (_DIGITS - _BYTES), 0), "big")
