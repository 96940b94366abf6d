#!/bin/sh
# joserfc: a good token with one header parameter that it does not know is refused.
#
# One expects: header parameters that are not understood are ignored (RFC 7515, section 4: "All Header Parameters not
#   defined by this specification MUST be ignored when not understood", unless "crit" names them).
# What happens: jwt.decode raises UnsupportedHeaderError for a token whose header has "origin" beside alg, kid and typ.
#   PyJWT and jwcrypto take the same token. So does joserfc with JWSRegistry(..., strict_check_header=False); "crit" is
#   still obeyed then.
# Seen with: joserfc 1.8.0, PyJWT 2.15.1, jwcrypto 1.6.1.
# Why it matters: identity and learning platforms put parameters of their own into headers. All logins fail on the day
#   on which one is added, and the error says "unsupported", as if the token were at fault.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet joserfc==1.8.0 pyjwt==2.15.1 jwcrypto==1.6.1
"$folder/venv/bin/python" - <<'EOF'
import json

import jwt as pyjwt
from joserfc import jwt
from joserfc.jwk import RSAKey
from joserfc.jws import JWSRegistry
from jwcrypto.jwk import JWK
from jwcrypto.jwt import JWT

key = RSAKey.generate_key(2048)
private, public = key.as_pem(private=True), key.as_pem(private=False)


def token(**more):
    return pyjwt.encode({"sub": "ada"}, private, "RS256", headers={"kid": "k1", **more})


def told(take):
    try:
        return str(take())
    except Exception as error:
        return type(error).__name__


lenient = JWSRegistry(algorithms=["RS256"], strict_check_header=False)
readers = {
    "PyJWT": lambda text: pyjwt.decode(text, public, ["RS256"])["sub"],
    "jwcrypto": lambda text: json.loads(JWT(jwt=text, key=JWK.from_pem(public), algs=["RS256"]).claims)["sub"],
    "joserfc": lambda text: jwt.decode(text, key, ["RS256"]).claims["sub"],
    "joserfc, lenient": lambda text: jwt.decode(text, key, registry=lenient).claims["sub"],
}
for name, read in readers.items():
    plain, further = (told(lambda: read(text)) for text in (token(), token(origin="cluster-3")))
    print(f"{name}: plain {plain}, with another header parameter {further}")
    assert plain == "ada"
    assert further == ("UnsupportedHeaderError" if name == "joserfc" else "ada"), "it has changed"
critical = told(lambda: readers["joserfc, lenient"](token(crit=["origin"], origin="cluster-3")))
print(f"joserfc, lenient: the same as critical {critical}")
assert critical != "ada", "it has changed"
EOF
