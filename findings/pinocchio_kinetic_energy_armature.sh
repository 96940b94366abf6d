#!/bin/sh
# Pinocchio: computeKineticEnergy leaves out the armature that the mass matrix and the forward dynamics include.
#
# One expects: computeKineticEnergy(model, data, q, v) is ½ vᵀ M(q) v with the M of crba(model, data, q), and its rate
#   is the power of the torques that aba was given.
# What happens: model.armature (rotor inertias, a URDF's or MJCF's) is in crba and aba, not in the energy. A body of
#   inertia 2 on a hinge with armature 3, at 1 rad/s: M = 5, ½ vᵀMv = 2.5, computeKineticEnergy 1. A torque of 5
#   accelerates it by 1 rad/s², power 5, while the energy told grows by 2.
# Seen with: pin 4.1.0, numpy 2.4.6.
# Why it matters: a check that energy is conserved, or a controller that shapes it (swing-up, passivity), fails for a
#   rig with geared or heavy rotors. Use ½ vᵀMv, or add ½ Σ armature v².
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet pin==4.1.0 numpy==2.4.6
"$folder/venv/bin/python" - <<'EOP'
import numpy as np
import pinocchio as pin

model = pin.Model()
joint = model.addJoint(0, pin.JointModelRZ(), pin.SE3.Identity(), "yaw")
model.appendBodyToJoint(joint, pin.Inertia(1.0, np.zeros(3), 2.0 * np.eye(3)), pin.SE3.Identity())
model.armature = np.array([3.0])
data, q, v = model.createData(), pin.neutral(model), np.ones(1)
M = pin.crba(model, data, q)[0, 0]
acceleration = pin.aba(model, data, q, v, np.array([5.0]))[0]
told = pin.computeKineticEnergy(model, data, q, v)
print("pinocchio", pin.__version__, "M", M, "acceleration", acceleration, "energy", told, "½ M v²", 0.5 * M)
assert np.isclose(M, 5.0) and np.isclose(acceleration, 1.0)
assert np.isclose(told, 1.0)
EOP
