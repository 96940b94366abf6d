"""Where the fit of a recording's segments begins."""

from __future__ import annotations

import numpy as np

from heli2dof_core.recordings.recording import Recording
from heli2dof_core.recordings.segments import rough_starts
from heli2dof_core.recordings.time_axis import GAP, stretches


def test_rough_starts_are_the_parabolas_own_and_know_nothing_of_the_next_segment():
    """Angles that are parabolas segment by segment: value and slope at each segment's first sample."""
    rng = np.random.default_rng(4)
    t = np.cumsum(rng.uniform(0.8e-3, 1.2e-3, 90))
    bounds = np.array([[0, 4], [4, 34], [34, 38], [38, 90]])
    angles, wanted = np.empty((90, 2)), []
    for first, end in bounds.tolist():
        place, rate, bend = rng.normal(size=(3, 2))
        since = (t[first:end] - t[first])[:, None]
        angles[first:end] = place + rate * since + bend * since**2
        wanted.append([*place, *rate])
    found = rough_starts(Recording(t, angles, np.zeros((90, 2))), bounds)
    np.testing.assert_allclose(found, wanted, atol=1e-8)


def test_rough_starts_look_at_the_beginning_alone():
    """Sixty milliseconds of it: what the angles do later does not touch them."""
    t = 2e-3 * np.arange(200)
    angles = np.column_stack([0.3 - 0.2 * t + t**2, 0.1 + 0.4 * t - 2 * t**2])
    angles[32:] += np.random.default_rng(1).normal(size=(168, 2))
    found = rough_starts(Recording(t, angles, np.zeros((200, 2))), np.array([[0, 200]]))
    np.testing.assert_allclose(found, [[0.3, 0.1, -0.2, 0.4]], atol=1e-9)


def test_a_gap_is_longer_than_so_many_sample_times_and_parts_the_rows():
    t = np.arange(6.0)
    longer = np.where(t > 2, t + GAP - 1, t)
    assert stretches(longer).tolist() == [[0, 6]]  # it is no longer than that
    assert stretches(longer + 1e-6 * (t > 2)).tolist() == [[0, 3], [3, 6]]
