"""What a launch may say, how it begins, and which addresses are used at all."""

from __future__ import annotations

import json
from typing import Any

import pytest

from app.lti import addresses, platforms
from app.lti.launch import launch_of
from app.lti.login import authorization, read_login
from app.lti.platforms import Platform, platform_of
from app.lti.vocabulary import is_instructor
from tests.app.test_lti_tokens import CLAIM, CLAIMS, PLATFORM, ROLES, SITE, code_of

GRADES = "https://purl.imsglobal.org/spec/lti-ags/claim/endpoint"


def changed(**changes: Any) -> dict[str, Any]:
    return {**CLAIMS, **{f"{CLAIM}{name}": value for name, value in changes.items()}}


def test_what_a_launch_says() -> None:
    columns = {"lineitem": f"{SITE}/a/1?x=2", "lineitems": f"{SITE}/a", "scope": ["other"]}
    launch = launch_of({**changed(custom={"lab": "one-pair"}), GRADES: columns}, PLATFORM)
    assert (launch.kind, launch.link, launch.subject, launch.name) == ("link", "link-1", "42", "Ada Student")
    assert (launch.lab, launch.title, launch.instructor) == ("one-pair", "Poles", False)
    assert (launch.lineitem, launch.scopes) == (f"{SITE}/a/1?x=2", ())
    assert type(launch).from_json(json.loads(json.dumps(launch.as_json()))) == launch


def test_personal_data_that_were_not_asked_for_are_not_read() -> None:
    told = launch_of({**CLAIMS, "email": "ada@example", "picture": "https://p", "name": ""}, PLATFORM)
    assert "ada@example" not in repr(told) and "https://p" not in repr(told) and told.name == ""
    assert (
        launch_of({**CLAIMS, "name": None, "given_name": "Ada", "family_name": "S"}, PLATFORM).name == "Ada S"
    )


def test_names_are_one_short_line() -> None:
    name = "  Ada\u202e\n\x00 " + "S" * 200
    assert launch_of({**CLAIMS, "name": name}, PLATFORM).name == "Ada " + "S" * 76
    assert launch_of({**CLAIMS, "name": {"x": 1}}, PLATFORM).name == ""


@pytest.mark.parametrize(
    ("claims", "code"),
    [
        (changed(version="1.1"), "malformed_launch"),
        (changed(message_type="LtiSubmissionReviewRequest"), "malformed_launch"),
        (changed(deployment_id="8"), "unknown_deployment"),
        (changed(deployment_id=7), "malformed_launch"),
        (changed(target_link_uri="https://evil.example/lti/launch"), "foreign_target"),
        (changed(target_link_uri="https://lab.example@evil.example/"), "bad_address"),
        (changed(target_link_uri="javascript:alert(1)"), "bad_address"),
        (changed(target_link_uri="https://lab.example:444/"), "foreign_target"),
        (changed(resource_link={}), "malformed_launch"),
        (changed(resource_link={"id": "x" * 256}), "malformed_launch"),
        ({**CLAIMS, "sub": None}, "anonymous"),
        ({**CLAIMS, "sub": ""}, "anonymous"),
        ({**CLAIMS, GRADES: {"lineitem": "https://169.254.169.254/latest"}}, "foreign_address"),
        ({**CLAIMS, GRADES: {"lineitem": "http://moodle.example/a"}}, "bad_address"),
        ({**CLAIMS, GRADES: {"lineitems": "https://moodle.example:8443/a"}}, "foreign_address"),
        ({**CLAIMS, GRADES: {"lineitem": "file:///etc/passwd"}}, "bad_address"),
    ],
)  # fmt: skip
def test_what_a_launch_may_not_say(claims: dict[str, Any], code: str) -> None:
    assert code_of(lambda: launch_of(claims, PLATFORM)) == code


def test_only_who_teaches_chooses() -> None:
    settings = {"deep_link_return_url": f"{SITE}/back", "accept_types": ["ltiResourceLink"], "data": "d"}
    deep = "https://purl.imsglobal.org/spec/lti-dl/claim/deep_linking_settings"
    claims = {**changed(message_type="LtiDeepLinkingRequest"), deep: settings}
    assert code_of(lambda: launch_of(claims, PLATFORM)) == "not_allowed"
    claims[f"{CLAIM}roles"] = [f"{ROLES}membership#Instructor"]
    launch = launch_of(claims, PLATFORM)
    assert (launch.kind, launch.return_url, launch.data, launch.takes_links) == (
        "choice",
        f"{SITE}/back",
        "d",
        True,
    )
    settings["deep_link_return_url"] = "https://evil.example/back"
    assert code_of(lambda: launch_of(claims, PLATFORM)) == "foreign_address"


@pytest.mark.parametrize(
    ("roles", "teaches"),
    [
        (("membership#Instructor",), True),
        (("membership/Instructor#TeachingAssistant", "membership#Learner"), True),
        (("membership#Learner", "institution/person#Administrator"), False),
        (("institution/person#Administrator",), True),
        (("system/person#Administrator",), True),
        (("institution/person#Instructor",), False),
        (("membership#Mentor",), False),
        ((), False),
    ],
)
def test_who_teaches(roles: tuple[str, ...], teaches: bool) -> None:
    assert is_instructor(tuple(ROLES + role for role in roles)) is teaches


