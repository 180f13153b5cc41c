# SPDX-License-Identifier: BSD-3-Clause
"""The benchmark of aliasing: that it tells what flickers from what moves, and that supersampling mends it."""

import os
import sys

import numpy as np
import pytest

sys.path.insert(0, os.path.join(os.path.dirname(__file__), "..", "Benchmarks"))
import aliasing  # noqa: E402
from pointsurface.bench import MESH, Case, Stage  # noqa: E402


def test_a_slow_change_does_not_flicker_and_noise_does():
    time = np.linspace(0, 1, 16)[:, None, None]
    noise = np.random.default_rng(0).normal(0, 0.1, (4000, 2, 2))
    assert aliasing.flicker(time * np.ones((1, 2, 2))) == pytest.approx(1 / 15**2 / 2)
    assert aliasing.flicker(noise).mean() == pytest.approx(0.01, rel=0.05)  # the variance of the noise


def test_supersampling_lessens_the_flicker_of_a_dense_cloud(monkeypatch):
    monkeypatch.setattr(aliasing, "FRAMES", 4)
    pixels = 64
    stage = Stage(Case("gyroid", 16 * pixels**2, pixels))
    truth = aliasing.flicker(aliasing.draw_orbit(stage, MESH, scale=aliasing.TRUTH_SUPERSAMPLING)[0]).mean()
    plain, fine = (aliasing.flicker(aliasing.draw_orbit(stage, "pull-push", n)[0]).mean() for n in (1, 4))
    assert plain > 2 * truth
    assert truth < fine < 0.85 * plain
