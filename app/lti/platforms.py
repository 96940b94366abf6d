"""A learning platform as it is registered here."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass

from .addresses import checked, host_of, origin_of
from .errors import LtiError

_NAME = re.compile(r"[a-z0-9][a-z0-9-]{0,39}", re.ASCII)
_HOST = re.compile(r"([a-z0-9.-]+|\[[0-9a-f:]+\])(:\d{1,5})?", re.ASCII)
_MOST_CHARACTERS = 255


@dataclass(frozen=True)
class Platform:
    """One registration: an issuer and the client id that it has given to this server.

    Attributes:
        name: by which it is called here.
        address: this server's own address as the platform knows it, with a proxy's prefix, without a slash.
        issuer: as the platform names itself in its tokens.
        client_id: as the platform names this server.
        deployments: ids of the deployments that are let in.
        auth_url: where a launch asks the platform who is there.
        token_url: where tokens for the platform's services are had.
        keyset_url: where the platform's public keys are.
        audience: for whom a request for such a token is signed.
        hosts: all hosts that are asked for this platform, with a port where it is not the usual one.
        id: of the row in the database; 0 where there is none yet.
    """

    name: str
    address: str
    issuer: str
    client_id: str
    deployments: tuple[str, ...]
    auth_url: str
    token_url: str
    keyset_url: str
    audience: str
    hosts: tuple[str, ...]
    id: int = 0

    @property
    def redirect_uri(self) -> str:
        """Where the platform sends its launches."""
        return f"{self.address}/lti/launch"


def platform_of(
    name: str,
    address: str,
    given: Mapping[str, str],
    *,
    client_id: str,
    deployments: tuple[str, ...],
    hosts: tuple[str, ...] = (),
) -> Platform:
    """A platform of what an operator has said.

    Args:
        name: by which it is to be called here.
        address: this server's own, as the platform shall know it.
        given: issuer, auth_url, token_url, keyset_url, and audience where it is not the token's address.
        client_id: that the platform has given.
        deployments: ids that the platform has given, one at least.
        hosts: that are asked besides those of its addresses.

    Raises:
        LtiError: something is missing, or not usable.
    """
    if not _NAME.fullmatch(name):
        raise LtiError(
            "bad_name", f"{name[:80]!r} is no name for a platform: use a to z, 0 to 9 and hyphens."
        )
    address = address.rstrip("/")
    checked(address, "The address of this server")
    for field in ("issuer", "auth_url", "token_url", "keyset_url"):
        if not given.get(field):
            raise LtiError("missing_field", f"The platform's {field} is missing.", "Its settings tell it.")
    for what in (given["issuer"], client_id, *deployments):
        if not what or len(what) > _MOST_CHARACTERS:
            raise LtiError(
                "bad_id", f"Issuer, client id and deployments have 1 to {_MOST_CHARACTERS} characters."
            )
    if not deployments:
        raise LtiError("missing_field", "A deployment is missing.", "The platform shows its deployment id.")
    for host in hosts:
        if not _HOST.fullmatch(host):
            raise LtiError("bad_host", f"{host[:200]!r} is no host, as moodle.example is.")
    asked = [
        host_of(given[field], f"The platform's {field}") for field in ("auth_url", "token_url", "keyset_url")
    ]
    return Platform(
        name=name,
        address=address,
        issuer=given["issuer"],
        client_id=client_id,
        deployments=tuple(dict.fromkeys(deployments)),
        auth_url=given["auth_url"],
        token_url=given["token_url"],
        keyset_url=given["keyset_url"],
        audience=given.get("audience") or given["token_url"],
        hosts=tuple(dict.fromkeys((*asked, *hosts))),
    )


def moodle(address: str) -> dict[str, str]:
    """What is known of a Moodle by its address, as https://moodle.example or with a folder after it.

    Raises:
        LtiError: it is no address.
    """
    site = address.rstrip("/")
    checked(site, "Moodle's address")
    return {
        "issuer": site,
        "auth_url": f"{site}/mod/lti/auth.php",
        "token_url": f"{site}/mod/lti/token.php",
        "keyset_url": f"{site}/mod/lti/certs.php",
    }


_HOSTED_CANVAS = re.compile(r"[a-z0-9-]+(\.(beta|test))?\.instructure\.com", re.ASCII)


def canvas(address: str) -> tuple[dict[str, str], tuple[str, ...]]:
    """What is known of a Canvas by its address: its addresses, and the hosts of its services.

    Instructure's own share one issuer and one place for sign-on for production, beta and test each; the services
    are at the school's address. One that is hosted elsewhere is taken to be its own issuer.

    Raises:
        LtiError: it is no address.
    """
    site = origin_of(address.rstrip("/"), "The address of Canvas")
    host = host_of(site)
    if match := _HOSTED_CANVAS.fullmatch(host):
        kind = f"{match.group(2)}." if match.group(2) else ""
        issuer, sign_on = f"https://canvas.{kind}instructure.com", f"https://sso.{kind}canvaslms.com"
    else:
        issuer = sign_on = site
    given = {
        "issuer": issuer,
        "auth_url": f"{sign_on}/api/lti/authorize_redirect",
        "token_url": f"{sign_on}/login/oauth2/token",
        "keyset_url": f"{sign_on}/api/lti/security/jwks",
    }
    return given, (host,)
