"""A small lab, as an instructor writes it: two steps, a question of each kind, hints with a price and without."""

from __future__ import annotations

A_LAB = """\
lab: 1
name: small
title: A small lab
minutes: 10
summary: Two steps for tests.
preset: quanser-2dof-manual
vary: {B_p: 15 %, K_pp: 10 %}
text: Place the *poles*.
end: That was all.
instructor: SECRET-OF-THE-INSTRUCTOR
steps:
  - name: settle
    title: Settle
    text: Move the poles.
    view: design
    start: {poles: [-2, -2.5, -9.25, -8.76], outer: none}
    unlocked: [poles]
    goals:
      - {figure: settling_time, axis: theta, model: linear, max: 1.2 s, points: 4}
      - {figure: overshoot, axis: theta, model: linear, max: 5 %, points: 2}
    questions:
      - {name: who, kind: choice, text: Which pair is faster?, choices: [pitch, yaw], answer: 2, points: 2}
      - {name: four, kind: number, text: Two and two?, answer: 4, points: 1}
      - {name: why, kind: text, text: Why?, points: 3, sample: SECRET-SAMPLE}
    hints:
      - {text: Left is faster., cost: 0}
      - {text: SECRET-HINT, cost: 1}
    solution: {poles: [-6, -7, -9.25, -8.76]}
  - name: further
    title: Further on
    text: Now yaw.
    continue: true
    unlocked: [yaw-poles]
    goals:
      - {figure: settling_time, axis: psi, model: linear, max: 2 s, points: 5}
    solution: {poles: [-6, -7, -9.25, -8.76]}
"""
SOLVED = {"poles": [-6, -7, -9.25, -8.76], "outer": "none"}
"""A design that meets all goals of the first step."""
