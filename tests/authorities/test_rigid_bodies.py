"""The rig's accelerations and energies against MuJoCo and Pinocchio, which know it as two bodies on hinges.

A yawing body (hinge −z) carries a pitching one (hinge −y), and that a point mass m at l. What turns without moving
the mass has the same inertia J about all its axes, so that pitch does not change how it turns in yaw; what is left of
J_p and J_y is armature of the hinges. Both engines' joints have no motors here: K φ(v) and Coulomb friction, while an
axis slips, are generalized forces; in MuJoCo friction is also its own `frictionloss`. That is a soft constraint, by
default less than F_c, or even driving the axis, at rates below some hundredths of the acceleration: hence stiff.
"""

from __future__ import annotations

from types import SimpleNamespace

import mujoco
import numpy as np
import pinocchio as pin
import pytest
import sympy as sp

from heli2dof_core import PRESETS
from heli2dof_core.compiled import PARAMETER_ORDER, accelerations
from heli2dof_core.interpreted import actuated, rig
from heli2dof_core.kernels.layout import BREAKAWAY, COULOMB, DEAD, MORE_CONSTANTS, SQUARE
from heli2dof_core.plant import rig_constants
from heli2dof_core.symbolic import names
from heli2dof_core.symbolic.mechanics import mechanics

RIGS, STATES = 50, 20
MJCF = """
<mujoco>
  <option gravity="0 0 {down}"><flag energy="enable" contact="disable"/></option>
  <worldbody>
    <body name="yawing">
      <inertial pos="0 0 0" mass="1" diaginertia="{half} {half} {half}"/>
      <joint name="psi" type="hinge" axis="0 0 -1" damping="{B_y}" armature="{more_y}" frictionloss="{F_y}"
        solreffriction="-1 -1e9"/>
      <body name="pitching">
        <inertial pos="0 0 0" mass="1" diaginertia="{half} {half} {half}"/>
        <joint name="theta" type="hinge" axis="0 -1 0" damping="{B_p}" stiffness="{K_s}" armature="{more_p}"
          frictionloss="{F_p}" solreffriction="-1 -1e9"/>
        {point}
      </body>
    </body>
  </worldbody>
</mujoco>
"""
POINT = '<body pos="{l} 0 0"><inertial pos="0 0 0" mass="{m}" diaginertia="1e-20 1e-20 1e-20"/></body>'


def shared_inertia(p):
    """J of either turning body, and the armatures: J_p = J + more_p, J_y = 2 J + more_y."""
    half = 0.4 * min(p["J_p"], p["J_y"])
    return half, p["J_p"] - half, p["J_y"] - 2 * half


class Mujoco:
    def __init__(self, p, friction=(0.0, 0.0)):
        half, more_p, more_y = shared_inertia(p)
        text = {name: repr(float(value)) for name, value in p.items()}
        point = POINT.format(**text) if p["m"] > 0 else ""
        numbers = {"half": half, "more_p": more_p, "more_y": more_y, "down": -p["g"]}
        numbers |= {"F_p": friction[0], "F_y": friction[1]}
        text |= {name: repr(float(value)) for name, value in numbers.items()}
        self.model = mujoco.MjModel.from_xml_string(MJCF.format(point=point, **text))
        self.data = mujoco.MjData(self.model)

    def accelerations(self, x, torques):
        theta, psi, theta_dot, psi_dot = x
        self.data.qpos[:], self.data.qvel[:] = (psi, theta), (psi_dot, theta_dot)
        self.data.qfrc_applied[:] = torques[::-1]
        mujoco.mj_forward(self.model, self.data)
        return self.data.qacc[::-1]

    def energies(self, x):
        self.accelerations(x, np.zeros(2))
        return self.data.energy[1], self.data.energy[0]


class Pinocchio:
    def __init__(self, p):
        half, more_p, more_y = shared_inertia(p)
        turning = pin.Inertia(1.0, np.zeros(3), half * np.eye(3))
        self.model, self.p = pin.Model(), p
        self.model.gravity.linear = np.array([0, 0, -p["g"]])
        place = pin.SE3.Identity()
        psi = self.model.addJoint(0, pin.JointModelRevoluteUnaligned(0.0, 0.0, -1.0), place, "psi")
        theta = self.model.addJoint(psi, pin.JointModelRevoluteUnaligned(0.0, -1.0, 0.0), place, "theta")
        self.model.appendBodyToJoint(psi, turning, place)
        self.model.appendBodyToJoint(theta, turning, place)
        point = pin.Inertia(p["m"], np.array([p["l"], 0, 0]), np.zeros((3, 3)))
        self.model.appendBodyToJoint(theta, point, place)
        self.model.armature = np.array([more_y, more_p])
        self.data = self.model.createData()

    def accelerations(self, x, torques):
        """Its forward dynamics know neither damping nor stiffness."""
        theta, psi, theta_dot, psi_dot = x
        p, q, v = self.p, np.array([psi, theta]), np.array([psi_dot, theta_dot])
        passive = np.array([p["B_y"] * psi_dot, p["B_p"] * theta_dot + p["K_s"] * theta])
        return pin.aba(self.model, self.data, q, v, torques[::-1] - passive)[::-1]

    def energies(self, x):
        theta, psi, theta_dot, psi_dot = x
        q, v = np.array([psi, theta]), np.array([psi_dot, theta_dot])
        kinetic = pin.computeKineticEnergy(self.model, self.data, q, v)
        kinetic += 0.5 * v @ (self.model.armature * v)  # which its own leaves out
        return kinetic, pin.computePotentialEnergy(self.model, self.data, q) + 0.5 * self.p["K_s"] * theta**2


