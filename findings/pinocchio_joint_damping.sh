#!/bin/sh
# Pinocchio: a URDF's joint damping is read, kept in the model, and not used by the forward dynamics.
#
# One expects: aba(model, data, q, v, tau) includes the damping that <dynamics damping="…"/> gives and model.damping
#   holds.
# What happens: model.damping is 3, and a joint of inertia 2 that turns at 1 rad/s without torque has the acceleration
#   0, not −1.5. The damping has to be put into tau by hand: aba(…, tau − model.damping * v) (friction likewise).
# Seen with: pin 4.1.0, numpy 2.4.6.
# Why it matters: a helicopter rig's damping is what gives its poles −B/J; simulated with Pinocchio from its URDF it
#   has double integrators instead, and a controller tuned there is tuned for another machine.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet pin==4.1.0 numpy==2.4.6
cat > "$folder/rig.urdf" <<'EOF'
<robot name="rig"><link name="base"/>
  <link name="arm"><inertial><mass value="1"/>
    <inertia ixx="2" iyy="2" izz="2" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="yaw" type="continuous"><parent link="base"/><child link="arm"/>
    <axis xyz="0 0 1"/><dynamics damping="3" friction="0"/></joint>
</robot>
EOF
"$folder/venv/bin/python" - "$folder/rig.urdf" <<'EOF'
import sys

import numpy as np
import pinocchio as pin

model = pin.buildModelFromUrdf(sys.argv[1])
data, q, v = model.createData(), pin.neutral(model), np.ones(1)
coasting = pin.aba(model, data, q, v, np.zeros(1))[0]
by_hand = pin.aba(model, data, q, v, -np.asarray(model.damping) * v)[0]
print("pinocchio", pin.__version__, "damping", model.damping, "acceleration", coasting, "with damping by hand", by_hand)
assert float(model.damping[0]) == 3.0
assert coasting == 0.0
assert np.isclose(by_hand, -1.5)
EOF
