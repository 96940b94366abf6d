"""Results are frozen to their arrays, whichever class holds them; and nothing is compiled while they are made."""

from __future__ import annotations

import inspect
import re
import sys
from collections.abc import Callable, Iterator
from dataclasses import fields, is_dataclass, replace
from functools import cached_property
from importlib import import_module
from pathlib import Path
from pkgutil import walk_packages
from typing import Any

import numpy as np
import pytest
from numba import typeof
from numba.core import event
from scipy.io import savemat
from sympy import MutableDenseMatrix

import heli2dof_core as heli
from heli2dof_core import Digital, Disturbance, Loop, OuterLoop, Spec, Uncertainty
from heli2dof_core.engine import engine
from heli2dof_core.export import FORMATS
from heli2dof_core.finder import Find, find_in_parts
from heli2dof_core.flight import FlightController, FlightLog, Rig, simulate_flight, thin_flight
from heli2dof_core.frozen import Frozen, frozen, read_only
from heli2dof_core.kernels.jit import EXAMPLES
from heli2dof_core.lag_track import lag_track
from heli2dof_core.many import Measure
from heli2dof_core.paper.consequence import consequence
from heli2dof_core.paper.figures import figures
from heli2dof_core.placement.method import Task
from heli2dof_core.recordings.recording import Recording
from heli2dof_core.recordings.samples import sample_recording
from heli2dof_core.root_locus import symmetric_root_locus
from heli2dof_core.study import Alone, Folder, read_study, run, summarize
from heli2dof_core.symbolic.linearization import linear_model
from heli2dof_core.symbolic.mechanics import mechanics
from heli2dof_core.systems.analysis import analyse
from heli2dof_core.systems.courses import courses
from heli2dof_core.systems.frequency import bode
from heli2dof_core.systems.loop import Wish, close_loop
from heli2dof_core.systems.model import System
from heli2dof_core.walkthrough import walk_through
from heli2dof_core.walkthrough_beyond import observer_steps, rotor_steps
from heli2dof_core.weights import bryson_weights
from tests.core.recorded_run import RUN

SPEC = Spec.from_preset(heli.preset())
for module in walk_packages(heli.__path__, "heli2dof_core."):
    import_module(module.name)


def subclasses(kind: type) -> Iterator[type]:
    for own in kind.__subclasses__():
        yield own
        yield from subclasses(own)


def dataclasses_of_the_core() -> dict[str, type]:
    found = {}
    for module in walk_packages(heli.__path__, "heli2dof_core."):
        for name, kind in inspect.getmembers(import_module(module.name), inspect.isclass):
            if is_dataclass(kind) and kind.__module__ == module.name:
                found[f"{module.name}.{name}"] = kind
    return found


def test_every_frozen_dataclass_with_arrays_freezes_them():
    """Told by the types of its fields, so that a new class is told, too."""
    arrays = re.compile(r"\b(Floats|Complexes|NDArray|ndarray|ArrayLike)\b")
    holding = [
        name
        for name, kind in dataclasses_of_the_core().items()
        if kind.__dataclass_params__.frozen
        and any(arrays.search(str(f.type)) and "Callable" not in str(f.type) for f in fields(kind))
    ]
    assert len(holding) > 20
    assert [name for name in holding if not issubclass(dataclasses_of_the_core()[name], Frozen)] == []


def evaluations() -> Iterator[Any]:
    """Every way in which an update is computed."""
    scenario = SPEC.scenario
    for spec in (
        SPEC,
        replace(SPEC, outer=OuterLoop("none")),
        replace(SPEC, method="lqr-integral"),
        replace(SPEC, scenario=replace(scenario, digital=Digital(noise=1e-3))),
        replace(SPEC, scenario=replace(scenario, disturbance=Disturbance(1.0, 0.0, 1.0))),
        replace(SPEC, outer=OuterLoop(pairing="cross", decoupler=True)),
    ):
        report = heli.evaluate(spec, each_axis=True)
        yield report
        for model in ("linear", "nonlinear"):
            yield heli.simulate(report.loop, spec, model)
        yield walk_through(report.design)
        yield rotor_steps(spec)
        yield observer_steps(spec)
    yield heli.cloud(SPEC, Uncertainty(samples=40))


