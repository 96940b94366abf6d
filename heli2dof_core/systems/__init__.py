"""Any system ẋ = Ax + Bu, y = Cx + Du as somebody writes it: read, looked at, placed, its responses.

from heli2dof_core.systems.pasted import read_system
from heli2dof_core.systems.analysis import analyse
from heli2dof_core.systems.loop import close_loop

system = read_system("A = [0 1; -2 -3]; B = [0; 1]; C = [1 0]").system
"""
