"""The hot loops: plain functions of floats and arrays, compiled by Numba (see `jit`).

Nothing here knows of dataclasses, names or units; `simulation` and `margins` call these through
`engine`, which hands out the compiled functions or, until those are ready, their interpreted twins.
"""
