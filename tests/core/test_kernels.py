"""The kernels as such: what they allocate, that both kinds agree, and that C gives the same numbers."""

from __future__ import annotations

import shutil
from dataclasses import replace

import numpy as np
import pytest
from heli2dof_core.simulation.courses import run_experiments
from numba import njit
from numba.core.runtime import _nrt_python, rtsys

from heli2dof_core import Spec, Uncertainty, evaluate, preset
from heli2dof_core.engine import engine, interpreted
from heli2dof_core.kernels.layout import PAPER, WORKSPACE
from heli2dof_core.metrics import step_metrics
from heli2dof_core.robustness import cloud
from heli2dof_core.scenario import Digital
from heli2dof_core.simulation.linear import simulate_linear
from heli2dof_core.simulation.nonlinear import NonlinearLoop, simulate_nonlinear
from tests.bench import floor
from tests.core.test_nonlinear_response import LIMITS, random_loops


def test_no_kernel_allocates():
    """By Numba's own statistics, over everything that calls a kernel."""
    _nrt_python.memsys_enable_stats()
    spec = Spec.from_preset(preset())
    before = rtsys.get_allocation_stats()
    evaluate(spec, each_axis=True)
    evaluate(replace(spec, scenario=replace(spec.scenario, digital=Digital())))
    cloud(spec, Uncertainty(samples=20))
    assert rtsys.get_allocation_stats() == before
    njit(lambda: np.empty(3))()  # what allocates is counted
    assert rtsys.get_allocation_stats().alloc == before.alloc + 1


def test_kernels_do_not_compile_again_for_other_types():
    """Compiling takes seconds and holds Python's lock: better an error, which a test finds."""
    with pytest.raises(TypeError, match="No matching definition"):
        engine().is_stable(np.zeros((2, 2, 20), dtype=np.float32), np.zeros((13, 16)))


def test_compiled_and_interpreted_updates_agree(monkeypatch):
    """All kernels of an update: to rounding, for a compiler may add in another order."""
    spec = Spec.from_preset(preset("quanser-aero-2"))
    compiled = evaluate(spec)
    monkeypatch.setattr("heli2dof_core.engine._ready", [interpreted()])
    slow = evaluate(spec)
    for model, step in compiled.step.items():
        twin = slow.step[model]
        np.testing.assert_allclose(twin.response.angles, step.response.angles, atol=1e-12)
        np.testing.assert_allclose(twin.response.voltages, step.response.voltages, atol=1e-10)
        for axis, metrics in step.metrics.axes.items():
            alike(twin.metrics.axes[axis], metrics)
    alike(slow.sensitivity, compiled.sensitivity)
    for twin, margins in zip(slow.margins, compiled.margins, strict=True):
        alike(twin, margins)


def alike(one, other):
    for name, value in vars(other).items():
        own = getattr(one, name)
        assert own is None if value is None else own == pytest.approx(value, rel=1e-7, abs=1e-12)


def test_both_models_at_once_are_each_alone():
    """The one call of an update gives what the separate simulations give, to the last digit."""
    for loop, scenario in random_loops(40, seed=11):
        scenarios = [scenario, replace(scenario, psi=None), replace(scenario, theta=None)]
        together = run_experiments(loop, LIMITS, scenarios)
        for n, each in enumerate(scenarios):
            for response in (simulate_linear(loop, each), simulate_nonlinear(loop, LIMITS, each)):
                own = together.response(n, response.model)
                np.testing.assert_array_equal(own.states, response.states)
                np.testing.assert_array_equal(own.voltages, response.voltages)
                assert step_metrics(own) == step_metrics(response)
                for name in ("t", "reference", "start", "saturated", "findings"):
                    assert np.all(getattr(own, name) == getattr(response, name))


@pytest.mark.skipif(shutil.which("cc") is None, reason="needs a C compiler")
def test_c_gives_the_same_numbers():
    """So that the benchmarks compare the same method: 30 random loops, most of them saturating."""
    function, t = floor.compiled(), np.linspace(0, 5, 501)
    for loop, scenario in random_loops(30, seed=5):
        system = NonlinearLoop.of(loop, LIMITS, scenario)
        own, other = np.empty((501, 6)), np.empty((501, 6))
        y, modes = system.start.copy(), system.modes.copy()
        _, _, steps, _, _ = engine().integrate(
            PAPER, y, t, system.constants, modes, 1e-6, 1e-7, 400_000, np.empty(WORKSPACE), own
        )
        assert floor.call(function, system, t, other, 1e-6, 1e-7)() == steps
        np.testing.assert_allclose(other, own, atol=1e-8)
