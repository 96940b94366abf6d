"""The rig's linear model, K of the paper's four states and L of the observer, in closed form.

Made of the derivation by `python -m tests.kernel_formulas`; not to be changed by hand.

p: the parameters, in the order of `parameters.PARAMETER_INFO`; theta_0: rad; d: coefficients of the desired
polynomials, d₁₀, d₁₁ …, d₂₀, d₂₁ …, the leading 1 left out; tau: both rotors' time constants, s; family: where the
structure stands in `couplings.STRUCTURES`; c: the basis' shift, looked at where `shifted`. Nothing is checked: where
there is no such structure something is divided by zero.
"""

from __future__ import annotations

from .jit import keep_apart, kernel
from .trigonometry import sine_and_cosine


@kernel
def entries(p, theta_0):
    """a, b_11, b_12, b_21, b_22, nu_p, nu_y, Delta: what A and B are made of; Delta is B₂'s determinant."""
    K_pp, K_py, K_yp, K_yy, J_p, J_y = p[0], p[1], p[2], p[3], p[4], p[5]
    m, l, B_p, B_y, K_s, g = p[6], p[7], p[8], p[9], p[10], p[11]
    sin_0, cos_0 = sine_and_cosine(theta_0)
    alpha = J_p + (l * l) * m
    beta_0 = J_y + (l * l) * m * (cos_0 * cos_0)
    a = (-K_s + g * l * m * sin_0) / alpha
    b_11 = K_pp / alpha
    b_12 = K_py / alpha
    b_21 = K_yp / beta_0
    b_22 = K_yy / beta_0
    nu_p = B_p / alpha
    nu_y = B_y / beta_0
    Delta = (K_pp * K_yy - K_py * K_yp) / (alpha * beta_0)
    return a, b_11, b_12, b_21, b_22, nu_p, nu_y, Delta


@kernel
def rig_model(p, theta_0, A, B, trim):
    """A, 4×4, B, 4×2, and the voltages that hold the rig, (2,), into the arrays given."""
    rig = entries(p, theta_0)
    a, b_11, b_12, b_21, b_22, nu_p = rig[0], rig[1], rig[2], rig[3], rig[4], rig[5]
    nu_y = rig[6]
    K_pp, K_py, K_yp, K_yy, m, l = p[0], p[1], p[2], p[3], p[6], p[7]
    K_s, g = p[10], p[11]
    _, cos_0 = sine_and_cosine(theta_0)
    A[0, 0] = 0.0
    A[0, 1] = 0.0
    A[0, 2] = 1.0
    A[0, 3] = 0.0
    A[1, 0] = 0.0
    A[1, 1] = 0.0
    A[1, 2] = 0.0
    A[1, 3] = 1.0
    A[2, 0] = a
    A[2, 1] = 0.0
    A[2, 2] = -nu_p
    A[2, 3] = 0.0
    A[3, 0] = 0.0
    A[3, 1] = 0.0
    A[3, 2] = 0.0
    A[3, 3] = -nu_y
    B[0, 0] = 0.0
    B[0, 1] = 0.0
    B[1, 0] = 0.0
    B[1, 1] = 0.0
    B[2, 0] = b_11
    B[2, 1] = b_12
    B[3, 0] = b_21
    B[3, 1] = b_22
    trim[0] = K_yy * (K_s * theta_0 + g * l * m * cos_0) / (K_pp * K_yy - K_py * K_yp)
    trim[1] = -K_yp * (K_s * theta_0 + g * l * m * cos_0) / (K_pp * K_yy - K_py * K_yp)


@kernel
def full_rank_gain(family, shifted, d, p, theta_0, c, K, inverse):
    """K, into the first four columns of what is given, and Ĝ(0)⁻¹, 2×2, of four states."""
    keep_apart()
    rig = entries(p, theta_0)
    if family == 0:
        if shifted:
            pitch_leads_shifted(rig, d, c, K, inverse)
        else:
            pitch_leads(rig, d, K, inverse)
    elif family == 1:
        if shifted:
            yaw_leads_shifted(rig, d, c, K, inverse)
        else:
            yaw_leads(rig, d, K, inverse)
    elif family == 2:
        input_diagonal_shifted(rig, d, c if shifted else 0.0, K, inverse)
    elif family == 3:
        axis_decoupled(rig, d, K, inverse)


