"""A typed client of heli2dof's REST API, on httpx2 alone.

heli2dof serve &
python examples/client.py http://127.0.0.1:8000
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import dataclass
from types import TracebackType
from typing import Any, Self, TypedDict

import httpx2

Matrix = list[list[float]]


class Gains(TypedDict):
    """What `POST gains` replies, the parts used here."""

    K: Matrix
    closed_loop_poles: list[dict[str, float]]
    norm: float


class Response(TypedDict):
    """What `POST step` replies, the parts used here: s, rad, V."""

    t: list[float]
    theta: list[float]
    psi: list[float]
    V_p: list[float]
    V_y: list[float]
    metrics: dict[str, Any]
    stable: bool


@dataclass
class RefusedError(Exception):
    """The server's problem object (RFC 9457): which field, what is wrong, what to do."""

    status: int
    field: str
    detail: str
    hint: str

    def __str__(self) -> str:
        return " ".join(filter(None, (self.detail, self.hint)))


class Client:
    """One server; a context manager."""

    def __init__(self, address: str, timeout: float = 30.0) -> None:
        self._http = httpx2.Client(base_url=f"{address.rstrip('/')}/api/v1/", timeout=timeout)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, _kind: type[BaseException] | None, _error: BaseException | None, _trace: TracebackType | None
    ) -> None:
        self._http.close()

    def presets(self) -> list[str]:
        """Names of the rigs, the default one first."""
        return [preset["name"] for preset in self._reply(self._http.get("presets"))]

    def gains(self, poles: Sequence[complex], **design: Any) -> Gains:
        """K of u = −Kx + v and the poles that it gives; `design` are further fields of the request."""
        return self._call("gains", {"poles": _poles(poles), **design})

    def rga(self, poles: Sequence[complex], **design: Any) -> Matrix:
        """The relative gain array at s = 0."""
        return self._call("rga", {"poles": _poles(poles), **design})["rga"]

    def step(self, poles: Sequence[complex], theta: float, duration: float = 3.0, **design: Any) -> Response:
        """A step of `theta` rad in pitch on the nonlinear rig."""
        scenario = {"reference": {"theta": theta}, "duration": duration}
        return self._call("step", {"poles": _poles(poles), "scenario": scenario, **design})

    def _call(self, name: str, body: dict[str, Any]) -> Any:
        return self._reply(self._http.post(name, json=body))

    def _reply(self, reply: httpx2.Response) -> Any:
        if reply.headers.get("content-type") == "application/problem+json":
            problem = reply.json()
            raise RefusedError(
                reply.status_code, problem.get("field", ""), problem["detail"], problem.get("hint", "")
            )
        return reply.raise_for_status().json()


def _poles(poles: Sequence[complex]) -> list[dict[str, float]]:
    return [{"re": complex(p).real, "im": complex(p).imag} for p in poles]


def main(address: str) -> None:
    """Prints K and how a pitch step settles, for each rig."""
    with Client(address) as heli:
        for preset in heli.presets():
            poles = [-4, -5, -3 + 2j, -3 - 2j]
            gains = heli.gains(poles, preset=preset)
            step = heli.step(poles, theta=0.1, preset=preset)
            pitch = step["metrics"]["theta"]
            settling = f"settles in {pitch['settling_time']:.3g} s" if pitch["settled"] else "not settled"
            print(f"{preset}: ‖K‖ = {gains['norm']:.1f}, {settling}, stable: {step['stable']}")


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "http://127.0.0.1:8000")
