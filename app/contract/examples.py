"""A worked request for every kind of body, shown at /docs and run by the tests."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from fastapi import FastAPI

Json = dict[str, Any]

_PAIR: list[Json] = [{"re": -3, "im": 4}, {"re": -3, "im": -4}]
_PITCH: Json = {"reference": {"theta": 0.2}, "duration": 3, "samples": 301}

_FLIGHT: Json = {
    "flight": 1,
    "design": {},
    "ticks": 1500,
    "events": [
        [0, "reference", 0.1, 0.3],
        [500, "gust", 0.05, 0.1, 250],
        [1000, "design", {"poles": [-6, -7, -9, -8]}],
        [1000, "turn", 0.0, 0.2],
    ],
    "seed": 0,
    "checks": [
        [500, 0.09992125641580855, 0.29995233098947305, -0.0036055942869021762, 0.021819095680851597],
        [1000, 0.0998589202227122, 0.29727567575817815, 0.003398335492413272, 0.006034089291550714],
        [1500, 0.10197203221255273, 0.4370401615617683, 0.00038193462595357685, 0.20567651786438304],
    ],
    "task": "",
    "checksum": "f0a6c956",
}

EXAMPLES: dict[str, dict[str, tuple[str, Json]]] = {
    "DesignRequest": {
        "default": ("The default rig with the paper's poles", {}),
        "complex": ("A complex pair for yaw, rad/s", {"poles": [-12, -10, *_PAIR]}),
        "rig": (
            "Another rig, one parameter changed, yaw leading",
            {"preset": "quanser-aero-2", "parameters": {"J_p": 0.03}, "lead": "yaw"},
        ),
    },
    "RgaRequest": {
        "frequencies": ("With |RGA(jω)| at three frequencies, rad/s", {"frequencies": [0, 1, 10]}),
    },
    "LoopsRequest": {"bode": ("L(jω) at three frequencies, rad/s", {"frequencies": [0.1, 1, 10]})},
    "StepRequest": {"pitch": ("A step of 0.2 rad in pitch", {"scenario": _PITCH})},
    "MapRequest": {
        "pair": (
            "What each place of yaw's pair would give",
            {"map": {"move": "yaw-pair", "measure": "settling_time", "axis": "psi", "size": [24, 18]}},
        ),
        "gains": (
            "The disk margin over pitch's gains",
            {
                "map": {
                    "move": "pitch-pi",
                    "over": [[1, 100], [0.1, 10]],
                    "measure": "disk_margin",
                    "size": [16, 12],
                }
            },
        ),
    },
    "ExportRequest": {
        "pitch": ("A step of 0.2 rad in pitch", {"scenario": _PITCH}),
        "pins": (
            "A report with another design beside",
            {"scenario": _PITCH, "pins": [{"name": "A slow", "poles": [-6, -7, -8, -9], "scenario": _PITCH}]},
        ),
    },
    "ResponseRequest": {
        "pitch": ("A step of 0.2 rad in pitch, with the rates", {"scenario": _PITCH, "states": True}),
        "linear": ("Both references, the linear model", {"scenario": {"model": "linear", "duration": 2}}),
        "digital": (
            "The rig's digital controller: 10 ms, late, noisy",
            {"scenario": {**_PITCH, "digital": {"sample_time": 0.01, "delay": True, "noise": 0.001}}},
        ),
    },
    "EvaluateRequest": {
        "all": ("Everything, each axis stepped alone too", {"poles": [-12, -10, *_PAIR], "each_axis": True}),
    },
    "CompareRequest": {
        "three": ("Three methods", {"methods": ["full-rank", "tits-yang", "lqr"]}),
    },
    "TrackRequest": {
        "locus": ("The loop opened at the pitch motor: its root locus", {"track": {"path": "gain.pitch"}}),
        "lag": (
            "Both rotors' lag, with the disk margin and the settling time of a pitch step",
            {
                "track": {
                    "path": "rotors.tau",
                    "over": [0.01, 0.3],
                    "points": 50,
                    "measures": [{"measure": "disk_margin"}, {"measure": "settling_time", "axis": "theta"}],
                }
            },
        ),
    },
    "FindRequest": {
        "quick": (
            "Quick steps with few volts, along the front",
            {
                "find": {
                    "free": ["poles", "loops"],
                    "require": {"overshoot": {"max": 5}, "disk_margin": {"min": 0.5}},
                    "minimize": ["settling_time", "V_peak"],
                    "designs": 600,
                }
            },
        ),
        "contradictory": (
            "More margin than there is: what contradicts",
            {"find": {"require": {"disk_margin": {"min": 2.5}}, "designs": 400}},
        ),
    },
    "NearestRequest": {
        "settling": (
            "Both steps shall settle within 0.8 s and overshoot by no more than 3 %",
            {"nearest": {"require": {"settling_time": {"max": 0.8}, "overshoot": {"max": 3}}}},
        ),
        "yaw": (
            "The yaw step alone, by yaw's poles",
            {"nearest": {"require": {"settling_time": {"max": 0.8, "axis": "psi"}}, "free": ["yaw-pair"]}},
        ),
    },
    "RobustnessRequest": {
        "inertia": ("A hundred rigs, 20 % about the inertia", {"uncertainty": {"J_p": 0.2}, "samples": 100}),
    },
    "SampleRequest": {"short": ("Ten seconds of the default rig", {"length": 10})},
    "OverlayRequest": {
        "segments": (
            "Under the recorded voltages, begun anew every second or so",
            {"columns": {"time": "time", "theta": "theta", "psi": "psi", "V_p": "V_p", "V_y": "V_y"}},
        ),
        "units": (
            "The same with all units said, every second row kept",
            {
                "columns": {
                    **{"time": "time", "theta": "theta", "psi": "psi", "V_p": "V_p", "V_y": "V_y"},
                    **{"time_unit": "s", "unit": "rad", "units": {"psi": "rad"}, "voltage_unit": "V"},
                    "decimate": 2,
                }
            },
        ),
    },
    "FlightRequest": {
        "changed": ("Three seconds with a gust and a change of design", {"samples": 301, "flight": _FLIGHT}),
    },
    "FlightNumbersRequest": {
        "every": ("Every tenth tick", {"every": 10, "flight": _FLIGHT}),
    },
    "FlightRecordingRequest": {
        "own": ("The same flight, as a laboratory would have recorded it", {"flight": _FLIGHT}),
    },
    "FlightFilmRequest": {
        "half": ("Half a second of it", {"flight": _FLIGHT, "begin": 0.5, "end": 1.0}),
    },
    "JoinRequest": {
        "one": ("A file that was sent before; give the id of each signal's", {"recordings": ["{key}"]})
    },
    "MarkRequest": {
        "settle": (
            "An attempt at a step, and the answer to a question",
            {"seed": 7, "step": "settle", "design": {"poles": [-6, -7, -9, -8]}, "answers": {"who": 2}},
        ),
    },
    "ClassRequest": {
        "monday": (
            "A class that closes by itself",
            {"lab": "one-pair", "title": "Monday, group 2", "closes": "2099-01-31T16:00:00Z"},
        ),
    },
    "JoinClassRequest": {
        "name": ("Somebody joins", {"name": "Ada Lovelace", "email": "ada@example.org", "login": "al1"}),
    },
    "AttemptRequest": {
        "settle": (
            "An attempt at a step",
            {
                "student": "{student}",
                "id": "6f1c2a1e-8c2b-4f0e-9a55-0d1f5a2b3c4d",
                "step": "settle",
                "design": {"poles": [-6, -7, -9, -8]},
                "answers": {"who": 2, "why": "The pair nearest to the axis decides."},
            },
        ),
    },
    "HintRequest": {
        "first": ("The first hint of a step", {"student": "{student}", "step": "settle", "hint": 1}),
    },
    "HandMark": {
        "why": (
            "Two points for an answer in words",
            {"step": "settle", "question": "why", "points": 2, "comment": "Nearly: which pair?"},
        ),
    },
    "PlaceRequest": {
        "three": (
            "Three states, two inputs",
            {
                "A": [[0, 1, 0], [0, 0, 1], [1, 2, 3]],
                "B": [[0, 0], [1, 0], [0, 1]],
                "poles": [-1, {"re": -2, "im": 1}, {"re": -2, "im": -1}],
            },
        ),
    },
    "SystemText": {
        "matlab": (
            "A spring in letters, from MATLAB",
            {"text": "A = [0 1; -k/m -b/m]; B = [0; 1/m]; k = 3, m = 2, b = 1"},
        ),
        "python": (
            "From Python",
            {"text": "A = np.array([[0, 1], [-2, -3]])\nB = np.array([[0], [1]])\nC = [[1, 0]]"},
        ),
    },
    "SystemDesignRequest": {
        "observer": (
            "With an observer",
            {
                "A": [[0, 1], [20.6, 0]],
                "B": [[0], [1]],
                "C": [[1, 0]],
                "poles": [{"re": -1.8, "im": 2.4}, {"re": -1.8, "im": -2.4}],
                "observer_poles": [-8, -9],
            },
        ),
    },
    "SystemFormulasRequest": {
        "spring": (
            "A mass on a spring, its place measured",
            {"A": [["0", "1"], ["-k/m", "-b/m"]], "B": [["0"], ["1/m"]], "C": [["1", "0"]]},
        ),
    },
    "SymbolicPlaceRequest": {
        "spring": ("A mass on a spring", {"A": [["0", "1"], ["-k/m", "-b/m"]], "B": [["0"], ["1/m"]]}),
        "numbers": (
            "Two inputs, a complex pair",
            {
                "A": [[0, 1, 0], [0, 0, 1], ["a", 0, "sqrt(c)"]],
                "B": [[0, 0], ["b", 0], [0, 1]],
                "poles": [*_PAIR, -1.5],
            },
        ),
    },
}
"""By the name of the request's schema: examples by name, each with its summary."""


def install(app: FastAPI) -> None:
    """Adds the examples to every body of the app's OpenAPI document."""
    plain: Callable[[], Json] = app.openapi

    def openapi() -> Json:
        document = plain()
        for operations in document["paths"].values():
            body = operations.get("post", {}).get("requestBody", {})
            for content in body.get("content", {}).values():
                name = content["schema"].get("$ref", "").rpartition("/")[2]
                content["examples"] = {
                    key: {"summary": summary, "value": value}
                    for key, (summary, value) in EXAMPLES.get(name, {}).items()
                }
        return document

    app.openapi = openapi
