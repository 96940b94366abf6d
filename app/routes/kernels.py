"""What must not begin before the compiled kernels are there."""

from __future__ import annotations

import asyncio

from fastapi import HTTPException

from heli2dof_core.engine import engine

_POLLS = 180
"""Half seconds that a request waits for the kernels after the start."""


async def wait_for_kernels() -> None:
    """Waits for the compiled kernels, without which what asks for them would take minutes.

    Raises:
        HTTPException: 503: they are not there yet.
    """
    for _ in range(_POLLS):
        if engine().compiled:
            return
        await asyncio.sleep(0.5)
    raise HTTPException(
        503, "Still compiling after the start; try again in half a minute.", {"Retry-After": "15"}
    )