def random_rigs(seed):
    """Parameters of every preset, each off by up to half; K_s also where the preset has none."""
    rng, presets = np.random.default_rng(seed), [*PRESETS.values()]
    for i in range(RIGS):
        p = {n: v * rng.uniform(0.5, 1.5) for n, v in presets[i % len(presets)].parameters.as_dict().items()}
        if rng.random() < 0.5:
            p["K_s"] += rng.uniform(0, 0.1)
        yield p, rng


def random_states(rng):
    """θ, ψ, their rates, and voltages or rotor speeds."""
    for _ in range(STATES):
        yield rng.uniform([-1.3, -3, -3, -6], [1.3, 3, 3, 6]), rng.uniform(-24, 24, 2)


def thrust_matrix(p):
    return np.array([[p["K_pp"], p["K_py"]], [p["K_yp"], p["K_yy"]]])


def same(found, wanted):
    """1e-9 relative, each axis by itself; 1e-9 rad/s² where a sum cancels."""
    np.testing.assert_allclose(found, wanted, rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize("engine", [Mujoco, Pinocchio])
def test_accelerations_are_a_rigid_body_engines(engine):
    """1,000 states of 50 rigs: the derivation, and the kernel that is typed by hand."""
    for p, rng in random_rigs(1):
        other, constants = engine(p), np.zeros(MORE_CONSTANTS)
        constants[:11] = rig_constants(SimpleNamespace(alpha=p["J_p"] + p["m"] * p["l"] ** 2, **p))
        for x, volts in random_states(rng):
            theirs = other.accelerations(x, thrust_matrix(p) @ volts)
            same(accelerations()(x[0], x[2], x[3], *volts, *(p[name] for name in PARAMETER_ORDER)), theirs)
            same(rig.accelerations(x[0], x[2], x[3], *volts, constants), theirs)


@pytest.mark.parametrize("engine", [Mujoco, Pinocchio])
def test_energies_are_a_rigid_body_engines(engine):
    model = mechanics()
    arguments = [names.theta, names.psi, names.theta_dot, names.psi_dot, *names.PARAMETERS.values()]
    ours = sp.lambdify(arguments, [model.kinetic, model.potential], "math")
    for p, rng in random_rigs(2):
        other = engine(p)
        for x, _ in random_states(rng):
            own = ours(*x, *(p[name] for name in PARAMETER_ORDER))
            np.testing.assert_allclose(other.energies(x), own, rtol=1e-9, atol=1e-12)


@pytest.mark.parametrize("engine", ["mujoco, friction of its joints", "mujoco", "pinocchio"])
def test_thrust_by_rotor_speed_and_friction_act_as_forces(engine):
    """Quadratic curves with dead zones, one in three speeds within them; both axes slip."""
    work, drive, out = np.zeros((1, 4)), np.zeros(4), np.zeros((1, 4))
    for p, rng in random_rigs(3):
        dead, square = rng.uniform(0, 8, 2), rng.uniform(0.02, 0.2, 2)
        friction = rng.uniform(0, 0.1, 2) * np.array([p["K_pp"], p["K_yy"]])
        c = np.zeros(MORE_CONSTANTS)
        c[:11] = rig_constants(SimpleNamespace(alpha=p["J_p"] + p["m"] * p["l"] ** 2, **p))
        for at, values in ((DEAD, dead), (SQUARE, square), (COULOMB, friction), (BREAKAWAY, friction)):
            c[at : at + 2] = values
        own = engine.endswith("joints")
        other = Pinocchio(p) if engine == "pinocchio" else Mujoco(p, np.abs(friction) if own else (0.0, 0.0))
        for x, speeds in random_states(rng):
            sides = np.sign(x[2:])
            torques = thrust_matrix(p) @ (
                np.sign(speeds) * square * np.maximum(np.abs(speeds) - dead, 0) ** 2
            )
            theirs = other.accelerations(x, torques if own else torques - friction * sides)
            work[0] = x
            actuated.thrust(0.0, speeds, speeds, np.zeros(2), c, drive)
            actuated.rates(work, drive, sides, c, 1, out)
            same(out[0, 2:], theirs)
