"""What is believed of a platform's token, and what a launch may say."""

from __future__ import annotations

import base64
import hashlib
import hmac
import json
from collections.abc import Callable
from typing import Any

import pytest
from joserfc import jwt
from joserfc.jwk import ECKey, RSAKey

from app.lti import keys, platforms
from app.lti.errors import LtiError, PlatformError
from app.lti.keys import KeySets
from app.lti.outward import Answer
from app.lti.platforms import platform_of
from app.lti.tokens import MOST_CHARACTERS, verified

NOW = 1_800_000_000.0
SITE = "https://moodle.example"
CLAIM = "https://purl.imsglobal.org/spec/lti/claim/"
ROLES = "http://purl.imsglobal.org/vocab/lis/v2/"
GRADES = "https://purl.imsglobal.org/spec/lti-ags/claim/endpoint"
PLATFORM = platform_of(
    "moodle", "https://lab.example", platforms.moodle(SITE), client_id="heli", deployments=("7",)
)
KEY = RSAKey.generate_key(2048, {"use": "sig", "alg": "RS256", "kid": "k1"})
OTHER = RSAKey.generate_key(2048, {"use": "sig", "alg": "RS256", "kid": "k1"})
CLAIMS: dict[str, Any] = {
    "iss": SITE,
    "aud": "heli",
    "azp": "heli",
    "sub": "42",
    "iat": int(NOW) - 5,
    "exp": int(NOW) + 300,
    "nonce": "n",
    "name": "Ada Student",
    f"{CLAIM}message_type": "LtiResourceLinkRequest",
    f"{CLAIM}version": "1.3.0",
    f"{CLAIM}deployment_id": "7",
    f"{CLAIM}target_link_uri": "https://lab.example/lti/launch",
    f"{CLAIM}resource_link": {"id": "link-1", "title": "Poles"},
    f"{CLAIM}roles": [f"{ROLES}membership#Learner"],
}


class Shelf:
    """A platform's keyset, and how often it was fetched."""

    def __init__(self, *shown: dict[str, Any]) -> None:
        self.shown, self.fetched, self.now = list(shown), 0, 0.0
        self.keys = KeySets(self.ask, lambda: self.now)

    def ask(self, method: str, address: str, hosts: tuple[str, ...]) -> Answer:
        assert (method, address, hosts) == ("GET", PLATFORM.keyset_url, PLATFORM.hosts)
        self.fetched += 1
        return Answer(200, {}, json.dumps({"keys": self.shown}).encode())


@pytest.fixture
def shelf() -> Shelf:
    return Shelf(KEY.as_dict())


def signed(claims: dict[str, Any], key: RSAKey = KEY, **header: Any) -> str:
    return jwt.encode({"alg": "RS256", "kid": "k1", **header}, claims, key, registry=lenient())


def lenient() -> Any:
    from joserfc.jws import JWSRegistry

    return JWSRegistry(algorithms=["RS256", "ES256"], strict_check_header=False)


def raw(header: dict[str, Any], payload: bytes, signature: bytes = b"") -> str:
    parts = (json.dumps(header).encode(), payload, signature)
    return ".".join(base64.urlsafe_b64encode(part).rstrip(b"=").decode() for part in parts)


def code_of(call: Callable[[], Any]) -> str:
    with pytest.raises(LtiError) as caught:
        call()
    assert caught.value.message and caught.value.message[-1] == "."
    return caught.value.code


def test_a_good_token_is_believed(shelf: Shelf) -> None:
    assert verified(signed(CLAIMS), PLATFORM, shelf.keys, NOW) == CLAIMS
    assert verified(signed({**CLAIMS, "aud": ["heli", "other"]}), PLATFORM, shelf.keys, NOW)["sub"] == "42"
    assert shelf.fetched == 1


