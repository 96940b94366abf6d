"""K of the six states, those of both rotors among them, in closed form.

Made of the derivation by `python -m tests.kernel_formulas`; not to be changed by hand.

Arguments are p, the parameters in the order of `parameters.PARAMETER_INFO`; theta_0, rad; d, the coefficients of the
desired polynomials, d₁₀, d₁₁ …, d₂₀, d₂₁ …, the leading 1 left out; c, the basis' shift, where `shifted`; `family`,
where a structure stands in `couplings.STRUCTURES`; tau, both rotors'
time constants, s. A division by zero gives an infinity or NaN: callers look
whether all is finite.
"""

from __future__ import annotations

from .derived import entries
from .jit import kernel


@kernel
def full_rank_gain_with_rotors(family, shifted, d, p, theta_0, tau, c, K, inverse):
    """K, 2×6, and Ĝ(0)⁻¹, 2×2, of six states; thrust constants in p are times the curves' slopes φ′."""
    rig = entries(p, theta_0)
    if family == 0:
        if shifted:
            pitch_leads_shifted(rig, d, tau, c, K, inverse)
        else:
            pitch_leads(rig, d, tau, K, inverse)
    elif family == 1:
        if shifted:
            yaw_leads_shifted(rig, d, tau, c, K, inverse)
        else:
            yaw_leads(rig, d, tau, K, inverse)
    elif family == 2:
        input_diagonal_shifted(rig, d, tau, c if shifted else 0.0, K, inverse)
    elif family == 3:
        axis_decoupled(rig, d, tau, K, inverse)


@kernel
def pitch_leads(rig, d, tau, K, inverse):
    """Triangular, pitch leads; rig as `entries` gives it."""
    a, b_11, b_12, b_21, nu_p, nu_y = rig[0], rig[1], rig[2], rig[3], rig[5], rig[6]
    Delta = rig[7]
    d_10, d_11, d_12, d_20, d_21, d_22 = d[0], d[1], d[2], d[3], d[4], d[5]
    tau_p, tau_y = tau[0], tau[1]
    x_1 = d_12 - nu_p
    x_2 = tau_p / b_11
    x_3 = 1.0 / tau_y
    x_4 = -d_22 + nu_y
    x_5 = x_3 + x_4
    x_6 = -a * x_5 + d_20
    x_7 = b_12 * x_2
    x_8 = 1.0 / Delta
    x_9 = b_21 * x_8
    x_10 = x_7 * x_9
    x_11 = d_20 * x_8
    x_12 = b_12 * tau_p
    x_13 = -x_11 * x_12
    x_14 = d_21 + nu_p * x_5 - nu_y * x_3
    x_15 = x_8 * (d_21 - d_22 * nu_y + (nu_y * nu_y))
    x_16 = tau_y * x_9
    x_17 = b_11 * tau_y
    x_18 = x_11 * x_17
    x_19 = -a * x_3 + d_20
    K[0, 0] = x_10 * x_6 + x_2 * (a * x_1 + d_10)
    K[0, 1] = x_13
    K[0, 2] = x_10 * x_14 + x_2 * (a + d_11 - d_12 * nu_p + (nu_p * nu_p))
    K[0, 3] = -x_12 * x_15
    K[0, 4] = tau_p * (d_12 - nu_p - 1.0 / tau_p)
    K[0, 5] = x_7 * (x_1 + x_4)
    K[1, 0] = -x_16 * x_6
    K[1, 1] = x_18
    K[1, 2] = -x_14 * x_16
    K[1, 3] = x_15 * x_17
    K[1, 4] = 0.0
    K[1, 5] = -tau_y * x_5
    inverse[0, 0] = d_10 * x_2 + x_10 * x_19
    inverse[0, 1] = x_13
    inverse[1, 0] = -x_16 * x_19
    inverse[1, 1] = x_18