def recordings(folder: Path) -> Iterator[Any]:
    """What is made of recordings, synthetic and read."""
    savemat(folder / "run.mat", RUN)
    yield heli.read_recording(folder / "run.mat")
    loop = heli.close_loop(heli.place(SPEC), SPEC.outer)
    recording = synthetic(loop)
    yield recording
    yield heli.driven_by_voltages(SPEC.parameters, recording)
    yield heli.driven_in_segments(SPEC.parameters, recording)
    yield heli.driven_by_references(loop, SPEC.limits, recording)
    yield heli.identify(SPEC.parameters, recording, ("K_pp", "B_p"))
    yield heli.identify(
        SPEC.parameters, recording, ("K_pp",), heli.Rotors(heli.Rotor(0.05), heli.Rotor(0.05))
    )


def flights() -> Iterator[Any]:
    """What a rig in hand has flown, and what is made of a flight's log."""
    yield Rig(SPEC).fly(0.1)
    log = FlightLog({}, 100, ((0, "push", 0.01, 0.0),))
    yield FlightController.of(SPEC)
    yield simulate_flight(log)
    yield thin_flight(log, 10)


def synthetic(loop: Loop) -> Recording:
    run = sample_recording(loop, SPEC.limits, Digital(), rig=SPEC.parameters, duration=4.0, size=(0.1, 0.2))
    return Recording(run.t, run.measured, run.voltages, run.references)


def everything_else() -> Iterator[Any]:
    """Comparisons, placements by every method, files, the paper."""
    yield heli.compare(SPEC)
    yield heli.compare_splits(SPEC)
    A, B = np.diag([1.0, 2.0, -1.0], 1), np.array([[0.0, 1.0], [0.0, 0.0], [1.0, 0.5], [0.0, 1.0]])
    yield heli.suggest_pi(heli.place(SPEC))
    lagged = SPEC.changed(rotors=heli.Rotors(heli.Rotor(0.1), heli.Rotor(0.1)), measured="observer")
    yield lag_track(heli.loop_of(lagged.changed(place_rotors=True))), heli.loop_of(lagged).padded
    yield heli.design_map(SPEC, "yaw-pair", "norm", size=(3, 2))
    yield heli.track(lagged, "gain", (0.0, 2.0), 5), heli.place(lagged)
    yield heli.nearest(SPEC, {"settling_time": {"max": 0.8}}, free=("yaw-pair",))
    yield [*find_in_parts(SPEC, Find(("poles",), minimize=(Measure("norm"),), designs=200))]
    yield symmetric_root_locus(heli.place(SPEC.changed(method="lqr")), bryson_weights(SPEC.limits))
    for name in heli.METHODS:
        C = np.eye(1, 4) if name == "lqr-integral" else None
        yield heli.place_poles(A, B, [-4, -5, -6, -7], name, C=C)
    for form in FORMATS.values():
        yield form.render(SPEC)
    system = System.of(A, B, np.eye(1, 4))
    closed = close_loop(system, Wish((-4, -5, -6, -7), observer_poles=(-8, -9, -10, -11)))
    yield analyse(system), closed, courses(closed), bode(analyse(system), closed)
    yield figures()
    yield consequence()
    yield linear_model(), mechanics(), heli.formulas()


def a_study(folder: Path) -> Any:
    study = Folder(folder / "study", read_study('study = 1\nmeasures = ["overshoot"]\n[rigs]\ncount = 3\n'))
    run(study, Alone())
    return summarize(study)


@pytest.fixture
def made(monkeypatch: pytest.MonkeyPatch) -> list[Frozen]:
    """All instances of `Frozen` that are made, those inside of a computation among them."""
    found: list[Frozen] = []

    def noting(own: Callable[[Any], None]) -> Callable[[Any], None]:
        def noted(self: Any) -> None:
            own(self)
            found.append(self)

        return noted

    for kind in {Frozen, *subclasses(Frozen)}:
        if "__post_init__" in vars(kind):
            monkeypatch.setattr(kind, "__post_init__", noting(kind.__post_init__))
    forget()
    return found


def forget() -> None:
    """Empties the core's caches, so that results are made here, whatever other tests have asked for."""
    slow = ("symbolic", "compiled", "formulas", "kernels", "interpreted", "engine")  # they hold no results
    for name, module in [*sys.modules.items()]:
        if name.startswith("heli2dof_core.") and name.split(".")[1] not in slow:
            for known in vars(module).values():
                if callable(getattr(known, "cache_clear", None)):
                    known.cache_clear()