def test_bare_roles_of_old_platforms() -> None:
    assert (
        is_instructor(("Instructor",)) and not is_instructor(("Learner",)) and not is_instructor(("Teacher",))
    )


LOGIN = {
    "iss": SITE,
    "client_id": "heli",
    "login_hint": "42",
    "lti_message_hint": "m/1&2",
    "target_link_uri": "https://lab.example/lti/launch",
    "lti_storage_target": "_parent",
}


def test_the_way_to_the_platform() -> None:
    from urllib.parse import parse_qs, urlsplit

    platform, login = read_login(LOGIN, [PLATFORM])
    address = authorization(platform, login, "s", "n")
    query = parse_qs(urlsplit(address).query)
    assert address.startswith(f"{SITE}/mod/lti/auth.php?")
    assert query["redirect_uri"] == ["https://lab.example/lti/launch"]
    assert query["lti_message_hint"] == ["m/1&2"] and query["response_mode"] == ["form_post"]
    assert login.storage == "_parent"
    assert read_login({**LOGIN, "lti_storage_target": "a'b"}, [PLATFORM])[1].storage == ""


@pytest.mark.parametrize(
    ("changes", "code"),
    [
        ({"iss": "https://evil.example"}, "unknown_platform"),
        ({"client_id": "other"}, "unknown_platform"),
        ({"login_hint": ""}, "malformed_login"),
        ({"login_hint": "x" * 9000}, "malformed_login"),
        ({"lti_deployment_id": "8"}, "unknown_deployment"),
        ({"target_link_uri": "https://evil.example/"}, "foreign_target"),
        ({"target_link_uri": ""}, "bad_address"),
    ],
)
def test_logins_that_are_refused(changes: dict[str, str], code: str) -> None:
    assert code_of(lambda: read_login({**LOGIN, **changes}, [PLATFORM])) == code


def test_two_ids_at_one_issuer_need_to_be_told_apart() -> None:
    from dataclasses import replace

    both = [PLATFORM, replace(PLATFORM, name="second", client_id="heli-2")]
    assert read_login({**LOGIN, "client_id": "heli-2"}, both)[0].name == "second"
    assert code_of(lambda: read_login({**LOGIN, "client_id": ""}, both)) == "unknown_platform"
    assert read_login({**LOGIN, "client_id": ""}, both[:1])[0] is PLATFORM


@pytest.mark.parametrize(
    "address",
    [
        "", "http://moodle.example", "ftp://moodle.example", "https://", "https://a@moodle.example",
        "https://moodle.example/#x", "https://moodle.example:x", "https://moodle.example:0",
        "https://mood le.example", "https://moodle.exämple", "//moodle.example",
        "https://moodle.example/" + "a" * 2000, "https://[::1", "http://127.0.0.1.evil.example",
        "http://10.0.0.1", "https://moodle.example\\@evil.example",
    ],
)  # fmt: skip
def test_addresses_that_are_not_used(address: str) -> None:
    assert code_of(lambda: addresses.checked(address, "It")) == "bad_address"


def test_addresses_of_this_machine_are_for_trying() -> None:
    assert addresses.host_of("http://127.0.0.1:8123/a") == "127.0.0.1:8123"
    assert addresses.host_of("http://[::1]/a") == "[::1]"
    assert addresses.host_of("https://Moodle.Example:443/a") == "moodle.example"


def test_beneath_an_address_with_a_query() -> None:
    assert (
        addresses.beneath(f"{SITE}/l/1/lineitem?type_id=3", "scores")
        == f"{SITE}/l/1/lineitem/scores?type_id=3"
    )
    assert addresses.with_query(f"{SITE}/l?a=1", "b=2") == f"{SITE}/l?a=1&b=2"


def test_known_platforms() -> None:
    given, hosts = platforms.canvas("https://school.instructure.com")
    assert given["issuer"] == "https://canvas.instructure.com" and hosts == ("school.instructure.com",)
    assert given["keyset_url"] == "https://sso.canvaslms.com/api/lti/security/jwks"
    beta, _ = platforms.canvas("https://school.beta.instructure.com/")
    assert beta["issuer"] == "https://canvas.beta.instructure.com"
    assert beta["token_url"] == "https://sso.beta.canvaslms.com/login/oauth2/token"
    own, hosts = platforms.canvas("https://canvas.school.example")
    assert (own["issuer"], hosts) == ("https://canvas.school.example", ("canvas.school.example",))
    canvas = platform_of(
        "c",
        "https://lab.example",
        given,
        client_id="1",
        deployments=("1",),
        hosts=("school.instructure.com",),
    )
    assert canvas.hosts == ("sso.canvaslms.com", "school.instructure.com")


@pytest.mark.parametrize(
    "changes",
    [
        {"name": "Moodle!"}, {"address": "http://lab.example"}, {"client_id": ""}, {"deployments": ()},
        {"deployments": ("",)}, {"hosts": ("https://x",)}, {"given": {"issuer": SITE}},
        {"given": {**platforms.moodle(SITE), "token_url": "http://moodle.example/token"}},
    ],
)  # fmt: skip
def test_registrations_that_are_refused(changes: dict[str, Any]) -> None:
    good: dict[str, Any] = {
        "name": "moodle", "address": "https://lab.example", "given": platforms.moodle(SITE),
        "client_id": "heli", "deployments": ("7",),
    }  # fmt: skip
    code_of(lambda: platform_of(**{**good, **changes}))
    assert isinstance(platform_of(**good), Platform)