@kernel
def pitch_leads_shifted(rig, d, tau, c, K, inverse):
    """Triangular, pitch leads, with a shift; rig as `entries` gives it."""
    a, b_11, b_12, b_21, b_22, nu_p = rig[0], rig[1], rig[2], rig[3], rig[4], rig[5]
    nu_y, Delta = rig[6], rig[7]
    d_10, d_11, d_12, d_20, d_21, d_22 = d[0], d[1], d[2], d[3], d[4], d[5]
    tau_p, tau_y = tau[0], tau[1]
    x_1 = 1.0 / Delta
    x_2 = d_12 - nu_p
    x_3 = 1.0 / tau_y
    x_4 = nu_y + x_3
    x_5 = -d_22 + x_4
    x_6 = d_10 - d_20
    x_7 = c * tau_y
    x_8 = b_21 * x_1 * x_7
    x_9 = nu_p - x_4
    x_10 = 1.0 / tau_p
    x_11 = 1.0 / (Delta * Delta)
    x_12 = x_10 * x_11
    x_13 = a * x_12
    x_14 = b_12 * tau_p
    x_15 = b_11 * x_7
    x_16 = -x_14 + x_15
    x_17 = b_21 * b_21
    x_18 = x_16 * x_17
    x_19 = x_13 * x_18
    x_20 = x_1 * x_14
    x_21 = b_21 * x_16
    x_22 = b_11 * x_21
    x_23 = x_13 * x_22
    x_24 = b_11 * c * tau_y * x_1 * x_6 - c * x_23 - d_10 * x_20
    x_25 = a + (nu_p * nu_p)
    x_26 = b_22 * tau_p * x_1
    x_27 = d_12 - d_22
    x_28 = d_11 - d_21
    x_29 = nu_y * x_3
    x_30 = x_25 + x_29
    x_31 = x_18 * (-nu_p * x_4 + x_30)
    x_32 = nu_y * nu_y
    x_33 = a + nu_p * (nu_y - x_3) + x_29 - x_32
    x_34 = x_1 * (nu_p - nu_y)
    x_35 = x_21 * x_34
    x_36 = tau_y * x_1
    x_37 = b_21 * x_36
    x_38 = b_11 * x_36
    x_39 = d_20 * x_38 + x_23
    x_40 = tau_y * x_12
    x_41 = a * x_3
    K[0, 0] = b_22 * tau_p * x_1 * (a * x_2 + d_10) - x_19 * x_7 * x_9 - x_8 * (a * (x_2 + x_5) + x_6)
    K[0, 1] = x_24
    K[0, 2] = (
        x_12 * x_31 * x_7 + x_26 * (d_11 - d_12 * nu_p + x_25) - x_8 * (nu_p * (-x_27 - x_4) + x_28 + x_30)
    )
    K[0, 3] = (
        b_11 * c * tau_y * x_1 * (-nu_y * x_27 + x_28)
        - x_12 * x_15 * x_21 * x_33
        - x_20 * (d_11 - d_12 * nu_y + x_32)
    )
    K[0, 4] = tau_p * (d_12 - nu_p - x_10) + x_35
    K[0, 5] = (
        x_10 * x_34 * (b_11 * b_21 * (c * c) * (tau_y * tau_y) - b_12 * b_22 * (tau_p * tau_p)) + x_27 * x_7
    )
    K[1, 0] = a * tau_y * x_10 * x_11 * x_16 * x_17 * x_9 - x_37 * (-a * x_5 + d_20)
    K[1, 1] = x_39
    K[1, 2] = -x_31 * x_40 - x_37 * (d_21 + nu_p * x_5 - x_29)
    K[1, 3] = x_22 * x_33 * x_40 + x_38 * (d_21 - d_22 * nu_y + x_32)
    K[1, 4] = 0.0
    K[1, 5] = -tau_y * x_10 * x_35 - tau_y * x_5
    inverse[0, 0] = c * x_19 + d_10 * x_26 - x_8 * (x_41 + x_6)
    inverse[0, 1] = x_24
    inverse[1, 0] = -x_19 - x_37 * (d_20 - x_41)
    inverse[1, 1] = x_39


@kernel
def yaw_leads(rig, d, tau, K, inverse):
    """Triangular, yaw leads; rig as `entries` gives it."""
    a, b_12, b_21, b_22, nu_p, nu_y = rig[0], rig[2], rig[3], rig[4], rig[5], rig[6]
    Delta = rig[7]
    d_10, d_11, d_12, d_20, d_21, d_22 = d[0], d[1], d[2], d[3], d[4], d[5]
    tau_p, tau_y = tau[0], tau[1]
    x_1 = d_12 - nu_p
    x_2 = a * x_1 + d_10
    x_3 = 1.0 / Delta
    x_4 = tau_p * x_3
    x_5 = b_22 * x_4
    x_6 = 1.0 / tau_p
    x_7 = a * x_6 + d_10
    x_8 = b_12 * x_4
    x_9 = -x_7 * x_8
    x_10 = a + d_11
    x_11 = -d_12 * nu_p + (nu_p * nu_p) + x_10
    x_12 = nu_p * (nu_y - x_6) + nu_y * (-d_12 + x_6) + x_10
    x_13 = b_21 * x_3
    x_14 = tau_y * x_13
    x_15 = tau_y / b_22
    x_16 = b_12 * x_13 * x_15
    x_17 = d_20 * x_15 + x_16 * x_7
    x_18 = -d_22 + nu_y
    K[0, 0] = x_2 * x_5
    K[0, 1] = x_9
    K[0, 2] = x_11 * x_5
    K[0, 3] = -x_12 * x_8
    K[0, 4] = tau_p * (d_12 - nu_p - x_6)
    K[0, 5] = 0.0
    K[1, 0] = -x_14 * x_2
    K[1, 1] = x_17
    K[1, 2] = -x_11 * x_14
    K[1, 3] = x_12 * x_16 + x_15 * (d_21 - d_22 * nu_y + (nu_y * nu_y))
    K[1, 4] = -b_21 * x_15 * (x_1 + x_18)
    K[1, 5] = tau_y * (-x_18 - 1.0 / tau_y)
    inverse[0, 0] = d_10 * x_5
    inverse[0, 1] = x_9
    inverse[1, 0] = -d_10 * x_14
    inverse[1, 1] = x_17


