#!/bin/sh
# PyJWT, jwcrypto and joserfc: the same token a few seconds off, three answers.
#
# One expects: reading a signed token checks its times, with the same leeway or with none; the libraries differ in
#   names alone.
# What happens, each called as its documentation shows first:
#   - a token that ended 30 s ago: PyJWT refuses it; jwcrypto takes it (it grants 60 s unasked); joserfc's decode looks at
#     no time at all, which JWTClaimsRegistry().validate does, and refuses.
#   - a token made by a clock that goes 30 s before ours: PyJWT refuses it ("not yet valid (iat)"), and so does joserfc's
#     registry; jwcrypto looks at "iat" for its type alone.
# Seen with: PyJWT 2.15.1, jwcrypto 1.6.1, joserfc 1.8.0.
# Why it matters: whoever changes the library changes who is let in. Servers' clocks differ by a second or two: with no
#   leeway every login through a platform whose clock goes before fails, until the clock is set; give the leeway by name.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet joserfc==1.8.0 pyjwt==2.15.1 jwcrypto==1.6.1
"$folder/venv/bin/python" - <<'EOF'
import time

import jwt as pyjwt
from joserfc import jwt
from joserfc.jwk import RSAKey
from joserfc.jwt import JWTClaimsRegistry
from jwcrypto.jwk import JWK
from jwcrypto.jwt import JWT

key = RSAKey.generate_key(2048)
private, public = key.as_pem(private=True), key.as_pem(private=False)
now = int(time.time())
tokens = {
    "ended 30 s ago": {"iat": now - 300, "exp": now - 30},
    "made in 30 s": {"iat": now + 30, "exp": now + 300},
    "ended an hour ago": {"iat": now - 7200, "exp": now - 3600},
}
readers = {
    "PyJWT": lambda text: pyjwt.decode(text, public, ["RS256"]),
    "jwcrypto": lambda text: JWT(jwt=text, key=JWK.from_pem(public), algs=["RS256"]),
    "joserfc's decode": lambda text: jwt.decode(text, key, ["RS256"]),
    "joserfc's registry": lambda text: JWTClaimsRegistry().validate(jwt.decode(text, key, ["RS256"]).claims),
}
seen = {}
for name, read in readers.items():
    for about, times in tokens.items():
        text = pyjwt.encode({"sub": "ada", **times}, private, "RS256")
        try:
            read(text)
            seen[name, about] = "taken"
        except Exception:
            seen[name, about] = "refused"
        print(f"{name}: {about}: {seen[name, about]}")
takes = {pair for pair, answer in seen.items() if answer == "taken"}
assert takes == {
    ("jwcrypto", "ended 30 s ago"),
    ("jwcrypto", "made in 30 s"),
    *(("joserfc's decode", about) for about in tokens),
}, "it has changed"
EOF
