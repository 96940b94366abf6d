#!/bin/sh
# latex2mathml: \hat is an accent, \dot and \ddot are not.
#
# One expects: what LaTeX calls accents (\hat, \dot, \ddot) becomes <mover accent="true">, one like the other.
# What happens: \hat{G} has accent="true"; \dot{\theta} and \ddot{\theta} have not. Browsers that follow MathML Core set
#   what stands over a letter without it like a limit over a sum: smaller.
# Seen with: latex2mathml 3.81.1.
# Why it matters: rates are half of a mechanical system's states, and with so small a dot a rate reads as its angle. Set
#   the attribute after the conversion.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet latex2mathml==3.81.1
"$folder/venv/bin/python" - <<'EOF'
from xml.etree import ElementTree

from latex2mathml.converter import convert

accents = {}
for name in ("hat", "dot", "ddot"):
    tree = ElementTree.fromstring(convert(rf"\{name}{{\theta}}"))
    (over,) = [node for node in tree.iter() if node.tag.endswith("}mover")]
    accents[name] = over.get("accent")
    print(f"\\{name}: accent={accents[name]}")
assert accents == {"hat": "true", "dot": None, "ddot": None}, "it has changed"
EOF
