# SPDX-License-Identifier: BSD-3-Clause
"""The benchmark of aliasing: that it tells what flickers from what moves, and that supersampling mends it."""

import os
import sys

import numpy as np
import pytest

sys.path.insert(0, os.path.join(os.path.dirname(__file__), "..", "Benchmarks"))
import aliasing  # noqa: E402
from pointsurface.bench_scenes import Case  # noqa: E402
from pointsurface.bench_stage import MESH, Stage  # noqa: E402


def test_a_slow_change_does_not_flicker_and_noise_does():
    time = np.linspace(0, 1, 16)[:, None, None]
    noise = np.random.default_rng(0).normal(0, 0.1, (4000, 2, 2))
    assert aliasing.flicker(time * np.ones((1, 2, 2))) == pytest.approx(1 / 15**2 / 2)
    assert aliasing.flicker(noise).mean() == pytest.approx(0.01, rel=0.05)  # the variance of the noise


@pytest.fixture(scope="module")
def dense():
    """A dense cloud before a camera, and the flicker of the true surface."""
    pixels = 64
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(aliasing, "FRAMES", 4)
        stage = Stage(Case("gyroid", 16 * pixels**2, pixels))
        truth = aliasing.draw_orbit(stage, MESH, scale=aliasing.TRUTH_SUPERSAMPLING)[0]
        yield stage, truth


def test_remedies_lessen_the_flicker_of_a_dense_cloud(dense):
    stage, truth = dense
    flicker = {
        remedy: aliasing.flicker(aliasing.draw_orbit(stage, "pull-push", remedy)[0]).mean() / aliasing.flicker(truth).mean()
        for remedy in aliasing.REMEDIES
    }
    print(flicker)
    assert flicker[""] > 2
    assert 1 < flicker["3x"] < 0.9 * flicker[""]
    assert flicker[aliasing.FXAA] < 0.6 * flicker[""]


def test_edges_are_where_a_true_surface_flickers_when_it_has_one_sample_a_pixel(dense):
    stage, truth = dense
    edges = aliasing.find_edges(stage)
    assert 0.1 < edges.mean() < 0.9
    plain = aliasing.draw_orbit(stage, MESH)[0]
    wrong = aliasing.flicker(plain - truth)
    print(edges.mean(), wrong[edges].sum() / wrong.sum())
    assert wrong[edges].sum() > 0.9 * wrong.sum()


def test_the_orbit_is_drawn_from_the_same_cameras_each_time(dense):
    stage, _ = dense
    assert np.array_equal(aliasing.draw_orbit(stage, MESH)[0], aliasing.draw_orbit(stage, MESH)[0])
