"""All that a user chooses, as one frozen value: what `evaluate` and `place` take."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Annotated, Any, TypeVar

from .checks import require_within
from .couplings import Coupling, Lead, Structure
from .design import FULL_RANK
from .errors import InvalidInputError, within_field
from .estimators import Observer
from .parameters import Parameters
from .placement.method import Weights
from .plant import STEEPEST, plant
from .poles import LARGEST, ZERO, PoleSet
from .presets import DEFAULT, Preset
from .presets import preset as preset_named
from .quantities import Quantity, require_valid
from .rotors import Actuators, AxisFriction, Rotors, actuators
from .scenario import Limits, Measured, Outer, OuterLoop, Pairing, PIGains, Scenario
from .tables import Shown, poles

T = TypeVar("T")


@dataclass(frozen=True, repr=False)
class Spec(Shown):
    """All that a user chooses.

    Attributes:
        parameters, limits, theta_0: the rig and its operating point (rad).
        poles, structure: what full-rank placement shall do.
        method, weights: another placement method, and the weights of a quadratic one.
        outer: the loop around it.
        scenario: the experiment.
        rotors, friction: of the rig as it is; by default as in the paper's model.
        rotor_poles: the poles of the rotors where they are placed, too, pitch's and yaw's, rad/s.
        observer: what estimates the states where `scenario.measured` says so; None is the usual one.
    """

    parameters: Parameters
    limits: Limits
    theta_0: Annotated[
        float, Quantity("pitch angle θ₀ at which the rig rests and is linearized", "rad", -STEEPEST, STEEPEST)
    ]
    poles: PoleSet
    structure: Structure
    outer: OuterLoop
    scenario: Scenario
    method: str = FULL_RANK
    weights: Weights | None = None
    rotors: Rotors = Rotors()
    friction: AxisFriction = AxisFriction()
    place_rotors: Annotated[
        bool,
        Quantity(
            "the rotors' speeds are states of the model that is placed: full rank on six states, K is 2×6"
        ),
    ] = False
    rotor_poles: tuple[float, float] = (-15.0, -16.0)
    observer: Observer | None = None

    def __post_init__(self) -> None:
        require_valid(self)
        if self.weights is not None:
            with within_field("weights"):
                require_valid(self.weights)
        object.__setattr__(self, "rotor_poles", _rotor_poles(self.rotor_poles))

    @classmethod
    def from_preset(cls, preset: Preset | str = DEFAULT, **changes: Any) -> Spec:
        """The preset's own design and scenario, with `changes` as `changed` takes them.

        >>> Spec.from_preset("quanser-2dof-manual", poles=[-4, -5, -3 + 4j, -3 - 4j]).poles
        PoleSet([-4, -5, -3+4j, -3-4j])

        Raises:
            InvalidInputError: there is no preset of that name; or as `changed`.
        """
        own = preset_named(preset) if isinstance(preset, str) else preset
        rig = (own.parameters, own.limits, own.theta_0)
        design = (own.poles, own.structure, own.outer, own.scenario)
        machine = {name: getattr(own, name) for name in ("rotors", "friction", "place_rotors", "rotor_poles")}
        return cls(*rig, *design, **machine).changed(**changes)

    def changed(
        self,
        *,
        poles: PoleSet | Iterable[complex] | None = None,
        method: str | None = None,
        coupling: Coupling | None = None,
        lead: Lead | None = None,
        parameters: Mapping[str, float] | None = None,
        theta_0: float | None = None,
        outer: Outer | None = None,
        pitch: PIGains | tuple[float, float] | None = None,
        yaw: PIGains | tuple[float, float] | None = None,
        pairing: Pairing | None = None,
        decoupler: bool | None = None,
        reference: tuple[float | None, float | None] | None = None,
        duration: float | None = None,
        rotors: Rotors | None = None,
        friction: AxisFriction | None = None,
        place_rotors: bool | None = None,
        rotor_poles: tuple[float, float] | None = None,
        observer: Observer | None = None,
        measured: Measured | None = None,
        weights: Weights | None = None,
    ) -> Spec:
        """The same with some things changed; what is left out stays.

        >>> spec = Spec.from_preset()
        >>> spec.changed(pitch=(10, 0.5), reference=(0.2, None)).outer.pitch
        PIGains(kp=10.0, ti=0.5)

        Args:
            poles: pitch's pair, then yaw's, rad/s.
            method: name in `METHODS`.
            coupling: of the closed loop; a shift of its own is dropped with it.
            lead: the axis that leads where it is triangular; likewise.
            parameters: by name, SI units, as in `Parameters`.
            theta_0: operating point, rad.
            outer: ``pi`` or ``none``.
            pitch: PI gains, or (kp in V/rad, ti in s).
            yaw: the same of the yaw error.
            pairing: as in `OuterLoop`.
            decoupler: as in `OuterLoop`.
            reference: of θ and ψ, rad, absolute; None leaves that axis at rest.
            duration: s.
            rotors: of both motors.
            friction: of both axes.
            place_rotors: as in `Spec`.
            rotor_poles: rad/s, of pitch's rotor and of yaw's.
            observer: as in `Spec`.
            measured: as in `Scenario`.
            weights: of the quadratic methods.

        Raises:
            Heli2DofError: a value is out of its range; its field says which.
        """

        def given(**values: Any) -> dict[str, Any]:
            return {name: value for name, value in values.items() if value is not None}

        def gains(pi: PIGains | tuple[float, float] | None, axis: str) -> PIGains | None:
            if pi is None or isinstance(pi, PIGains):
                return pi
            with within_field(f"outer.{axis}"):
                return PIGains(*_two(pi, "(kp, ti)"))

        structure = given(coupling=coupling, lead=lead)
        loops = given(
            outer=outer,
            pitch=gains(pitch, "pitch"),
            yaw=gains(yaw, "yaw"),
            pairing=pairing,
            decoupler=decoupler,
        )
        scenario = given(duration=duration, measured=measured)
        if reference is not None:
            with within_field("reference"):
                scenario |= zip(("theta", "psi"), _two(reference, "(theta, psi)"), strict=True)

        def part(name: str, changes: dict[str, Any]) -> Any:
            with within_field(name):
                return replace(getattr(self, name), **changes) if changes else None

        rig = None
        if parameters is not None:
            with within_field("parameters"):
                rig = self.parameters.replaced(parameters)
        return replace(
            self,
            **given(
                poles=poles if poles is None or isinstance(poles, PoleSet) else PoleSet(poles),
                method=method,
                structure=part("structure", {**structure, "shift": None} if structure else {}),
                parameters=rig,
                theta_0=theta_0,
                outer=part("outer", loops),
                scenario=part("scenario", scenario),
                rotors=rotors,
                friction=friction,
                place_rotors=place_rotors,
                rotor_poles=rotor_poles,
                observer=observer,
                weights=weights,
            ),
        )

    def with_poles(self, poles: PoleSet) -> Spec:
        """The same with other poles: nothing else is judged again, and what was computed of it is kept."""
        own = object.__new__(Spec)
        vars(own).update(vars(self))
        vars(own)["poles"] = poles
        return own

    @cached_property
    def actuators(self) -> Actuators | None:
        """Rotors and friction as numbers, at the operating point; None where all is as in the paper."""
        if self.rotors == _PAPERS[0] and self.friction == _PAPERS[1]:
            return None
        limits = (self.limits.V_p, self.limits.V_y)
        found = actuators(plant(self.parameters, self.theta_0), self.rotors, self.friction, limits)
        return None if found.plain else found

    def summary(self) -> str:
        """Method, poles and outer loop."""
        return f"{self.method}, {self.structure.coupling}; poles {poles(self.poles.values)} rad/s; {self.outer.outer}"


_PAPERS = Rotors(), AxisFriction()


def _rotor_poles(values: Sequence[complex]) -> tuple[float, float]:
    """Two real poles, each of its axis' triple."""
    if len(values) != 2:
        raise InvalidInputError(
            f"{len(values)} rotor poles given",
            field="rotor_poles",
            value=len(values),
            hint="Give two: pitch's rotor's, then yaw's.",
        )
    found = []
    for i, pole in enumerate(values):
        value = complex(pole)
        if abs(value.imag) >= ZERO:
            raise InvalidInputError(
                f"the rotor pole {value:g} is complex",
                field=f"rotor_poles.{i}",
                value=str(value),
                hint="Make it real: its axis' pair may be complex.",
            )
        found.append(require_within(value.real, f"rotor_poles.{i}", "rad/s", -LARGEST, LARGEST))
    return found[0], found[1]


def _two(values: Sequence[T], what: str) -> Sequence[T]:
    """Both values, or InvalidInputError."""
    if len(values) != 2:
        raise InvalidInputError(f"{tuple(values)!r} are not two values", hint=f"Give two, {what}.")
    return values
