"""Flights: the rig in steps, under hands, gusts and faults, while everything may be changed in the air."""

from .checksum import checksum
from .controller import FlightController, flyable
from .course import FlightCourse, Flown, fly_log, simulate_flight
from .events import WORDS
from .log import FlightLog
from .rig import Rig, Takeover
from .rows import FlightRows
from .script import fly_script, read_script
from .thin import ThinFlight, sampled_flight, thin_flight

__all__ = [
    "WORDS",
    "FlightController",
    "FlightCourse",
    "FlightLog",
    "FlightRows",
    "Flown",
    "Rig",
    "Takeover",
    "ThinFlight",
    "checksum",
    "fly_log",
    "fly_script",
    "flyable",
    "read_script",
    "sampled_flight",
    "simulate_flight",
    "thin_flight",
]
