"""A pytest plugin: the kernels' plain twins answer throughout, so that a changed kernel need not be compiled."""

from heli2dof_core import engine

engine.warm_up = engine.engine
