"""Random rigs and poles for the laws."""

from __future__ import annotations

from hypothesis import strategies as st

from heli2dof_core import Parameters, PoleSet, Structure

STRUCTURES = (
    Structure("triangular", "pitch"),
    Structure("triangular", "yaw"),
    Structure("input-diagonal"),
    Structure("axis-decoupled"),
)

structures = st.sampled_from(STRUCTURES)


@st.composite
def pairs(draw: st.DrawFn, low: float = -20.0, high: float = -0.5) -> tuple[complex, complex]:
    """Two poles, real or conjugate."""
    re = draw(st.floats(low, high))
    if draw(st.booleans()):
        return complex(re), complex(draw(st.floats(low, high)))
    im = draw(st.floats(0.1, 15.0))
    return complex(re, im), complex(re, -im)


@st.composite
def pole_sets(draw: st.DrawFn) -> PoleSet:
    return PoleSet([*draw(pairs()), *draw(pairs())])


@st.composite
def rigs(draw: st.DrawFn) -> Parameters:
    """Rigs whose motors are far enough from parallel: det of the thrust matrix ≥ 0.2 of its products."""
    main = st.floats(0.02, 0.5)
    share = st.floats(-0.8, 0.8)
    K_pp, K_yy = draw(main), draw(main)
    return Parameters(
        K_pp=K_pp,
        K_yy=K_yy,
        K_py=draw(share) * K_pp,
        K_yp=draw(share) * K_yy,
        J_p=draw(st.floats(0.01, 0.1)),
        J_y=draw(st.floats(0.01, 0.1)),
        m=draw(st.floats(0.0, 3.0)),
        l=draw(st.floats(0.0, 0.4)),
        B_p=draw(st.floats(0.0, 2.0)),
        B_y=draw(st.floats(0.0, 2.0)),
        K_s=draw(st.floats(0.0, 0.5)),
    )


operating_points = st.floats(-0.7, 0.7)
