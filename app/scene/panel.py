"""Viser's own panel beside the rig, for a window of its own: poles, PI values, playing and K.

The panel decides nothing. What is set there goes to the session's leading window, which has the design,
and comes back with the next design shown; static/scene/panel.js knows the same names.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from viser import (
    GuiButtonGroupHandle,
    GuiCheckboxHandle,
    GuiDropdownHandle,
    GuiEvent,
    GuiHtmlHandle,
    GuiSliderHandle,
    ViserServer,
)

from heli2dof_core.signals import INPUTS, STATES, Signal

from .hub import Design, Shown, Transport

SPEEDS = {"¼×": 0.25, "½×": 0.5, "1×": 1.0, "2×": 2.0, "4×": 4.0}
PLAY = ("Play", "Pause", "Replay")
_REAL, _IMAGINARY = (-20.0, 2.0), (0.0, 20.0)
_KP, _TI = (0.0, 100.0), (0.01, 2.0)
_SUBSCRIPTS = "₁₂₃₄"

Input = GuiSliderHandle[float] | GuiCheckboxHandle | GuiDropdownHandle[Any] | GuiButtonGroupHandle


class Panel:
    """The elements of one session's panel.

    Args:
        server: of the session.
        on_edit: called in the server's own thread with names and values that someone has set.
    """

    def __init__(self, server: ViserServer, on_edit: Callable[[dict[str, Any]], None]) -> None:
        self._server = server
        self._on_edit = on_edit
        self._inputs: dict[str, Input] = {}
        self._by_id: dict[str, Input] = {}
        with server.atomic():
            self._K = self._build()

    def allowed_update(self, element: str, updates: dict[str, Any]) -> dict[str, Any] | None:
        """Return what a client may set: the value alone, of a known element, within its range."""
        known = self._by_id.get(element)
        if known is None or set(updates) != {"value"}:
            return None
        value = updates["value"]
        match known:
            case GuiCheckboxHandle():
                right = isinstance(value, bool)
            case GuiDropdownHandle() | GuiButtonGroupHandle():
                right = isinstance(value, str) and value in known.options
            case _:
                right = (
                    isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)
                )
                value = min(max(float(value), known.min), known.max) if right else value
        return {"value": value} if right else None

    def show(self, shown: Shown, *, edits_pending: bool) -> None:
        """Show a design and its K; with `edits_pending`, only K, as the sliders are ahead of the design."""
        with self._server.atomic():
            self._K.content = gain_table(shown.K)
            if not edits_pending:
                self._show_design(shown.design)

    def set_transport(self, transport: Transport) -> None:
        """Show how time runs."""
        self._set("loop", transport.loop)
        name = min(SPEEDS, key=lambda name: abs(math.log(SPEEDS[name] / transport.speed)))
        self._set("speed", name)

    def _show_design(self, design: Design) -> None:
        for pair, first in (("pitch", 0), ("yaw", 2)):
            one, two = design.poles[first], design.poles[first + 1]
            joined = one.im != 0.0
            self._set(f"{pair}.complex", joined)
            for name in ("first", "second"):
                self._input(f"{pair}.{name}").visible = not joined
            for name in ("re", "im"):
                self._input(f"{pair}.{name}").visible = joined
            if joined:
                self._set(f"{pair}.re", one.re)
                self._set(f"{pair}.im", abs(one.im))
            else:
                self._set(f"{pair}.first", one.re)
                self._set(f"{pair}.second", two.re)
        for axis in ("pitch", "yaw"):
            for name in ("kp", "ti"):
                self._set(f"{axis}.{name}", getattr(getattr(design.loops, axis), name))
                self._input(f"{axis}.{name}").disabled = design.outer != "pi"

    def _input(self, name: str) -> Input:
        return self._inputs[name]

    def _set(self, name: str, value: Any) -> None:
        known = self._inputs[name]
        if isinstance(known, GuiSliderHandle):
            if value < known.min:
                known.min = math.floor(1.5 * value) if value < 0 else value
            if value > known.max:
                known.max = math.ceil(1.5 * value)
        known.value = value

    def _build(self) -> GuiHtmlHandle:
        gui = self._server.gui
        gui.set_panel_label("heli2dof")
        gui.main_panel.dock_right()  # beside the rig and its scales, not over them
        with gui.add_folder("Motion"):
            self._add("play", gui.add_button_group("Play", PLAY))
            self._add("speed", gui.add_dropdown("Speed", [*SPEEDS], initial_value="1×"))
            self._add("loop", gui.add_checkbox("Loop", initial_value=False))
        for pair, first in (("pitch", 0), ("yaw", 2)):
            names = [f"p{_SUBSCRIPTS[first]}", f"p{_SUBSCRIPTS[first + 1]}"]
            with gui.add_folder(f"{pair.capitalize()} poles, rad/s"):
                self._add(f"{pair}.complex", gui.add_checkbox("Complex", initial_value=False))
                for name, label in zip(("first", "second"), names, strict=True):
                    self._slider(f"{pair}.{name}", label, _REAL, 0.05)
                self._slider(f"{pair}.re", "Re", _REAL, 0.05)
                self._slider(f"{pair}.im", "± Im", _IMAGINARY, 0.05)
        with gui.add_folder("PI loops"):
            for axis in ("pitch", "yaw"):
                self._slider(f"{axis}.kp", f"{axis} kₚ, V/rad", _KP, 0.5)
                self._slider(f"{axis}.ti", f"{axis} Tᵢ, s", _TI, 0.01)
        with gui.add_folder("K, of u = −Kx + v"):
            return gui.add_html("")

    def _slider(self, name: str, label: str, reach: tuple[float, float], step: float) -> None:
        low, high = reach
        start = min(max(low, 0.0), high)
        self._add(name, self._server.gui.add_slider(label, low, high, step, start))

    def _add(self, name: str, handle: Input) -> None:
        self._inputs[name] = handle
        # The id has no public name in viser 1.1.1; a test sends it back as a client would.
        self._by_id[handle._impl.uuid] = handle  # pyright: ignore[reportPrivateUsage]

        # Asynchronous: viser calls it in its own thread, where a plain function would take one from its pool.
        async def on_input(event: GuiEvent[Any]) -> None:
            if event.client_id is None:
                return  # set by us, not by a client
            value: Any = event.target.value
            self._on_edit({name: SPEEDS[value] if name == "speed" else value})

        if isinstance(handle, GuiButtonGroupHandle):
            handle.on_click(on_input)
        else:
            handle.on_update(on_input)


def gain_table(K: tuple[tuple[float, ...], ...]) -> str:
    """Return K as an HTML table; V/rad and V·s/rad."""
    cell = 'style="padding:1px 5px;text-align:right;font-variant-numeric:tabular-nums"'
    head = "".join(f"<th {cell}>{_symbol(signal)}</th>" for signal in STATES)
    rows = [
        f"<tr><th {cell}>{_symbol(signal)}</th>"
        + "".join(f"<td {cell}>{f'{value:.4g}'.replace('-', '−')}</td>" for value in row)
        + "</tr>"
        for signal, row in zip(INPUTS, K, strict=True)
    ]
    return f'<table style="font-size:0.8em;margin:4px auto"><tr><td></td>{head}</tr>{"".join(rows)}</table>'


def _symbol(signal: Signal) -> str:
    base, _, index = signal.symbol.partition("_")
    return f"<i>{base}</i><sub>{index}</sub>" if index else f"<i>{base}</i>"