@kernel
def pitch_leads(rig, d, K, inverse):
    """Triangular, pitch leads; rig as `entries` gives it."""
    a, b_11, b_12, b_21, nu_p, nu_y = rig[0], rig[1], rig[2], rig[3], rig[5], rig[6]
    Delta = rig[7]
    d_10, d_11, d_20, d_21 = d[0], d[1], d[2], d[3]
    x_1 = 1.0 / b_11
    x_2 = 1.0 / Delta
    x_3 = b_12 * x_2
    x_4 = d_20 * x_3
    x_5 = b_21 * x_1
    x_6 = d_21 - nu_y
    x_7 = x_3 * x_6
    x_8 = d_20 * x_2
    x_9 = b_11 * x_8
    x_10 = x_2 * x_6
    x_11 = b_21 * (-a + d_20)
    K[0, 0] = x_1 * (a + d_10) + x_4 * x_5
    K[0, 1] = -x_4
    K[0, 2] = x_1 * (d_11 - nu_p) + x_5 * x_7
    K[0, 3] = -x_7
    K[1, 0] = -b_21 * x_8
    K[1, 1] = x_9
    K[1, 2] = -b_21 * x_10
    K[1, 3] = b_11 * x_10
    inverse[0, 0] = d_10 * x_1 + x_1 * x_11 * x_3
    inverse[0, 1] = -x_4
    inverse[1, 0] = -x_11 * x_2
    inverse[1, 1] = x_9


@kernel
def pitch_leads_shifted(rig, d, c, K, inverse):
    """Triangular, pitch leads, with a shift; rig as `entries` gives it."""
    a, b_11, b_12, b_21, b_22, nu_p = rig[0], rig[1], rig[2], rig[3], rig[4], rig[5]
    nu_y, Delta = rig[6], rig[7]
    d_10, d_11, d_20, d_21 = d[0], d[1], d[2], d[3]
    x_1 = 1.0 / Delta
    x_2 = b_22 * x_1
    x_3 = b_21 * c
    x_4 = d_10 - d_20
    x_5 = -b_22 + x_3
    x_6 = a * x_5
    x_7 = 1.0 / (Delta * Delta)
    x_8 = b_11 * x_7
    x_9 = x_3 * x_8
    x_10 = -x_1 * x_3 * x_4 + x_6 * x_9
    x_11 = b_12 * x_1
    x_12 = b_11 * c
    x_13 = -b_12 + x_12
    x_14 = a * x_13
    x_15 = b_11 * c * x_1 * x_4 - d_10 * x_11 - x_14 * x_9
    x_16 = x_1 * (d_11 - d_21)
    x_17 = nu_p - nu_y
    x_18 = x_17 * x_3
    x_19 = x_18 * x_8
    x_20 = d_20 * x_1
    x_21 = b_21 * x_20
    x_22 = b_21 * b_21
    x_23 = x_22 * x_7
    x_24 = b_21 * x_8
    x_25 = b_11 * x_20 + x_14 * x_24
    x_26 = d_21 * x_1
    x_27 = b_12 * nu_p
    x_28 = (b_11 * b_11) * x_7
    K[0, 0] = x_10 + x_2 * (a + d_10)
    K[0, 1] = x_15
    K[0, 2] = b_22 * x_1 * (d_11 - nu_p) - x_16 * x_3 - x_19 * x_5
    K[0, 3] = -x_11 * (d_11 - nu_y) + x_12 * x_16 + x_13 * x_19
    K[1, 0] = -x_14 * x_23 - x_21
    K[1, 1] = x_25
    K[1, 2] = b_11 * b_21 * b_22 * nu_y * x_7 + b_11 * c * x_17 * x_22 * x_7 - b_21 * x_26 - x_23 * x_27
    K[1, 3] = b_11 * x_26 - b_22 * nu_y * x_28 - x_18 * x_28 + x_24 * x_27
    inverse[0, 0] = d_10 * x_2 + x_10
    inverse[0, 1] = x_15
    inverse[1, 0] = -x_21 - x_24 * x_6
    inverse[1, 1] = x_25


