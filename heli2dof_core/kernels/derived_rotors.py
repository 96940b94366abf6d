"""K of the six states, those of both rotors among them, in closed form.

Made of the derivation by `python -m tests.kernel_formulas`; not to be changed by hand.

p: the parameters, in the order of `parameters.PARAMETER_INFO`; theta_0: rad; d: coefficients of the desired
polynomials, d₁₀, d₁₁ …, d₂₀, d₂₁ …, the leading 1 left out; tau: both rotors' time constants, s; family: where the
structure stands in `couplings.STRUCTURES`; c: the basis' shift, looked at where `shifted`. Nothing is checked: where
there is no such structure something is divided by zero.
"""

from __future__ import annotations

from .derived import entries
from .jit import keep_apart, kernel


@kernel
def full_rank_gain_with_rotors(family, shifted, d, p, theta_0, tau, c, K, inverse):
    """K, 2×6, and Ĝ(0)⁻¹, 2×2, of six states; the thrust constants in p are times the curves' slopes φ′."""
    keep_apart()
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
    x_2 = d_12 - d_22
    x_3 = d_10 - d_20
    x_4 = c * tau_y
    x_5 = b_21 * x_4
    x_6 = x_1 * x_5
    x_7 = b_11 * x_5
    x_8 = b_22 * tau_p
    x_9 = 1.0 / tau_p
    x_10 = 1.0 / (Delta * Delta)
    x_11 = x_10 * x_9
    x_12 = x_11 * (x_5 - x_8)
    x_13 = x_12 * x_7
    x_14 = 1.0 / tau_y
    x_15 = nu_y + x_14
    x_16 = nu_p - x_15
    x_17 = b_12 * tau_p
    x_18 = x_1 * x_17
    x_19 = b_11 * b_21
    x_20 = a * x_19
    x_21 = x_11 * (b_11 * x_4 - x_17)
    x_22 = x_20 * x_21
    x_23 = b_11 * c * tau_y * x_1 * x_3 - c * x_22 - d_10 * x_18
    x_24 = a + (nu_p * nu_p)
    x_25 = x_1 * x_8
    x_26 = d_11 - d_21
    x_27 = nu_y * x_14
    x_28 = -nu_p * x_15 + x_24 + x_27
    x_29 = nu_y * nu_y
    x_30 = a + nu_p * (nu_y - x_14) + x_27
    x_31 = -x_29 + x_30
    x_32 = x_1 * (nu_p - nu_y)
    x_33 = tau_y * tau_y
    x_34 = x_19 * x_33
    x_35 = x_32 * x_9
    x_36 = tau_y * x_1
    x_37 = b_21 * x_36
    x_38 = b_21 * b_21
    x_39 = tau_y * x_10
    x_40 = b_12 * x_39
    x_41 = b_11 * x_36
    x_42 = d_20 * x_41 + x_22
    x_43 = b_22 * x_39
    x_44 = c * x_11 * x_33
    x_45 = b_11 * b_11
    x_46 = x_12 * x_20
    K[0, 0] = -a * x_13 * x_16 + b_22 * tau_p * x_1 * (a * (d_12 - nu_p) + d_10) - x_6 * (a * x_2 + x_3)
    K[0, 1] = x_23
    K[0, 2] = x_13 * x_28 + x_25 * (d_11 - d_12 * nu_p + x_24) - x_6 * (-nu_p * x_2 + x_26)
    K[0, 3] = (
        b_11 * c * tau_y * x_1 * (-nu_y * x_2 + x_26) - x_18 * (d_11 - d_12 * nu_y + x_29) - x_21 * x_31 * x_7
    )
    K[0, 4] = -b_11 * nu_p * x_25 + b_21 * nu_y * x_18 + tau_p * (d_12 - x_9) + x_32 * x_7
    K[0, 5] = x_2 * x_4 + x_35 * (-b_12 * b_22 * (tau_p * tau_p) + (c * c) * x_34)
    K[1, 0] = (
        a * b_11 * b_21 * b_22 * tau_y * x_10 * x_15
        + a * b_11 * c * x_10 * x_16 * x_33 * x_38 * x_9
        - a * nu_p * x_38 * x_40
        - x_37 * (a * d_22 + d_20)
    )
    K[1, 1] = x_42
    K[1, 2] = (
        -b_11 * x_28 * x_38 * x_44
        + b_12 * tau_y * x_10 * x_24 * x_38
        - x_19 * x_43 * (nu_p * x_15 - x_27)
        - x_37 * (d_21 - d_22 * nu_p)
    )
    K[1, 3] = (
        b_21 * x_31 * x_44 * x_45 - x_19 * x_30 * x_40 + x_29 * x_43 * x_45 + x_41 * (d_21 - d_22 * nu_y)
    )
    K[1, 4] = 0.0
    K[1, 5] = b_12 * nu_p * x_37 - b_22 * nu_y * x_41 - c * x_34 * x_35 + tau_y * (d_22 - x_14)
    inverse[0, 0] = c * x_46 + d_10 * x_25 - x_3 * x_6
    inverse[0, 1] = x_23
    inverse[1, 0] = -d_20 * x_37 - x_46
    inverse[1, 1] = x_42


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
    x_4 = b_22 * b_22
    x_5 = 1.0 / (Delta * Delta)
    x_6 = tau_p * x_5
    x_7 = b_11 * x_6
    x_8 = x_4 * x_7
    x_9 = 1.0 / tau_p
    x_10 = nu_y + x_9
    x_11 = b_21 * x_6
    x_12 = b_12 * b_22
    x_13 = a * x_12
    x_14 = tau_p * tau_p
    x_15 = 1.0 / tau_y
    x_16 = x_15 * x_5
    x_17 = b_12 * c * x_14 * x_16 * x_4
    x_18 = a * (nu_p - x_10)
    x_19 = b_12 * x_2
    x_20 = b_11 * tau_y
    x_21 = b_12 * c * tau_p - x_20
    x_22 = a * b_12 * b_22 * x_15 * x_21 * x_5 - d_10 * x_19
    x_23 = a + (nu_p * nu_p)
    x_24 = nu_y * x_9
    x_25 = -nu_p * x_10 + x_23 + x_24
    x_26 = b_12 * b_12
    x_27 = nu_y * nu_y
    x_28 = a + nu_p * (nu_y - x_9) + x_24
    x_29 = -x_27 + x_28
    x_30 = x_1 * (nu_p - nu_y)
    x_31 = x_15 * x_30
    x_32 = b_21 * tau_y
    x_33 = x_1 * x_32
    x_34 = d_12 - d_22
    x_35 = d_10 - d_20
    x_36 = c * tau_p
    x_37 = b_22 * x_1 * x_36
    x_38 = b_12 * x_36
    x_39 = b_22 * x_38
    x_40 = b_22 * c * tau_p - x_32
    x_41 = x_16 * x_40
    x_42 = x_1 * x_20
    x_43 = x_1 * x_38
    x_44 = x_16 * x_21
    x_45 = -c * x_13 * x_44 + d_20 * x_42 + x_35 * x_43
    x_46 = d_11 - d_21
    K[0, 0] = -a * nu_p * x_8 + x_10 * x_11 * x_13 + x_17 * x_18 + x_3 * (a * d_12 + d_10)
    K[0, 1] = x_22
    K[0, 2] = -x_11 * x_12 * (nu_p * x_10 - x_24) - x_17 * x_25 + x_23 * x_8 + x_3 * (d_11 - d_12 * nu_p)
    K[0, 3] = (
        b_21 * tau_p * x_26 * x_27 * x_5
        + b_22 * c * x_14 * x_15 * x_26 * x_29 * x_5
        - x_12 * x_28 * x_7
        - x_19 * (d_11 - d_12 * nu_y)
    )
    K[0, 4] = -b_11 * nu_p * x_3 + b_21 * nu_y * x_19 + c * x_12 * x_14 * x_31 + tau_p * (d_12 - x_9)
    K[0, 5] = 0.0
    K[1, 0] = -x_18 * x_39 * x_41 - x_33 * (a * (d_22 - nu_p) + d_20) - x_37 * (a * x_34 + x_35)
    K[1, 1] = x_45
    K[1, 2] = (
        b_12 * b_22 * c * tau_p * x_15 * x_25 * x_40 * x_5
        - x_33 * (d_21 - d_22 * nu_p + x_23)
        - x_37 * (-nu_p * x_34 + x_46)
    )
    K[1, 3] = -x_29 * x_39 * x_44 + x_42 * (d_21 - d_22 * nu_y + x_27) + x_43 * (-nu_y * x_34 + x_46)
    K[1, 4] = -x_31 * (-b_11 * b_21 * (tau_y * tau_y) + b_12 * b_22 * (c * c) * x_14) - x_34 * x_36
    K[1, 5] = b_12 * nu_p * x_33 - b_22 * nu_y * x_42 + tau_y * (d_22 - x_15) - x_30 * x_39
    inverse[0, 0] = d_10 * x_3 - x_13 * x_41
    inverse[0, 1] = x_22
    inverse[1, 0] = a * b_12 * b_22 * c * x_15 * x_40 * x_5 - d_20 * x_33 - x_35 * x_37
    inverse[1, 1] = x_45


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
    x_14 = b_22 * x_7
    x_15 = nu_p - nu_y
    x_16 = tau_y * x_1
    x_17 = b_21 * x_16
    x_18 = b_11 * x_16
    x_19 = d_20 * x_18
    K[0, 0] = b_22 * tau_p * x_1 * (a * (d_12 - nu_p) + d_10) - x_6 * (a * x_2 + x_3)
    K[0, 1] = x_10
    K[0, 2] = b_22 * tau_p * x_1 * (d_11 - d_12 * nu_p + x_11) - x_6 * (-nu_p * x_2 + x_12)
    K[0, 3] = -x_8 * (d_11 - d_12 * nu_y + x_13) + x_9 * (-nu_y * x_2 + x_12)
    K[0, 4] = -b_11 * nu_p * x_14 + b_21 * nu_y * x_8 + tau_p * (d_12 - 1.0 / tau_p)
    K[0, 5] = -b_12 * x_14 * x_15 + x_2 * x_4
    K[1, 0] = -x_17 * (a * (d_22 - nu_p) + d_20)
    K[1, 1] = x_19
    K[1, 2] = -x_17 * (d_21 - d_22 * nu_p + x_11)
    K[1, 3] = x_18 * (d_21 - d_22 * nu_y + x_13)
    K[1, 4] = b_11 * x_15 * x_17
    K[1, 5] = b_12 * nu_p * x_17 - b_22 * nu_y * x_18 + tau_y * (d_22 - 1.0 / tau_y)
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
    x_10 = d_22 - nu_y
    x_11 = -d_22 + nu_y + x_1
    x_12 = tau_y * x_3
    x_13 = b_21 * x_12
    x_14 = b_11 * x_12
    x_15 = d_20 * x_14
    K[0, 0] = x_2 * x_5
    K[0, 1] = x_7
    K[0, 2] = x_5 * x_8
    K[0, 3] = -x_6 * x_9
    K[0, 4] = b_11 * b_22 * tau_p * x_1 * x_3 - b_21 * x_10 * x_6 - 1
    K[0, 5] = b_12 * x_11 * x_5
    K[1, 0] = -x_13 * x_2
    K[1, 1] = x_15
    K[1, 2] = -x_13 * x_8
    K[1, 3] = x_14 * x_9
    K[1, 4] = -b_11 * x_11 * x_13
    K[1, 5] = b_11 * b_22 * tau_y * x_10 * x_3 - b_12 * x_1 * x_13 - 1
    inverse[0, 0] = d_10 * x_5
    inverse[0, 1] = x_7
    inverse[1, 0] = -d_10 * x_13
    inverse[1, 1] = x_15