def parts(thing: Any) -> Iterator[tuple[str, Any]]:
    """What a container or a result holds, its properties included."""
    if isinstance(thing, dict):
        yield from ((f"[{key!r}]", part) for key, part in thing.items())
    elif isinstance(thing, (tuple, list)):
        yield from ((f"[{i}]", part) for i, part in enumerate(thing))
    elif is_dataclass(thing) and type(thing).__module__.startswith("heli2dof_core"):
        kinds = inspect.getmembers(type(thing))
        names = [f.name for f in fields(thing) if not f.name.startswith("_")]
        for name in (*names, *(name for name, kind in kinds if isinstance(kind, cached_property))):
            yield f".{name}", getattr(thing, name)
        for name in (name for name, kind in kinds if isinstance(kind, property)):
            first, second = getattr(thing, name), getattr(thing, name)
            # an array that is made anew each time may be changed: no result has it
            if isinstance(first, np.ndarray) and np.shares_memory(first, second):
                yield f".{name}", first


def writable(thing: Any, path: str, seen: dict[int, Any]) -> Iterator[str]:
    """Where below a result an array can be written to."""
    if id(thing) in seen:
        return
    seen[id(thing)] = thing  # kept, so that no other thing gets its number
    if (isinstance(thing, np.ndarray) and thing.flags.writeable) or isinstance(thing, MutableDenseMatrix):
        yield path
    for name, part in parts(thing):
        yield from writable(part, path + name, seen)


@pytest.mark.slow
def test_no_array_of_a_result_can_be_written_to(made: list[Frozen], tmp_path: Path):
    results = [*evaluations(), *recordings(tmp_path), *everything_else(), heli.PRESETS, heli.METHODS]
    results += flights()
    results.append(a_study(tmp_path))
    seen: dict[int, Any] = {}
    assert list(writable(results, "results", seen)) == []
    few: dict[type, list[Frozen]] = {}
    for thing in made:
        few.setdefault(type(thing), []).append(thing)
    for kind, instances in few.items():
        assert list(writable([*instances[:20], instances[-1]], kind.__name__, seen)) == []
    assert {kind for kind in subclasses(Frozen) if kind not in few} == set()  # else show here how it is made


def test_nothing_compiles_while_results_are_made(tmp_path: Path):
    """Numba says when it does; the kernels would take some twenty seconds."""
    kernels = [kernel for kernel in vars(engine()).values() if hasattr(kernel, "signatures")]
    assert len(kernels) > 10 and engine().compiled

    compiled: list[str] = []

    class Noting(event.Listener):
        def on_start(self, event: Any) -> None:
            compiled.append(event.data["dispatcher"].__name__)

        def on_end(self, event: Any) -> None:
            pass

    with event.install_listener("numba:compile", Noting()):
        assert list(evaluations()) and list(recordings(tmp_path))
    assert compiled == []
    made = {name: len({tuple(map(typeof, own())) for own in examples}) for name, examples in EXAMPLES.items()}
    assert {k.__name__: len(k.signatures) for k in kernels} == made


def test_a_callers_own_arrays_stay_writable():
    A, B, poles, C = np.eye(4), np.ones((4, 2)), np.array([-1 + 0j] * 4), np.eye(2, 4)
    t, angles, volts = np.arange(3.0), np.zeros((3, 2)), np.ones((3, 2))
    task, recording = Task(A, B, poles, C), Recording(t, angles, volts)
    for array in (A, B, poles, C, t, angles, volts):
        array[...] = 7.0
    assert task.A[0, 1] == 0.0 and task.poles[0] == -1 and recording.t[1] == 1.0
    assert not recording.angles.any() and not recording.angles.flags.writeable
    assert replace(recording, findings=()).t is recording.t  # read-only arrays are not copied again


def test_freezing_reaches_into_containers():
    arrays = [np.zeros(2) for _ in range(4)]
    whole = frozen({"a": arrays[0], "b": (arrays[1], [arrays[2], {"c": arrays[3]}], None, 1.0)})
    assert whole["a"] is arrays[0] and not any(array.flags.writeable for array in arrays)
    assert read_only(arrays[0]) is arrays[0]
    with pytest.raises(ValueError, match="read-only"):
        arrays[3][0] = 1.0
