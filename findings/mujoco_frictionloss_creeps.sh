#!/bin/sh
# MuJoCo: a joint's frictionloss is no Coulomb friction near rest: it creeps when it should stick, and may push along.
#
# One expects: <joint frictionloss="0.02"/> holds a joint at rest against 0.01 N·m, and while the joint turns forward
#   its friction is −0.02 N·m, whatever else acts.
# What happens: it is a soft constraint with the time constant 0.02 s (solreffriction). (1) Under half its frictionloss
#   the joint, of inertia 0.05, turns at a steady 0.2 mrad/s: 2 mrad, more than an encoder count, in 10 s. (2) At +1
#   mrad/s under a braking torque of −0.03 N·m the friction is +0.02: it acts along the motion, since the constraint
#   looks ahead to the rest that comes. From some hundredths of the acceleration on in rate it is −0.02, to the digit.
# Seen with: mujoco 4.0.0, numpy 2.4.6, default options.
# Why it matters: an axis that stiction holds off its reference is what friction does to a rig's PI loop (stick, then
#   hunting); in the simulation it slides there, and friction fitted to recordings with small rates comes out wrong.
#   solreffriction="-1 -1e9" makes it stiff.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet mujoco==4.0.0 numpy==2.4.6
"$folder/venv/bin/python" - <<'EOP'
import mujoco
import numpy as np

RIG = """<mujoco><option gravity="0 0 0"/><worldbody><body>
  <inertial pos="0 0 0" mass="1" diaginertia="0.05 0.05 0.05"/>
  <joint type="hinge" axis="0 0 1" frictionloss="0.02" {more}/></body></worldbody></mujoco>"""


def rig(more=""):
    model = mujoco.MjModel.from_xml_string(RIG.format(more=more))
    return model, mujoco.MjData(model)


def friction(rate, torque, more=""):
    model, data = rig(more)
    data.qvel[:], data.qfrc_applied[:] = rate, torque
    mujoco.mj_forward(model, data)
    return float(data.qfrc_constraint[0])


model, data = rig()
data.qfrc_applied[:] = 0.01
while data.time < 10:
    mujoco.mj_step(model, data)
stiff = friction(1e-3, -0.03, 'solreffriction="-1 -1e9"')
print("mujoco", mujoco.__version__, "after 10 s under half the frictionloss:", data.qpos[0], "rad,", data.qvel[0], "rad/s")
print("friction at +1 mrad/s, braked:", friction(1e-3, -0.03), "stiff:", stiff, "and at +1 rad/s:", friction(1.0, -0.03))
assert 1.5e-3 < data.qpos[0] < 3e-3
assert friction(1e-3, -0.03) > 0.019
assert np.isclose(stiff, -0.02) and np.isclose(friction(1.0, -0.03), -0.02)
EOP