def test_unsigned_and_wrongly_signed_tokens_are_refused(shelf: Shelf) -> None:
    payload = json.dumps(CLAIMS).encode()
    public = KEY.as_pem(private=False)
    unsigned = raw({"alg": "none", "kid": "k1"}, payload)
    assert code_of(lambda: verified(unsigned, PLATFORM, shelf.keys, NOW)) == "bad_algorithm"
    head = raw({"alg": "HS256", "kid": "k1"}, payload).rpartition(".")[0]
    mac = hmac.new(public, head.encode(), hashlib.sha256).digest()
    confused = f"{head}.{base64.urlsafe_b64encode(mac).rstrip(b'=').decode()}"
    assert code_of(lambda: verified(confused, PLATFORM, shelf.keys, NOW)) == "bad_algorithm"
    forged = signed(CLAIMS, OTHER)
    assert code_of(lambda: verified(forged, PLATFORM, shelf.keys, NOW)) == "bad_signature"
    head, _, rest = signed(CLAIMS).partition(".")
    changed = (
        f"{head}.{raw({}, json.dumps({**CLAIMS, 'sub': '1'}).encode()).split('.')[1]}.{rest.split('.')[1]}"
    )
    assert code_of(lambda: verified(changed, PLATFORM, shelf.keys, NOW)) == "bad_signature"
    elliptic = jwt.encode(
        {"alg": "ES256", "kid": "k1"}, CLAIMS, ECKey.generate_key("P-256"), registry=lenient()
    )
    assert code_of(lambda: verified(elliptic, PLATFORM, shelf.keys, NOW)) == "bad_algorithm"


@pytest.mark.parametrize(
    ("changes", "code"),
    [
        ({"iss": "https://other.example"}, "wrong_issuer"),
        ({"iss": f"{SITE}/"}, "wrong_issuer"),
        ({"iss": None}, "wrong_issuer"),
        ({"aud": "other"}, "wrong_audience"),
        ({"aud": None}, "wrong_audience"),
        ({"aud": []}, "wrong_audience"),
        ({"aud": {"heli": 1}}, "wrong_audience"),
        ({"aud": ["heli", "other"], "azp": None}, "wrong_audience"),
        ({"azp": "other"}, "wrong_audience"),
        ({"exp": int(NOW) - 61}, "token_expired"),
        ({"exp": None}, "bad_time"),
        ({"exp": "soon"}, "bad_time"),
        ({"exp": int(NOW) + 86400}, "bad_time"),
        ({"iat": int(NOW) + 120}, "bad_time"),
        ({"iat": None}, "bad_time"),
        ({"nbf": int(NOW) + 120}, "bad_time"),
    ],
)  # fmt: skip
def test_who_when_and_for_whom(shelf: Shelf, changes: dict[str, Any], code: str) -> None:
    claims = {name: value for name, value in {**CLAIMS, **changes}.items() if value is not None}
    assert code_of(lambda: verified(signed(claims), PLATFORM, shelf.keys, NOW)) == code


def test_infinite_times_never_last(shelf: Shelf) -> None:
    for word in ("NaN", "Infinity", "1e400"):
        payload = json.dumps(CLAIMS).replace(f'"exp": {CLAIMS["exp"]}', f'"exp": {word}').encode()
        from joserfc.jws import serialize_compact

        token = serialize_compact({"alg": "RS256", "kid": "k1"}, payload, KEY, ["RS256"])
        assert code_of(lambda token=token: verified(token, PLATFORM, shelf.keys, NOW)) == "bad_time"


@pytest.mark.parametrize(
    "token",
    [
        "", "a.b", "a.b.c", "....", "é.é.é", "a" * 5000,
        raw({"alg": "RS256", "kid": 1}, b"{}"), raw({"kid": "k1"}, b"{}"), raw({"alg": ["RS256"]}, b"{}"),
        raw({"alg": "RS256", "kid": "k1", "crit": ["exp"], "exp": 1}, b"{}"),
        f"{base64.urlsafe_b64encode(b'[' * 3000).decode()}.e30.AA",
    ],
)  # fmt: skip
def test_what_is_no_token_is_refused(shelf: Shelf, token: str) -> None:
    assert code_of(lambda: verified(token, PLATFORM, shelf.keys, NOW)) in ("bad_token", "bad_algorithm")
    assert shelf.fetched == 0, "nobody is asked for the sake of nonsense"


def test_huge_tokens_are_refused_unread(shelf: Shelf) -> None:
    large = signed({**CLAIMS, "more": "x" * MOST_CHARACTERS})
    assert code_of(lambda: verified(large, PLATFORM, shelf.keys, NOW)) == "token_too_large"
    assert verified(signed({**CLAIMS, "more": "x" * 30_000}), PLATFORM, shelf.keys, NOW)["sub"] == "42"
    deep = signed({}, KEY)
    from joserfc.jws import serialize_compact

    deep = serialize_compact({"alg": "RS256", "kid": "k1"}, b"[" * 40_000, KEY, ["RS256"])
    assert code_of(lambda: verified(deep, PLATFORM, shelf.keys, NOW)) == "bad_token"