@kernel
def yaw_leads(rig, d, K, inverse):
    """Triangular, yaw leads; rig as `entries` gives it."""
    a, b_12, b_21, b_22, nu_p, nu_y = rig[0], rig[2], rig[3], rig[4], rig[5], rig[6]
    Delta = rig[7]
    d_10, d_11, d_20, d_21 = d[0], d[1], d[2], d[3]
    x_1 = 1.0 / Delta
    x_2 = x_1 * (a + d_10)
    x_3 = b_12 * x_2
    x_4 = x_1 * (d_11 - nu_p)
    x_5 = b_12 * x_4
    x_6 = 1.0 / b_22
    x_7 = b_21 * x_6
    x_8 = d_20 * x_6 + x_3 * x_7
    x_9 = d_10 * x_1
    K[0, 0] = b_22 * x_2
    K[0, 1] = -x_3
    K[0, 2] = b_22 * x_4
    K[0, 3] = -x_5
    K[1, 0] = -b_21 * x_2
    K[1, 1] = x_8
    K[1, 2] = -b_21 * x_4
    K[1, 3] = x_5 * x_7 + x_6 * (d_21 - nu_y)
    inverse[0, 0] = b_22 * x_9
    inverse[0, 1] = -x_3
    inverse[1, 0] = -b_21 * x_9
    inverse[1, 1] = x_8


@kernel
def yaw_leads_shifted(rig, d, c, K, inverse):
    """Triangular, yaw leads, with a shift; rig as `entries` gives it."""
    a, b_11, b_12, b_21, b_22, nu_p = rig[0], rig[1], rig[2], rig[3], rig[4], rig[5]
    nu_y, Delta = rig[6], rig[7]
    d_10, d_11, d_20, d_21 = d[0], d[1], d[2], d[3]
    x_1 = 1.0 / Delta
    x_2 = d_10 * x_1
    x_3 = b_22 * x_2
    x_4 = 1.0 / (Delta * Delta)
    x_5 = (b_22 * b_22) * x_4
    x_6 = -b_11 + b_12 * c
    x_7 = a * x_6
    x_8 = a * b_12 * b_22 * x_4 * x_6 - b_12 * x_2
    x_9 = d_11 * x_1
    x_10 = b_21 * nu_y
    x_11 = b_22 * x_4
    x_12 = b_12 * x_11
    x_13 = nu_p - nu_y
    x_14 = b_12 * c
    x_15 = x_13 * x_14
    x_16 = (b_12 * b_12) * x_4
    x_17 = b_22 * c
    x_18 = b_21 * x_1
    x_19 = x_1 * (d_10 - d_20)
    x_20 = -b_21 + b_22 * c
    x_21 = -a * b_12 * b_22 * c * x_20 * x_4 + x_17 * x_19
    x_22 = b_11 * x_1
    x_23 = d_20 * x_22 - x_11 * x_14 * x_7 + x_14 * x_19
    x_24 = x_1 * (d_11 - d_21)
    x_25 = x_11 * x_15
    K[0, 0] = x_3 - x_5 * x_7
    K[0, 1] = x_8
    K[0, 2] = -b_11 * nu_p * x_5 + b_22 * x_9 + x_10 * x_12 + x_15 * x_5
    K[0, 3] = b_11 * b_12 * b_22 * nu_p * x_4 - b_12 * x_9 - x_10 * x_16 - x_13 * x_16 * x_17
    K[1, 0] = -x_18 * (a + d_20) - x_21
    K[1, 1] = x_23
    K[1, 2] = -x_17 * x_24 - x_18 * (d_21 - nu_p) - x_20 * x_25
    K[1, 3] = x_14 * x_24 + x_22 * (d_21 - nu_y) + x_25 * x_6
    inverse[0, 0] = -a * x_12 * x_20 + x_3
    inverse[0, 1] = x_8
    inverse[1, 0] = -d_20 * x_18 - x_21
    inverse[1, 1] = x_23


