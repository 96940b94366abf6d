"""The derivation: its formulas, its numbers step by step, and the paper that it reproduces."""

from __future__ import annotations

from fastapi import APIRouter, Response

from heli2dof_core import Structure
from heli2dof_core.couplings import Coupling, Lead, Modelled, Sought

from ..contract.derivation import (
    Symbolic,
    SymbolicObserver,
    SymbolicRotors,
    Walkthrough,
    symbolic_reply,
    walkthrough_reply,
)
from ..contract.design import DesignRequest
from ..contract.encoding import json_bytes, json_content
from ..contract.model import described
from ..contract.paper import Paper
from ..contract.symbols import SymbolicPlacementReply, SymbolicPlaceRequest, symbolic_placement_reply
from ..jobs.compute import Compute, check_cancelled


def build_router(compute: Compute) -> APIRouter:
    """The routes symbolic, symbolic/place, walkthrough and paper under /api/v1."""
    router = APIRouter(prefix="/api/v1", tags=["derivation"])

    @router.get(
        "/symbolic",
        **described(Symbolic | SymbolicRotors | SymbolicObserver, "The formulas, derived"),
    )
    async def symbolic(
        coupling: Coupling = "triangular",
        lead: Lead = "pitch",
        shifted: bool = False,
        model: Modelled = "paper",
        what: Sought = "K",
    ) -> Response:
        asked = (coupling, lead, shifted, model, what)
        return json_content(await compute.run_once(("symbolic", *asked), _symbolic, *asked))

    @router.post(
        "/walkthrough", **described(Walkthrough, "The derivation in numbers, from constants to the RGA")
    )
    async def walkthrough(request: DesignRequest) -> Response:
        return json_content(await compute.run_slow(_walkthrough, request))

    @router.post(
        "/symbolic/place",
        **described(SymbolicPlacementReply, "State feedback for any controllable (A, B), in formulas"),
    )
    async def symbolic_place(request: SymbolicPlaceRequest) -> Response:
        return json_content(await compute.run_slow(_symbolic_placement, request))

    @router.get("/paper", **described(Paper, "The paper, reproduced, and its errata proved"))
    async def paper() -> Response:
        return json_content(await compute.run_once("paper", _paper))

    return router


def _symbolic(coupling: Coupling, lead: Lead, shifted: bool, model: Modelled, what: Sought) -> bytes:
    from heli2dof_core.symbolic.render import symbolic_report

    structure = Structure(coupling, lead)
    return json_bytes(symbolic_reply(symbolic_report(structure, shifted=shifted, model=model, what=what)))


def _walkthrough(request: DesignRequest) -> bytes:
    return json_bytes(walkthrough_reply(request.to_spec()))


def _symbolic_placement(request: SymbolicPlaceRequest) -> bytes:
    return json_bytes(symbolic_placement_reply(request.place(check_cancelled), check_cancelled))


def _paper() -> bytes:
    from ..contract.paper_reply import paper_reply

    return json_bytes(paper_reply())