def test_headers_that_nobody_knows_are_ignored(shelf: Shelf) -> None:
    assert verified(signed(CLAIMS, origin="cluster-3"), PLATFORM, shelf.keys, NOW) == CLAIMS


def test_unknown_keys_are_fetched_once_and_floods_of_them_ask_nobody(shelf: Shelf) -> None:
    unknown = signed(CLAIMS, kid="k2")
    assert code_of(lambda: verified(unknown, PLATFORM, shelf.keys, NOW)) == "unknown_key"
    for _ in range(20):
        assert code_of(lambda: verified(unknown, PLATFORM, shelf.keys, NOW)) == "unknown_key"
    assert shelf.fetched == 1
    shelf.shown.append({**KEY.as_dict(), "kid": "k2"})  # the platform rotates
    shelf.now += 31.0
    assert verified(unknown, PLATFORM, shelf.keys, NOW) == CLAIMS
    assert shelf.fetched == 2
    shelf.now += 3601.0
    shelf.shown[:] = [OTHER.as_dict()]
    assert code_of(lambda: verified(signed(CLAIMS), PLATFORM, shelf.keys, NOW)) == "bad_signature"
    assert shelf.fetched == 3, "a key that was taken back is not used for ever"


def test_a_token_without_a_key_s_name(shelf: Shelf) -> None:
    nameless = jwt.encode({"alg": "RS256"}, CLAIMS, KEY, ["RS256"])
    assert verified(nameless, PLATFORM, shelf.keys, NOW) == CLAIMS
    two = Shelf(KEY.as_dict(), {**OTHER.as_dict(), "kid": "k2"})
    assert code_of(lambda: verified(nameless, PLATFORM, two.keys, NOW)) == "unknown_key"


def test_keys_for_others_and_weak_ones_are_left_aside() -> None:
    weak = {"kty": "RSA", "kid": "k1", "n": "_" * 100, "e": "AQAB"}
    broken = {"kty": "RSA", "kid": "k1", "n": 3}
    shelf = Shelf({"kty": "OKP", "crv": "X", "kid": "k1"}, weak, broken, {**KEY.as_dict(), "use": "enc"}, 3)  # type: ignore[arg-type]
    assert code_of(lambda: verified(signed(CLAIMS), PLATFORM, shelf.keys, NOW)) == "unknown_key"


@pytest.mark.parametrize("answer", [Answer(503, {}, b""), Answer(200, {}, b"<html>"), Answer(200, {}, b"[]")])
def test_a_platform_that_shows_no_keys(answer: Answer) -> None:
    with pytest.raises(PlatformError):
        KeySets(lambda *_: answer).key(PLATFORM, "k1")


def test_a_platform_that_is_away_keeps_no_thread_waiting() -> None:
    shelf, asked = Shelf(KEY.as_dict()), list[float]()
    away = True

    def ask(*given: Any) -> Answer:
        asked.append(shelf.now)
        if away:
            shelf.now += 10.0  # for which nothing came
            raise PlatformError("moodle.example does not answer.")
        return shelf.ask(*given)

    own = KeySets(ask, lambda: shelf.now)
    for _ in range(20):
        with pytest.raises(PlatformError, match="does not answer"):
            own.key(PLATFORM, "k1")
    assert asked == [0.0]
    away = False
    shelf.now += 3.1
    assert own.key(PLATFORM, "k1") is not None and len(asked) == 2


def test_our_own_keys() -> None:
    private = keys.new_key()
    (shown,) = keys.public_keys([private])["keys"]
    assert set(shown) == {"kty", "n", "e", "kid", "use", "alg"}, "nothing of the private half"
    token = keys.signed({"sub": "x"}, private)
    assert jwt.decode(token, RSAKey.import_key(shown), ["RS256"]).claims == {"sub": "x"}
    assert json.loads(base64.urlsafe_b64decode(token.split(".")[0] + "=="))["kid"] == shown["kid"]
