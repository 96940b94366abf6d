"""Replies of the machine over HTTP: rotors, observer and lag margin where they are on, nothing where not."""

from __future__ import annotations

import numpy as np
import pytest

from tests.app.test_rest import PAPER, poles, post

ROTORS = {"pitch": {"tau": 0.05}, "yaw": {"tau": 0.08}}
OBSERVED = {"observer": {"poles": [-30, -32, -31, -33]}, "scenario": {"measured": "observer"}}


@pytest.mark.parametrize("call", ["step", "evaluate"])
def test_replies_of_the_machine_hold_what_is_on_and_nothing_else(client, call):
    """The observer's L, 4×2, puts A − LC's eigenvalues where it says; lag margin, rotors' speeds."""
    gains = post(client, "gains", {**PAPER, "rotors": ROTORS, "observer": OBSERVED["observer"]})
    whole = post(client, call, {**PAPER, "rotors": ROTORS, **OBSERVED})
    observer, L = whole["observer"], np.array(whole["observer"]["L"])
    A = np.array(gains["A"])[:4, :4]
    assert L.shape == (4, 2)
    found = np.sort(np.linalg.eigvals(A - L @ np.eye(2, 4)).real)
    np.testing.assert_allclose(found, [-33, -32, -31, -30], atol=1e-6)
    np.testing.assert_allclose(sorted(p.real for p in poles(observer["poles"])), found, atol=1e-6)
    assert gains["observer"]["L"] == observer["L"] and 0 < whole["lag_margin"] != gains["lag_margin"]
    step = whole["step"]["nonlinear"] if call == "evaluate" else whole
    assert set(step["rotors"]) == {"v_p", "v_y"} and len(step["rotors"]["v_p"]) == len(step["t"])
    t, V, v = (np.array(values) for values in (step["t"], step["V_p"], step["rotors"]["v_p"]))
    middle = (V[2:] + V[:-2]) / 2 - (v[2:] + v[:-2]) / 2
    slopes = (v[2:] - v[:-2]) / (t[2:] - t[:-2])
    np.testing.assert_allclose(
        0.05 * slopes[20:], middle[20:], atol=0.05 * np.max(np.abs(middle))
    )  # τ v̇ = V − v
    plain = post(client, call, PAPER)
    step = plain["step"]["nonlinear"] if call == "evaluate" else plain
    assert (
        "rotors" not in step and "observer" not in plain and "rotor_poles" not in post(client, "gains", PAPER)
    )
    assert plain["lag_margin"] == pytest.approx(0.16481, abs=1e-5)


def test_an_unlimited_lag_margin_is_left_out_and_told(client):
    body = {"poles": [-0.4412, -0.1094, -0.07397, -1.229], "outer": "none"}
    reply = post(client, "evaluate", body)
    assert "lag_margin" not in reply and "lag_margin" not in reply["gains"]
    assert "lag_unlimited" in {finding["code"] for finding in reply["findings"]}
