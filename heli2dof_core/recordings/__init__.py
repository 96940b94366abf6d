"""Recordings of a real rig: read, laid over the simulation, and identified."""
