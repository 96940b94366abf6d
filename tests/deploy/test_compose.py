"""compose.yaml and nginx's configuration agree, and nothing in them may do more than it must."""

from __future__ import annotations

import re
import shutil
import subprocess
from ipaddress import ip_address, ip_network
from pathlib import Path

import pytest
import yaml

from heli2dof_core.recordings.files import MOST_BYTES
from tests.deploy.farm import DEPLOY, program

COMPOSE = yaml.safe_load((DEPLOY.parent / "compose.yaml").read_text())
SERVICES = COMPOSE["services"]
REPLICAS = {name: service for name, service in SERVICES.items() if name not in ("proxy", "database")}
NGINX = (DEPLOY / "nginx.conf").read_text()


def setting(name: str) -> int:
    found = re.search(rf"^\s*{name} (\d+)", NGINX, re.M)
    assert found is not None, name
    return int(found[1])


def test_nginx_knows_every_replica_and_no_other():
    named = re.findall(r"^server ([\d.]+):8000 ", (DEPLOY / "replicas.conf").read_text(), re.M)
    assert named == [service["networks"]["inside"]["ipv4_address"] for service in REPLICAS.values()]
    assert len(set(named)) == len(named) > 1


@pytest.mark.parametrize("name", SERVICES)
def test_no_service_may_write_or_gain_rights(name):
    service = SERVICES[name]
    assert service["read_only"] is True
    assert service["cap_drop"] == ["ALL"]
    assert "cap_add" not in service and "privileged" not in service
    assert service["security_opt"] == ["no-new-privileges:true"]
    written = [mount for mount in service.get("volumes", []) if not mount.endswith(":ro")]
    assert written == (["classes:/var/lib/postgresql/data"] if name == "database" else [])
    assert not str(service.get("user", "10001")).startswith(("0", "root"))


def test_only_nginx_is_reached_from_outside():
    assert COMPOSE["networks"]["inside"]["internal"] is True
    assert "ports" not in SERVICES["database"] and list(SERVICES["database"]["networks"]) == ["inside"]
    for service in REPLICAS.values():
        assert "ports" not in service
        assert list(service["networks"]) == ["inside"]
    # Whom a replica serves is said by nginx alone, which does not pass on what clients claim.
    subnet = COMPOSE["networks"]["inside"]["ipam"]["config"][0]["subnet"]
    for service in REPLICAS.values():
        assert service["environment"]["HELI2DOF_TRUSTED_PROXIES"] == subnet
        assert ip_address(service["networks"]["inside"]["ipv4_address"]) in ip_network(subnet)
    assert "X-Forwarded-For $remote_addr;" in NGINX
    assert "X-Forwarded-Host $http_host;" in NGINX


def test_the_database_is_where_the_replicas_ask_for_it_and_its_password_stands_in_no_file():
    at = SERVICES["database"]["networks"]["inside"]["ipv4_address"]
    password = r"${HELI2DOF_DATABASE_PASSWORD:?a password of the database, of letters and digits}"
    assert SERVICES["database"]["environment"]["POSTGRES_PASSWORD"] == password
    for service in REPLICAS.values():
        assert (
            service["environment"]["HELI2DOF_DATABASE"] == f"postgresql://heli2dof:{password}@{at}/heli2dof"
        )
        assert service["depends_on"] == {"database": {"condition": "service_healthy"}}
        for key in ("HELI2DOF_OPERATOR_KEY", "HELI2DOF_DATABASE"):
            assert "${" in service["environment"][key]


def test_limits_fit_one_another():
    assert SERVICES["proxy"]["ulimits"]["nofile"] > 2 * setting("worker_connections")
    assert setting("client_max_body_size") * 2**20 > MOST_BYTES + 2**20  # the app refuses in its own words
    assert setting("proxy_read_timeout") > 10 * 5.0  # the app's sockets ping every 5 s


def test_nginx_takes_the_shipped_configuration_as_compose_starts_it(tmp_path: Path):
    shipped = shutil.copytree(DEPLOY, tmp_path / "etc")
    entry = SERVICES["proxy"]["entrypoint"]
    assert entry[0] == "nginx" and entry[entry.index("-c") + 1] == "/etc/heli2dof/nginx.conf"
    assert "./deploy:/etc/heli2dof:ro" in SERVICES["proxy"]["volumes"]
    arguments = ["-p", str(tmp_path), "-c", str(shipped / "nginx.conf"), "-e", "stderr"]
    told = subprocess.run(
        [program(), "-t", *arguments], capture_output=True, text=True, timeout=30, check=False
    )
    assert told.returncode == 0, told.stderr
    assert "warn" not in told.stderr
    assert {path.name for path in tmp_path.iterdir()} >= {
        "etc",
        "body",
        "proxy",
        "cache",
    }  # all it writes is below -p