@kernel
def input_diagonal_shifted(rig, d, c, K, inverse):
    """Input-diagonal, with a shift; rig as `entries` gives it."""
    a, b_11, b_12, b_21, b_22, nu_p = rig[0], rig[1], rig[2], rig[3], rig[4], rig[5]
    nu_y, Delta = rig[6], rig[7]
    d_10, d_11, d_20, d_21 = d[0], d[1], d[2], d[3]
    x_1 = 1.0 / Delta
    x_2 = b_21 * x_1
    x_3 = c * (d_10 - d_20)
    x_4 = x_2 * x_3
    x_5 = b_12 * x_1
    x_6 = b_11 * x_1
    x_7 = -d_10 * x_5 + x_3 * x_6
    x_8 = c * (d_11 - d_21)
    x_9 = d_20 * x_6
    K[0, 0] = b_22 * x_1 * (a + d_10) - x_4
    K[0, 1] = x_7
    K[0, 2] = b_22 * x_1 * (d_11 - nu_p) - x_2 * x_8
    K[0, 3] = -x_5 * (d_11 - nu_y) + x_6 * x_8
    K[1, 0] = -x_2 * (a + d_20)
    K[1, 1] = x_9
    K[1, 2] = -x_2 * (d_21 - nu_p)
    K[1, 3] = x_6 * (d_21 - nu_y)
    inverse[0, 0] = b_22 * d_10 * x_1 - x_4
    inverse[0, 1] = x_7
    inverse[1, 0] = -d_20 * x_2
    inverse[1, 1] = x_9


@kernel
def axis_decoupled(rig, d, K, inverse):
    """Axis-decoupled; rig as `entries` gives it."""
    a, b_11, b_12, b_21, b_22, nu_p = rig[0], rig[1], rig[2], rig[3], rig[4], rig[5]
    nu_y, Delta = rig[6], rig[7]
    d_10, d_11, d_20, d_21 = d[0], d[1], d[2], d[3]
    x_1 = a + d_10
    x_2 = 1.0 / Delta
    x_3 = b_22 * x_2
    x_4 = b_12 * x_2
    x_5 = -d_20 * x_4
    x_6 = d_11 - nu_p
    x_7 = d_21 - nu_y
    x_8 = b_21 * x_2
    x_9 = b_11 * x_2
    x_10 = d_20 * x_9
    K[0, 0] = x_1 * x_3
    K[0, 1] = x_5
    K[0, 2] = x_3 * x_6
    K[0, 3] = -x_4 * x_7
    K[1, 0] = -x_1 * x_8
    K[1, 1] = x_10
    K[1, 2] = -x_6 * x_8
    K[1, 3] = x_7 * x_9
    inverse[0, 0] = d_10 * x_3
    inverse[0, 1] = x_5
    inverse[1, 0] = -d_10 * x_8
    inverse[1, 1] = x_10


@kernel
def full_rank_observer(d, p, theta_0, L):
    """L, 4×2, whatever the structure; d are the coefficients of the observer's polynomials."""
    rig = entries(p, theta_0)
    a, nu_p, nu_y = rig[0], rig[5], rig[6]
    d_10, d_11, d_20, d_21 = d[0], d[1], d[2], d[3]
    L[0, 0] = d_11 - nu_p
    L[0, 1] = 0.0
    L[1, 0] = 0.0
    L[1, 1] = d_21 - nu_y
    L[2, 0] = a + d_10 - d_11 * nu_p + (nu_p * nu_p)
    L[2, 1] = 0.0
    L[3, 0] = 0.0
    L[3, 1] = d_20 - d_21 * nu_y + (nu_y * nu_y)