@kernel
def yaw_leads_shifted(rig, d, tau, c, K, inverse):
    """Triangular, yaw leads, with a shift; rig as `entries` gives it."""
    a, b_11, b_12, b_21, b_22, nu_p = rig[0], rig[1], rig[2], rig[3], rig[4], rig[5]
    nu_y, Delta = rig[6], rig[7]
    d_10, d_11, d_12, d_20, d_21, d_22 = d[0], d[1], d[2], d[3], d[4], d[5]
    tau_p, tau_y = tau[0], tau[1]
    x_1 = 1.0 / Delta
    x_2 = tau_p * x_1
    x_3 = b_22 * x_2
    x_4 = 1.0 / tau_p
    x_5 = nu_y + x_4
    x_6 = nu_p - x_5
    x_7 = 1.0 / (Delta * Delta)
    x_8 = 1.0 / tau_y
    x_9 = b_21 * tau_y
    x_10 = b_22 * c * tau_p - x_9
    x_11 = x_10 * x_8
    x_12 = x_11 * x_7
    x_13 = b_12 * b_22 * x_12
    x_14 = a * x_13
    x_15 = a * x_4 + d_10
    x_16 = b_12 * x_2
    x_17 = b_12 * b_12
    x_18 = a * x_10 * x_17 * x_7 * x_8 - x_15 * x_16
    x_19 = a + (nu_p * nu_p)
    x_20 = nu_y * x_4
    x_21 = -nu_p * x_5 + x_19 + x_20
    x_22 = a + nu_p * (nu_y - x_4)
    x_23 = nu_y * nu_y
    x_24 = x_22 - x_23
    x_25 = x_20 + x_24
    x_26 = -d_12 + x_4
    x_27 = nu_p - nu_y
    x_28 = x_1 * x_9
    x_29 = d_12 - d_22
    x_30 = d_10 - d_20
    x_31 = c * tau_p
    x_32 = b_22 * x_31
    x_33 = x_1 * x_32
    x_34 = b_12 * x_10
    x_35 = b_11 * tau_y * x_1
    x_36 = b_12 * x_1 * x_31
    x_37 = x_12 * x_17
    x_38 = -a * c * x_37 + d_20 * x_35 + x_36 * (-d_20 + x_15)
    x_39 = d_11 - d_21
    x_40 = x_1 * x_27
    K[0, 0] = tau_p * x_14 * x_6 + x_3 * (a * (d_12 - nu_p) + d_10)
    K[0, 1] = x_18
    K[0, 2] = -tau_p * x_13 * x_21 + x_3 * (d_11 - d_12 * nu_p + x_19)
    K[0, 3] = tau_p * x_10 * x_17 * x_25 * x_7 * x_8 - x_16 * (d_11 + nu_y * (-d_12 + x_4) + x_22)
    K[0, 4] = tau_p * (-nu_p - x_26) + x_11 * x_16 * x_27
    K[0, 5] = 0.0
    K[1, 0] = (
        -a * x_32 * x_34 * x_6 * x_7 * x_8 - x_28 * (a * (d_22 - nu_p) + d_20) - x_33 * (a * x_29 + x_30)
    )
    K[1, 1] = x_38
    K[1, 2] = (
        b_12 * b_22 * c * tau_p * x_10 * x_21 * x_7 * x_8
        - x_28 * (d_21 - d_22 * nu_p + x_19)
        - x_33 * (-nu_p * x_29 + x_39)
    )
    K[1, 3] = (
        -x_25 * x_31 * x_37 + x_35 * (d_21 - d_22 * nu_y + x_23) + x_36 * (nu_y * (d_22 + x_26) + x_24 + x_39)
    )
    K[1, 4] = -x_29 * x_31 - x_40 * x_8 * (
        -b_11 * b_21 * (tau_y * tau_y) + b_12 * b_22 * (c * c) * (tau_p * tau_p)
    )
    K[1, 5] = tau_y * (d_22 - nu_y - x_8) - x_34 * x_40
    inverse[0, 0] = d_10 * x_3 - x_14
    inverse[0, 1] = x_18
    inverse[1, 0] = a * b_12 * b_22 * c * x_10 * x_7 * x_8 - d_20 * x_28 - x_30 * x_33
    inverse[1, 1] = x_38


