"""The web side of heli2dof: REST, WebSocket, page and scene around heli2dof_core.

Imports inside this package are relative: in the wheel it is called ``heli2dof_app``, because
``app`` would be an impolite name to take in everybody's site-packages.
"""