@kernel
def input_diagonal_shifted(rig, d, tau, c, K, inverse):
    """Input-diagonal, with a shift; rig as `entries` gives it."""
    a, b_11, b_12, b_21, b_22, nu_p = rig[0], rig[1], rig[2], rig[3], rig[4], rig[5]
    nu_y, Delta = rig[6], rig[7]
    d_10, d_11, d_12, d_20, d_21, d_22 = d[0], d[1], d[2], d[3], d[4], d[5]
    tau_p, tau_y = tau[0], tau[1]
    x_1 = 1.0 / Delta
    x_2 = d_12 - d_22
    x_3 = d_10 - d_20
    x_4 = c * tau_y
    x_5 = x_1 * x_4
    x_6 = b_21 * x_5
    x_7 = tau_p * x_1
    x_8 = b_12 * x_7
    x_9 = b_11 * x_5
    x_10 = -d_10 * x_8 + x_3 * x_9
    x_11 = a + (nu_p * nu_p)
    x_12 = d_11 - d_21
    x_13 = nu_y * nu_y
    x_14 = nu_p - nu_y
    x_15 = b_12 * x_14
    x_16 = tau_y * x_1
    x_17 = b_21 * x_16
    x_18 = b_11 * x_16
    x_19 = d_20 * x_18
    K[0, 0] = b_22 * tau_p * x_1 * (a * (d_12 - nu_p) + d_10) - x_6 * (a * x_2 + x_3)
    K[0, 1] = x_10
    K[0, 2] = b_22 * tau_p * x_1 * (d_11 - d_12 * nu_p + x_11) - x_6 * (-nu_p * x_2 + x_12)
    K[0, 3] = -x_8 * (d_11 - d_12 * nu_y + x_13) + x_9 * (-nu_y * x_2 + x_12)
    K[0, 4] = -b_21 * x_14 * x_8 + tau_p * (d_12 - nu_p - 1.0 / tau_p)
    K[0, 5] = -b_22 * x_15 * x_7 + x_2 * x_4
    K[1, 0] = -x_17 * (a * (d_22 - nu_p) + d_20)
    K[1, 1] = x_19
    K[1, 2] = -x_17 * (d_21 - d_22 * nu_p + x_11)
    K[1, 3] = x_18 * (d_21 - d_22 * nu_y + x_13)
    K[1, 4] = b_11 * x_14 * x_17
    K[1, 5] = tau_y * (d_22 - nu_y - 1.0 / tau_y) + x_15 * x_17
    inverse[0, 0] = b_22 * d_10 * tau_p * x_1 - x_3 * x_6
    inverse[0, 1] = x_10
    inverse[1, 0] = -d_20 * x_17
    inverse[1, 1] = x_19


@kernel
def axis_decoupled(rig, d, tau, K, inverse):
    """Axis-decoupled; rig as `entries` gives it."""
    a, b_11, b_12, b_21, b_22, nu_p = rig[0], rig[1], rig[2], rig[3], rig[4], rig[5]
    nu_y, Delta = rig[6], rig[7]
    d_10, d_11, d_12, d_20, d_21, d_22 = d[0], d[1], d[2], d[3], d[4], d[5]
    tau_p, tau_y = tau[0], tau[1]
    x_1 = d_12 - nu_p
    x_2 = a * x_1 + d_10
    x_3 = 1.0 / Delta
    x_4 = tau_p * x_3
    x_5 = b_22 * x_4
    x_6 = b_12 * x_4
    x_7 = -d_20 * x_6
    x_8 = a + d_11 - d_12 * nu_p + (nu_p * nu_p)
    x_9 = d_21 - d_22 * nu_y + (nu_y * nu_y)
    x_10 = -d_22 + nu_y
    x_11 = x_1 + x_10
    x_12 = b_12 * x_11
    x_13 = tau_y * x_3
    x_14 = b_21 * x_13
    x_15 = b_11 * x_13
    x_16 = d_20 * x_15
    K[0, 0] = x_2 * x_5
    K[0, 1] = x_7
    K[0, 2] = x_5 * x_8
    K[0, 3] = -x_6 * x_9
    K[0, 4] = b_21 * x_11 * x_6 + tau_p * (d_12 - nu_p - 1.0 / tau_p)
    K[0, 5] = x_12 * x_5
    K[1, 0] = -x_14 * x_2
    K[1, 1] = x_16
    K[1, 2] = -x_14 * x_8
    K[1, 3] = x_15 * x_9
    K[1, 4] = -b_11 * x_11 * x_14
    K[1, 5] = tau_y * (-x_10 - 1.0 / tau_y) - x_12 * x_14
    inverse[0, 0] = d_10 * x_5
    inverse[0, 1] = x_7
    inverse[1, 0] = -d_10 * x_14
    inverse[1, 1] = x_16
